"""Random close-packed balls: Bennett's criterion by exhaustive search, isostatic contacts, density of the core."""

from itertools import combinations

import numpy as np
import pytest
from scipy.optimize import fsolve

from rheoclast.generation.random_packing import random_packed_ball
from rheoclast.particles.morphology import coordination_numbers, mean_coordination, relative_shape_anisotropy


@pytest.mark.parametrize(("count", "seed"), [(1, 0), (2, 0), (3, 0), (4, 1), (30, 2), (800, 3)])
def test_exact_and_isostatic(assert_exactly_touching, count, seed):
    """3 N − 6 contacts: each sphere after the third touches exactly three placed before it."""
    ball = random_packed_ball(count, 4e-7, seed=seed)
    assert_exactly_touching(ball, count, 4e-7)
    if count >= 3:
        assert len(ball.pairs) == 3 * count - 6
        np.testing.assert_array_equal(np.bincount(ball.pairs[:, 1], minlength=count)[3:], 3)
        assert mean_coordination(ball) == pytest.approx(6 - 12 / count, rel=1e-14)


def places_touching(a, b, c):
    """Where a unit sphere touches three others, by a root search on both sides."""
    middle, normal = (a + b + c) / 3, np.cross(b - a, c - a)
    for side in (1.5, -1.5):
        start = middle + side * normal / np.linalg.norm(normal)
        place, _, found, _ = fsolve(
            lambda x: [np.linalg.norm(x - y) - 2 for y in (a, b, c)], start, full_output=True, xtol=1e-13
        )
        if found == 1:
            yield place


def test_every_sphere_takes_the_nearest_place():
    """Without disorder, no place clear of the earlier spheres is nearer to the centre of the first three."""
    centers = random_packed_ball(12, disorder=0.0).spheres.centers
    centers = centers - centers[:3].mean(axis=0)
    for new in range(4, 12):
        earlier = centers[:new]
        for a, b, c in combinations(earlier, 3):
            if max(np.linalg.norm(a - b), np.linalg.norm(b - c), np.linalg.norm(c - a)) > 3.9:
                continue
            for place in places_touching(a, b, c):
                if np.linalg.norm(earlier - place, axis=1).min() > 2 - 1e-9:
                    assert np.linalg.norm(place) >= np.linalg.norm(centers[new]) - 1e-9


def test_seeds_and_disorder():
    """Equal seeds give equal balls, others not; without disorder all seeds agree; more disorder, a wider ball."""
    first, again, other = (random_packed_ball(60, seed=s).spheres.centers for s in (1, 1, 2))
    np.testing.assert_array_equal(first, again)
    assert np.abs(first - other).max() > 0.1
    plain = [random_packed_ball(60, seed=s, disorder=0).spheres.centers for s in (1, 2)]
    np.testing.assert_array_equal(*plain)
    widths = [
        np.mean([np.square(random_packed_ball(300, seed=s, disorder=d).spheres.centers).sum() for s in range(5)])
        for d in (0.0, 1.0, 4.0)
    ]
    assert widths[0] < widths[1] < widths[2]


@pytest.mark.parametrize("seed", range(3))
def test_core_is_close_packed(seed):
    """Random points in the inner half lie in a sphere with a share of 0.60 to 0.68 (crystals have 0.74)."""
    ball = random_packed_ball(1000, seed=seed)
    centers = ball.spheres.centers
    reach = 0.5 * (np.linalg.norm(centers, axis=1).max() + 1)
    rng = np.random.default_rng(seed)
    points = rng.uniform(-reach, reach, (20_000, 3))
    points = points[np.linalg.norm(points, axis=1) < reach]
    inside = np.zeros(len(points), dtype=bool)
    for center in centers[np.linalg.norm(centers, axis=1) < reach + 1]:
        inside |= np.sum((points - center) ** 2, axis=1) < 1
    assert 0.60 < inside.mean() < 0.68
    core = coordination_numbers(ball)[np.linalg.norm(centers, axis=1) < reach]
    assert 6 < core.mean() < 8
    assert relative_shape_anisotropy(ball.spheres) < 1e-3


def test_bad_requests_are_refused():
    """In one sentence."""
    with pytest.raises(ValueError, match="count: expected an integer of at least 1, got 0"):
        random_packed_ball(0)
    with pytest.raises(ValueError, match=r"disorder: expected zero or a positive number, got -0\.1"):
        random_packed_ball(10, disorder=-0.1)
    with pytest.raises(ValueError, match="radius: expected a positive number"):
        random_packed_ball(10, radius=-1)
