"""The order in which pieces are joined."""

import numpy as np
import pytest

from rheoclast.generation._clusters import union
from rheoclast.generation._hierarchy import hierarchy


@pytest.fixture
def recorder():
    """A join side by side, and the sizes (first, second) of the pieces it was given."""
    sizes = []

    def join(first, second):
        sizes.append((len(first.radii), len(second.radii)))
        return union(first, second, np.eye(3), np.array([100.0, 0, 0]))

    return join, sizes


@pytest.mark.parametrize("count", [1, 2, 7, 64, 100])
def test_halves_differ_by_at_most_one_sphere(recorder, count):
    """N − 1 joins, and every sphere is used once."""
    join, sizes = recorder
    radii = np.linspace(1, 2, count)
    grown = hierarchy(radii, join)
    assert len(sizes) == count - 1
    assert all(0 <= first - second <= 1 for first, second in sizes)
    np.testing.assert_array_equal(np.sort(grown.radii), radii)


def test_smaller_shares(recorder):
    """The second piece is the share of the union, or one sphere."""
    join, sizes = recorder
    hierarchy(np.ones(50), join, share=8)
    assert all(second == max((first + second) // 8, 1) for first, second in sizes)
    sizes.clear()
    hierarchy(np.ones(50), join, share=50)
    assert sizes == [(k, 1) for k in range(1, 50)]
