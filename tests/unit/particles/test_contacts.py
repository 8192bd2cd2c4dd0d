"""Contacts and connected parts against sums over all pairs."""

from itertools import combinations

import numpy as np
import pytest

from rheoclast.graphs import connected_parts
from rheoclast.particles.contacts import near_pairs, surface_gaps


def gap(centers, radii, i, j):
    """(distance − a_i − a_j) over the mean radius."""
    distance = np.sqrt(sum((centers[i][k] - centers[j][k]) ** 2 for k in range(3)))
    return (distance - radii[i] - radii[j]) / (0.5 * (radii[i] + radii[j]))


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("tolerance", [0.0, 1e-3, 0.7])
@pytest.mark.parametrize("spread", [1.0, 30.0])
def test_near_pairs_by_brute_force(seed, tolerance, spread):
    """The same pairs i < j, in order, and the same gaps as a loop over all pairs, also for radii 1 : 30."""
    rng = np.random.default_rng(seed)
    radii = np.exp(rng.uniform(0, np.log(spread), 60))
    centers = rng.uniform(-1, 1, (60, 3)) * 6 * radii.mean()
    expected = [(i, j) for i, j in combinations(range(60), 2) if gap(centers, radii, i, j) <= tolerance]
    assert expected
    pairs, gaps = near_pairs(centers, radii, tolerance)
    assert [tuple(pair) for pair in pairs.tolist()] == expected
    np.testing.assert_allclose(gaps, [gap(centers, radii, i, j) for i, j in expected], atol=1e-13)


def test_surface_gaps_in_mean_radii_of_the_pair():
    """Radii 1 and 3 at distance 5: the gap 1 is half the mean radius 2; inside each other it is negative."""
    centers, radii = np.array([[0.0, 0, 0], [0, 5, 0], [0, 0, 1]]), np.array([1.0, 3.0, 1.0])
    np.testing.assert_allclose(surface_gaps(centers, radii, np.array([[0, 1], [0, 2]])), [0.5, -1.0])


def test_no_pairs():
    """Spheres far apart give empty arrays of the right shape."""
    pairs, gaps = near_pairs(np.array([[0.0, 0, 0], [9, 0, 0]]), np.ones(2), 1e-3)
    assert pairs.shape == (0, 2)
    assert gaps.shape == (0,)


@pytest.mark.parametrize("seed", range(4))
def test_connected_parts_by_flooding(seed):
    """Two spheres share a label exactly when a walk over contacts leads from one to the other."""
    rng = np.random.default_rng(seed)
    pairs = rng.integers(0, 40, (25, 2))
    pairs = pairs[pairs[:, 0] != pairs[:, 1]]
    reach = np.eye(40, dtype=bool)
    for _ in range(40):
        for i, j in pairs:
            reach[i] |= reach[j]
            reach[j] |= reach[i]
    part = connected_parts(40, pairs)
    np.testing.assert_array_equal(part[:, None] == part[None, :], reach | reach.T)
