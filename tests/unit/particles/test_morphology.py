"""Measures of shape against closed forms and integrals over the volume."""

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.particles.morphology import coordination_numbers, depth, radius_of_gyration

CHAIN = rc.Spheres([[0, 0, 0], [2, 0, 0], [4, 0, 0]], 1.0)


def test_radius_of_gyration_closed_forms():
    """A ball has sqrt(3/5) a; a doublet adds the distance a of its centres: sqrt(8/5) a; a chain of three 8/3."""
    assert radius_of_gyration(rc.Spheres([[7.0, -1, 2]], 3.0)) == pytest.approx(3 * np.sqrt(3 / 5), rel=1e-14)
    doublet = rc.Spheres([[0, 0, 0], [0, 4, 0]], 2.0)
    assert radius_of_gyration(doublet) == pytest.approx(2 * np.sqrt(8 / 5), rel=1e-14)
    assert radius_of_gyration(CHAIN) == pytest.approx(np.sqrt(8 / 3 + 3 / 5), rel=1e-14)


@pytest.mark.parametrize("seed", range(3))
def test_radius_of_gyration_by_monte_carlo(seed):
    """∫|x − x_c|² dV / V over the union of unequal spheres, within five standard errors of 4·10⁵ points."""
    rng = np.random.default_rng(seed)
    spheres = rc.Spheres(rng.uniform(-9, 9, (6, 3)), rng.uniform(0.3, 1.5, 6), overlap_tolerance=1.0)
    low, high = (spheres.centers - 1.5).min(axis=0), (spheres.centers + 1.5).max(axis=0)
    owner = rng.choice(6, size=400_000, p=spheres.radii**3 / np.sum(spheres.radii**3))
    cube = rng.uniform(-1, 1, (owner.size, 3))
    keep = np.sum(cube**2, axis=1) <= 1
    points = spheres.centers[owner[keep]] + spheres.radii[owner[keep], None] * cube[keep]
    assert (points > low).all()
    assert (points < high).all()
    squares = np.sum((points - points.mean(axis=0)) ** 2, axis=1)
    error = squares.std() / np.sqrt(len(squares))
    assert radius_of_gyration(spheres) ** 2 == pytest.approx(squares.mean(), abs=5 * error)


def test_radius_of_gyration_moves_and_scales():
    """It is a length: unchanged by a shift, proportional to the unit."""
    moved = rc.Spheres(1e-6 * (CHAIN.centers + np.array([5.0, -3.0, 1.0])), 1e-6)
    assert radius_of_gyration(moved) == pytest.approx(1e-6 * radius_of_gyration(CHAIN), rel=1e-12)


def test_coordination_numbers():
    """A chain has 1, 2, 1; each contact counts twice; a lone sphere has none."""
    aggregate = rc.Aggregate.touching(CHAIN)
    assert coordination_numbers(aggregate).tolist() == [1, 2, 1]
    star = np.array([[0, 0, 0], [2, 0, 0], [-2, 0, 0], [0, 2, 0], [0, 0, -2]])
    assert coordination_numbers(rc.Aggregate.touching(rc.Spheres(star, 1.0))).tolist() == [4, 1, 1, 1, 1]
    assert coordination_numbers(rc.Aggregate.touching(rc.Spheres([[0, 0, 0]], 1.0))).tolist() == [0]


def test_depth_is_in_radii_of_gyration_from_the_centre_of_mass():
    """Zero at the centre of mass, one at the distance Rg from it."""
    aggregate = rc.Aggregate.touching(CHAIN)
    gyration = np.sqrt(8 / 3 + 3 / 5)
    np.testing.assert_allclose(
        depth(aggregate, np.array([[2, 0, 0], [2, gyration, 0], [4, 0, 0]])), [0, 1, 2 / gyration], atol=1e-15
    )
