"""Spheres in a hash table of cells, against all spheres one by one."""

import numpy as np
import pytest

from rheoclast.generation._cells import add, cells, clearance, first_touch, near


@pytest.fixture(params=[(1, 0), (40, 1), (300, 2)], ids=str)
def scattered(request):
    """Spheres of unequal radii, dense in the middle and with a few far out, and their table."""
    count, seed = request.param
    rng = np.random.default_rng(seed)
    centers = rng.normal(size=(count, 3)) * rng.choice([3.0, 12.0, 90.0], size=(count, 1))
    radii = rng.uniform(0.4, 1.6, count)
    grid = cells(radii)
    for center in centers:
        add(grid, center)
    return grid, centers, radii


def points(seed, count=200):
    """Points near and far."""
    rng = np.random.default_rng(seed)
    return rng.normal(size=(count, 3)) * rng.choice([3.0, 30.0, 3000.0], size=(count, 1))


def test_near_finds_all_within_a_distance(scattered):
    """Each once."""
    grid, centers, radii = scattered
    found = np.empty(len(radii), np.int64)
    for point, distance in zip(points(3), np.resize([0.5, 4.0, 15.0], 200), strict=True):
        expected = np.flatnonzero(np.linalg.norm(centers - point, axis=1) <= distance)
        assert sorted(found[: near(grid, point, distance, found)]) == expected.tolist()


def test_clearance_is_a_lower_bound_and_exact_when_near(scattered):
    """Far out it is at least a seventh of the distance, so that a walk has few steps."""
    grid, centers, radii = scattered
    for point in points(4):
        exact = np.min(np.linalg.norm(centers - point, axis=1) - radii)
        found = clearance(grid, point)
        assert found <= exact + 1e-9
        if exact < radii.max():
            assert found == pytest.approx(exact, abs=1e-12)
        assert found >= min(exact, radii.max(), exact / 7)


def test_first_touch_is_the_first_of_all(scattered):
    """With nothing overlapped before; beyond the length allowed nothing is found."""
    grid, centers, radii = scattered
    rng, found, hits = np.random.default_rng(5), np.empty(len(radii), np.int64), 0
    for target in points(6):
        start = 250.0 * target / np.linalg.norm(target)
        direction = centers[rng.integers(len(centers))] + rng.normal(size=3) - start
        direction /= np.linalg.norm(direction)
        ahead = (centers - start) @ direction
        lateral2 = np.sum((centers - start) ** 2, axis=1) - ahead**2
        reach = radii + 0.7
        hit = lateral2 < reach**2
        travels = np.where(hit & (ahead > 0), ahead - np.sqrt(np.where(hit, reach**2 - lateral2, 0)), np.inf)
        travel, touched = first_touch(grid, start, direction, 0.7, 1e3, found)
        assert travel == pytest.approx(travels.min(), rel=1e-12)
        if np.isfinite(travel):
            hits += 1
            assert touched == travels.argmin()
            assert first_touch(grid, start, direction, 0.7, 0.99 * travel, found) == (np.inf, -1)
    assert hits > 20
