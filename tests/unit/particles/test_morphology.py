"""Measures of shape against closed forms and integrals over the volume."""

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.generation import cluster_cluster, random_packed_ball, ring
from rheoclast.particles.morphology import coordination_numbers, depth, radial_position, radius_of_gyration

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


def test_radial_position_is_in_radii_of_gyration_from_the_centre_of_mass():
    """Zero at the centre of mass, one at the distance Rg from it."""
    aggregate = rc.Aggregate.touching(CHAIN)
    gyration = np.sqrt(8 / 3 + 3 / 5)
    np.testing.assert_allclose(
        radial_position(aggregate, np.array([[2, 0, 0], [2, gyration, 0], [4, 0, 0]])), [0, 1, 2 / gyration], atol=1e-15
    )


class TestDepth:
    @pytest.mark.parametrize("radius", [1.0, 0.5e-6])
    def test_in_a_cube_it_is_the_distance_from_the_nearest_face(self, radius):
        """Five spheres along each edge: the outermost layers of contacts are at depth 1, the inner ones below."""
        axis = 2.0 * np.arange(5)
        centers = np.stack(np.meshgrid(axis, axis, axis), axis=-1).reshape(-1, 3) + np.array([3, -7, 20])
        cube = rc.Aggregate.touching(rc.Spheres(radius * centers, radius))
        points = cube.contact_points
        from_face = np.minimum(points - (centers.min(axis=0) - 1) * radius, (centers.max(axis=0) + 1) * radius - points)
        np.testing.assert_allclose(depth(cube, points), from_face.min(axis=1) / radius, atol=1e-9)
        assert set(np.round(depth(cube, points), 6)) == {1, 2, 3, 4}

    @pytest.mark.parametrize("aggregate", [cluster_cluster(20, seed=1), random_packed_ball(40, seed=1)], ids=len)
    def test_it_is_the_least_distance_from_a_plane_that_touches_the_aggregate(self, aggregate):
        """Among planes of any direction; within 1 % for 10⁵ of them."""
        normals = np.random.default_rng(0).normal(size=(100_000, 3))
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        touching = (aggregate.spheres.centers @ normals.T).max(axis=0) + aggregate.spheres.radii.mean()
        least = (touching - aggregate.contact_points @ normals.T).min(axis=1)
        found = depth(aggregate, aggregate.contact_points)
        assert (found <= least + 1e-9).all()
        np.testing.assert_allclose(found, least, atol=0.05)
        assert found.min() >= 1 - 1e-9

    def test_centres_of_the_outermost_spheres_are_at_depth_one(self):
        centers = random_packed_ball(40, seed=2).spheres.centers
        below = depth(random_packed_ball(40, seed=2), centers)
        for axis in range(3):
            np.testing.assert_allclose(below[[centers[:, axis].argmin(), centers[:, axis].argmax()]], 1, atol=1e-9)
        assert below.min() >= 1 - 1e-9
        assert below.max() > 2

    def test_does_not_depend_on_place_orientation_and_unit(self):
        aggregate = random_packed_ball(30, seed=3)
        expected = depth(aggregate, aggregate.contact_points)
        turn = rc.random_orientations(1, seed=3)[0]
        spheres = rc.Spheres(1e-6 * (aggregate.spheres.centers @ turn.T + [40, -2, 9]), 1e-6)
        moved = rc.Aggregate(spheres, aggregate.pairs)
        np.testing.assert_allclose(depth(moved, moved.contact_points), expected, rtol=1e-7)

    def test_unequal_spheres_count_by_their_mean_radius(self):
        """An octahedron about a large sphere: faces of the hull of the centres are at 3 a / √3 from the middle."""
        centers = 3.0 * np.vstack([np.zeros(3), np.eye(3), -np.eye(3)])
        aggregate = rc.Aggregate.touching(rc.Spheres(centers, [2.0] + [1.0] * 6))
        mean = 8 / 7
        np.testing.assert_allclose(depth(aggregate, np.zeros((1, 3))), (np.sqrt(3) + mean) / mean)

    @pytest.mark.parametrize("seed", range(3))
    @pytest.mark.parametrize("radius", [1.0, 0.3e-6])
    def test_contacts_of_flat_and_straight_aggregates_are_at_depth_one(self, seed, radius):
        """Also where they lie askew, so that rounding leaves some thickness; and with fewer than four spheres."""
        turn = rc.random_orientations(3, seed=5)[seed]
        for aggregate in (ring(9), lattice_square(), rc.Aggregate.touching(CHAIN), ring(3), chain(12)):
            turned = aggregate.rotated(turn).scaled(radius)
            np.testing.assert_allclose(depth(turned, turned.contact_points), 1, atol=1e-9)

    def test_nearly_flat_is_nearly_one(self):
        """Coordinates of a ring, given to six digits."""
        noise = 1e-6 * np.random.default_rng(0).normal(size=(9, 3))
        aggregate = rc.Aggregate(rc.Spheres(ring(9).spheres.centers + noise, 1.0, 1e-4), ring(9).pairs)
        np.testing.assert_allclose(depth(aggregate, aggregate.contact_points), 1, atol=1e-5)


def lattice_square():
    centers = 2.0 * np.indices((4, 4, 1)).reshape(3, -1).T
    return rc.Aggregate.touching(rc.Spheres(centers, 1.0))


def chain(count):
    return rc.Aggregate.touching(rc.Spheres(np.outer(2.0 * np.arange(count), [1, 0, 0]), 1.0))
