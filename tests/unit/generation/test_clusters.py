"""Rigid clusters: gap, first touch and union against all pairs of spheres."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from rheoclast.generation._clusters import cluster, extent, overlap, smallest_gap, travel_to_touch, union
from rheoclast.generation._contact_at_distance import contact_at_distance
from rheoclast.generation._orientations import random_direction, random_normal, random_rotation, random_turn

SIZES = [(1, 1), (1, 40), (7, 6), (60, 90)]


def scattered(count, rng):
    """Cluster of unequal spheres at random in a ball; they may overlap each other."""
    return cluster(rng.normal(size=(count, 3)) * count ** (1 / 3), rng.uniform(0.3, 1.5, count))


def motions(seed, reach):
    """Random rigid motions, some near and some far."""
    rng = np.random.default_rng(seed)
    for factor in np.linspace(0.3, 1.5, 8):
        yield random_rotation(rng), factor * reach * random_direction(rng)


def pair_gaps(fixed, moved, rotation, shift):
    """Gaps (N, M) of the spheres of two clusters, one of them moved."""
    placed = moved.centers @ rotation.T + shift
    distance = np.linalg.norm(fixed.centers[:, None] - placed, axis=2)
    return distance - fixed.radii[:, None] - moved.radii


@pytest.fixture(params=SIZES, ids=str)
def pair(request):
    """Two clusters and the sum of their extents."""
    rng = np.random.default_rng(sum(request.param))
    fixed, moved = (scattered(count, rng) for count in request.param)
    return fixed, moved, extent(fixed) + extent(moved)


def test_every_ball_encloses_its_spheres(pair):
    """Down to the leaves, which hold every sphere once; the centre of mass is at the origin."""
    for one in pair[:2]:
        for center, radius, first, last in zip(one.ball_centers, one.ball_radii, one.first, one.last, strict=True):
            assert np.all(np.linalg.norm(one.centers[first:last] - center, axis=1) + one.radii[first:last] <= radius)
        leaves = len(one.first) // 2
        assert np.sum(one.last[leaves:] - one.first[leaves:]) == len(one.radii)
        np.testing.assert_allclose(one.radii**3 @ one.centers, 0, atol=1e-9)


def test_extent_is_the_farthest_surface(pair):
    """From the centre of mass."""
    assert extent(pair[0]) == np.max(np.linalg.norm(pair[0].centers, axis=1) + pair[0].radii)


def test_smallest_gap_is_that_of_all_pairs(pair):
    """Positive or negative; a bound is returned when no gap is below it."""
    fixed, moved, reach = pair
    for rotation, shift in motions(1, reach):
        expected = pair_gaps(fixed, moved, rotation, shift).min()
        found = smallest_gap(fixed, moved, rotation, shift, np.inf, -np.inf)
        assert found == pytest.approx(expected, abs=1e-12)
        bound = expected - 0.1
        assert smallest_gap(fixed, moved, rotation, shift, bound, -np.inf) == bound
        assert smallest_gap(fixed, moved, rotation, shift, np.inf, expected + 0.5) <= expected + 0.5
        assert overlap(fixed, moved, rotation, shift) == (expected < 0)


def test_first_touch_leaves_one_pair_in_contact(pair):
    """Nothing overlaps on the way, and at its end the smallest gap is zero."""
    fixed, moved, reach = pair
    touched = 0
    for rotation, shift in motions(2, reach):
        direction = -shift / np.linalg.norm(shift)
        start = shift - (2 * reach) * direction + 0.4 * reach * random_normal(direction, np.random.default_rng(3))
        travel = travel_to_touch(fixed, moved, rotation, start, direction)
        way = np.linspace(0, travel if np.isfinite(travel) else 6 * reach, 200)
        smallest = [pair_gaps(fixed, moved, rotation, start + t * direction).min() for t in way]
        assert min(smallest) > -1e-12
        if np.isfinite(travel):
            touched += 1
            assert smallest[-1] == pytest.approx(0, abs=1e-12)
    assert touched > 0


def test_touching_clusters_that_part_do_not_meet():
    """Rounding of a contact is no collision when they move apart, and one at once when they close in."""
    one = cluster(np.zeros((1, 3)), np.ones(1))
    shift, toward = np.array([2 - 1e-13, 0, 0]), np.array([-1.0, 0, 0])
    assert travel_to_touch(one, one, np.eye(3), shift, -toward) == np.inf
    assert travel_to_touch(one, one, np.eye(3), shift, toward) == pytest.approx(0, abs=1e-12)


def test_union_keeps_the_shape(pair):
    """All distances stay, up to the order of the spheres."""
    fixed, moved, reach = pair
    (rotation, shift), *_ = motions(4, reach)
    both = union(fixed, moved, rotation, shift)
    placed = np.concatenate([fixed.centers, moved.centers @ rotation.T + shift])
    expected = np.linalg.norm(placed[:, None] - placed, axis=2)
    found = np.linalg.norm(both.centers[:, None] - both.centers, axis=2)
    np.testing.assert_allclose(np.sort(found, axis=None), np.sort(expected, axis=None), atol=1e-11)
    np.testing.assert_array_equal(np.sort(both.radii), np.sort(np.concatenate([fixed.radii, moved.radii])))


def test_random_rotations_are_uniform():
    """Proper rotations; a turned axis has mean zero and second moment one third, within four standard errors."""
    rng = np.random.default_rng(6)
    rotations = np.array([random_rotation(rng) for _ in range(4000)])
    np.testing.assert_allclose(
        rotations @ rotations.transpose(0, 2, 1), np.broadcast_to(np.eye(3), (4000, 3, 3)), atol=1e-14
    )
    assert (np.linalg.det(rotations) > 0).all()
    np.testing.assert_allclose(rotations.mean(axis=0), 0, atol=4 / np.sqrt(3 * 4000))
    np.testing.assert_allclose((rotations**2).mean(axis=0), 1 / 3, atol=4 * np.sqrt(4 / 45 / 4000))
    # The angle of a uniform rotation has the density (1 − cos φ) / π, hence the mean π/2 + 2/π.
    angles = Rotation.from_matrix(rotations).magnitude()
    assert angles.mean() == pytest.approx(np.pi / 2 + 2 / np.pi, abs=4 * angles.std() / np.sqrt(4000))


def test_random_turns_take_one_direction_to_the_other():
    """And leave the angle about it free."""
    rng = np.random.default_rng(7)
    start, end = random_direction(rng), random_direction(rng)
    turns = np.array([random_turn(start, end, rng) for _ in range(200)])
    np.testing.assert_allclose(turns @ start, np.broadcast_to(end, (200, 3)), atol=1e-14)
    np.testing.assert_allclose(np.linalg.det(turns), 1.0, rtol=1e-13)
    np.testing.assert_allclose((turns @ random_normal(start, rng)).mean(axis=0), 0, atol=4 / np.sqrt(200))


@pytest.mark.parametrize("factor", [0.6, 0.8, 1.0])
def test_contact_at_distance(factor):
    """The centres of mass are at the distance asked for, and the smallest gap is zero."""
    rng = np.random.default_rng(8)
    rod = cluster(np.arange(12.0)[:, None] * [2.0, 0, 0], np.ones(12))
    distance = factor * 2 * extent(rod)
    found, rotation, shift = contact_at_distance(rod, rod, distance, 1000, rng)
    assert found
    assert np.linalg.norm(shift) == pytest.approx(distance, rel=1e-12)
    assert pair_gaps(rod, rod, rotation, shift).min() == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("distance", [1.5, 2.5])
def test_two_spheres_touch_at_one_distance_only(distance):
    """Nearer they overlap, farther they are apart."""
    one = cluster(np.zeros((1, 3)), np.ones(1))
    assert not contact_at_distance(one, one, distance, 100, np.random.default_rng(9))[0]
    assert contact_at_distance(one, one, 2.0, 1, np.random.default_rng(9))[0]
