"""Spheres: what is stored, and which sets are refused."""

import dataclasses
from itertools import combinations

import numpy as np
import pytest

import rheoclast as rc

TETRAHEDRON = np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])  # edge 2 sqrt(2)


def test_one_radius_for_all_or_one_each():
    """A single value is spread over all spheres."""
    single, each = rc.Spheres(TETRAHEDRON, 1.25), rc.Spheres(TETRAHEDRON.tolist(), [1.25] * 4)
    np.testing.assert_array_equal(single.radii, each.radii)
    np.testing.assert_array_equal(single.centers, each.centers)
    assert len(single) == 4


def test_volume_and_center_of_mass():
    """Mass goes with the cube of the radius: radii 1 and 2 balance at 8/9 of the distance."""
    spheres = rc.Spheres([[0.0, 0, 0], [0, 9, 0]], [1.0, 2.0])
    np.testing.assert_allclose(spheres.volumes, 4 * np.pi / 3 * np.array([1.0, 8.0]), rtol=1e-15)
    np.testing.assert_allclose(spheres.center_of_mass, [0, 8, 0], atol=1e-14)


def test_spheres_are_frozen_copies():
    """Nothing behind the value can change."""
    centers, radii = TETRAHEDRON.copy(), np.full(4, 1.0)
    spheres = rc.Spheres(centers, radii)
    centers[0], radii[0] = 7.0, 7.0
    assert spheres.centers[0, 0] == 1.0
    assert spheres.radii[0] == 1.0
    with pytest.raises(dataclasses.FrozenInstanceError):
        spheres.radii = radii
    for array in (spheres.centers, spheres.radii):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1.0


@pytest.mark.parametrize(
    ("centers", "radii", "message"),
    [
        (np.zeros((3, 2)), 1.0, r"^centers: expected shape \(N, 3\), got \(3, 2\)$"),
        (np.zeros(3), 1.0, r"^centers: expected shape \(N, 3\), got \(3,\)$"),
        (np.zeros((0, 3)), 1.0, r"^centers: expected at least one sphere, got none$"),
        ([[0, 0, 0], [0, np.nan, 5]], 1.0, r"^centers\[1, 1\]: expected a finite number, got nan$"),
        (TETRAHEDRON, [1.0, 1.0], r"^radii: expected one per sphere \(4\) or a single value, got 2$"),
        (TETRAHEDRON, np.ones((4, 1)), r"^radii: expected shape \(N,\), got \(4, 1\)$"),
        (TETRAHEDRON, [1.0, 1.0, 0.0, 1.0], r"^radii\[2\]: expected a positive number, got 0$"),
        (TETRAHEDRON, [1.0, -1.0, 1.0, 1.0], r"^radii\[1\]: expected a positive number, got -1$"),
        (TETRAHEDRON, [1.0, 1.0, 1.0, np.nan], r"^radii\[3\]: expected a finite number, got nan$"),
        (TETRAHEDRON, -2.0, r"^radii(\[0\])?: expected a positive number, got -2$"),
        (TETRAHEDRON, "one", r"^radii: expected numbers in an array of shape \(N,\), got "),
    ],
)
def test_refused_values(centers, radii, message):
    """Shapes, finiteness and signs are checked, and the item is named."""
    with pytest.raises(ValueError, match=message):
        rc.Spheres(centers, radii)


def test_refused_overlap_tolerance():
    """A tolerance is zero or positive."""
    with pytest.raises(ValueError, match=r"^overlap_tolerance: expected zero or a positive number, got -0\.1$"):
        rc.Spheres(TETRAHEDRON, 1.0, overlap_tolerance=-0.1)


def test_overlap_names_the_spheres_and_the_way_out():
    """The worst pair is named with its distance; the tolerance offered is one that works."""
    centers = [[0, 0, 0], [1.5, 0, 0], [10, 0, 0], [11.9, 0, 0]]
    with pytest.raises(
        rc.GeometryError,
        match=r"^spheres 0 and 1 overlap: distance 1\.5 < 2 = sum of radii \(and 1 more pairs?\); "
        r"shrink the radii or pass overlap_tolerance \(here at least 0\.5\)$",
    ):
        rc.Spheres(centers, 1.0)
    assert len(rc.Spheres(centers, 1.0, overlap_tolerance=0.5)) == 4


def test_duplicate_is_named():
    """Two spheres at one place are a duplicate, not an overlap."""
    with pytest.raises(
        rc.GeometryError, match=r"^spheres 1 and 2 are at the same place \[3\. 4\. 0\.\]; remove the duplicate$"
    ):
        rc.Spheres([[0, 0, 0], [3, 4, 0], [3, 4, 0]], 1.0)


@pytest.mark.parametrize("radii", [(1.0, 1.0), (1.0, 3.0), (2e-7, 5e-6)])
@pytest.mark.parametrize("tolerance", [1e-3, 0.05])
def test_overlap_just_inside_and_outside_the_tolerance(radii, tolerance):
    """The tolerance is a fraction of the mean radius of the pair, in any unit and for unequal spheres."""
    mean, total = np.mean(radii), sum(radii)
    for fraction, refused in ((0.999, False), (1.001, True)):
        centers = [[0, 0, 0], [0, 0, total - fraction * tolerance * mean]]
        if refused:
            with pytest.raises(rc.GeometryError, match="spheres 0 and 1 overlap"):
                rc.Spheres(centers, radii, overlap_tolerance=tolerance)
        else:
            rc.Spheres(centers, radii, overlap_tolerance=tolerance)


def test_small_sphere_inside_a_large_one_is_refused():
    """Overlap is seen when one sphere hides in another of a hundred times its radius."""
    with pytest.raises(rc.GeometryError, match=r"^spheres 0 and 1 overlap: distance 60 < 101 = sum of radii"):
        rc.Spheres([[0, 0, 0], [0, 60, 0]], [100.0, 1.0])


@pytest.mark.parametrize("seed", range(5))
def test_overlap_by_brute_force(seed):
    """Random polydisperse sets are refused exactly when some pair is too close."""
    rng = np.random.default_rng(seed)
    centers, radii = 8 * rng.random((12, 3)), rng.uniform(0.2, 1.2, 12)
    closest = min(
        2 * (np.linalg.norm(centers[i] - centers[j]) / (radii[i] + radii[j]) - 1) for i, j in combinations(range(12), 2)
    )
    needed = max(0.0, -closest)
    rc.Spheres(centers, radii, overlap_tolerance=needed + 1e-9)
    if needed > 0:
        with pytest.raises(rc.GeometryError):
            rc.Spheres(centers, radii, overlap_tolerance=needed - 1e-9)
