"""Laws that every generated aggregate obeys."""

import numpy as np
import pytest
from scipy.spatial.distance import pdist, squareform

from rheoclast.graphs import connected_parts


def _assert_exactly_touching(aggregate, count, radius):
    centers = aggregate.spheres.centers / radius
    assert len(aggregate) == count
    np.testing.assert_array_equal(aggregate.spheres.radii, radius)
    np.testing.assert_allclose(centers.mean(axis=0), 0, atol=1e-10)
    distance = squareform(pdist(centers)) + 10 * np.eye(count)
    assert distance.min() >= 2 - 1e-9
    first, second = aggregate.pairs.T
    np.testing.assert_allclose(distance[first, second], 2, rtol=0, atol=1e-9)
    assert connected_parts(count, aggregate.pairs).max() == 0


@pytest.fixture
def assert_exactly_touching():
    """Check (aggregate, count, radius): about the origin, no overlap, contacts closed to 1e-9 radii, one part."""
    return _assert_exactly_touching
