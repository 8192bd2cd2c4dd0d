"""What is left when joints are chosen for removal."""

import numpy as np
import pytest

from rheoclast.frames.joints import parts_without
from rheoclast.graphs import connected_parts


@pytest.mark.parametrize("seed", range(8))
def test_parts_are_those_of_the_graph_that_is_left(seed):
    """One joint more or two, in a graph with triangles and bridges; joints may be double."""
    rng = np.random.default_rng(seed)
    tree = np.stack([np.arange(1, 12), [rng.integers(k) for k in range(1, 12)]], axis=1)
    more = rng.integers(0, 12, (8, 2))
    pairs = np.vstack([tree, more[more[:, 0] != more[:, 1]]])
    gone = np.array([len(pairs) - 1])
    split = 0
    for joint in range(len(pairs) - 1):
        for chosen in (np.array([joint]), np.unique([joint, (joint + 3) % (len(pairs) - 1)])):
            removed = np.concatenate([gone, chosen])
            expected = connected_parts(12, np.delete(pairs, removed, axis=0))
            np.testing.assert_array_equal(parts_without(12, pairs, removed, chosen), expected)
            split += expected.any()
    assert 0 < split < 2 * (len(pairs) - 1)
