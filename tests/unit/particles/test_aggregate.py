"""Aggregates: contacts, their geometry, and what is refused."""

import dataclasses

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.particles.aggregate import Aggregate

FCC_13 = np.array(
    [[0, 0, 0]]
    + [[x, y, z] for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1) if abs(x) + abs(y) + abs(z) == 2]
) * np.sqrt(2.0)


def touching_tree(seed, count=30):
    """Polydisperse tree: each sphere is put in contact with a random earlier one, clear of all others."""
    rng = np.random.default_rng(seed)
    centers, radii, pairs = [np.zeros(3)], [1.0], []
    while len(centers) < count:
        mate, radius = int(rng.integers(len(centers))), float(rng.uniform(0.3, 2.0))
        direction = rng.normal(size=3)
        place = centers[mate] + (radii[mate] + radius) * direction / np.linalg.norm(direction)
        gaps = [
            np.linalg.norm(place - c) - radius - a
            for k, (c, a) in enumerate(zip(centers, radii, strict=True))
            if k != mate
        ]
        if not gaps or min(gaps) > 0.05:
            pairs.append((mate, len(centers)))
            centers.append(place)
            radii.append(radius)
    return np.array(centers), np.array(radii), sorted(pairs)


@pytest.mark.parametrize("seed", range(3))
def test_contacts_of_a_polydisperse_tree(seed):
    """The contacts are those it was built with; N − 1 contacts make it isostatic."""
    centers, radii, pairs = touching_tree(seed)
    aggregate = rc.Aggregate.touching(rc.Spheres(1e-6 * centers, 1e-6 * radii))
    assert [tuple(pair) for pair in aggregate.pairs.tolist()] == pairs
    assert aggregate.hyperstaticity == 0
    assert aggregate.is_tree
    assert len(aggregate) == 30


@pytest.mark.parametrize("seed", range(3))
def test_contact_point_lies_on_both_surfaces(seed):
    """At distance a_i from x_i along n, and a_j from x_j against it; n is a unit vector from i to j."""
    centers, radii, _ = touching_tree(seed)
    aggregate = rc.Aggregate.touching(rc.Spheres(centers, radii))
    for (i, j), normal, point in zip(aggregate.pairs, aggregate.normals, aggregate.contact_points, strict=True):
        assert i < j
        assert np.linalg.norm(normal) == pytest.approx(1.0, rel=1e-14)
        np.testing.assert_allclose(point, centers[i] + radii[i] * normal, atol=1e-12)
        np.testing.assert_allclose(point, centers[j] - radii[j] * normal, atol=1e-12)


@pytest.mark.parametrize("offset", [0.04, -0.04])
def test_contact_point_is_midway_in_a_gap_or_overlap(offset):
    """Equally far from both surfaces, on the line of centres, for unequal spheres."""
    spheres = rc.Spheres([[0, 0, 0], [0, 4 + offset, 0]], [1.0, 3.0], overlap_tolerance=0.1)
    (point,) = rc.Aggregate.touching(spheres, tolerance=0.1).contact_points
    np.testing.assert_allclose(point, [0, 1 + offset / 2, 0], atol=1e-15)


@pytest.mark.parametrize("radii", [(1.0, 1.0), (1.0, 3.0), (2e-7, 5e-6)])
@pytest.mark.parametrize("tolerance", [1e-3, 0.2])
def test_contact_just_inside_and_outside_the_tolerance(radii, tolerance):
    """The tolerance is a fraction of the mean radius of the pair."""
    for fraction, touches in ((0.999, True), (1.001, False)):
        spheres = rc.Spheres([[0, 0, 0], [sum(radii) + fraction * tolerance * np.mean(radii), 0, 0]], radii)
        if touches:
            assert rc.Aggregate.touching(spheres, tolerance).pairs.tolist() == [[0, 1]]
        else:
            with pytest.raises(rc.GeometryError, match="in 2 parts"):
                rc.Aggregate.touching(spheres, tolerance)


def test_known_contact_numbers():
    """A ring closes one loop; a tetrahedron has 6 contacts; 13 spheres of an fcc lattice have 36."""
    angle = 2 * np.pi * np.arange(8) / 8
    ring = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1) / np.sin(np.pi / 8)
    aggregate = rc.Aggregate.touching(rc.Spheres(ring, 1.0))
    assert len(aggregate.pairs) == 8
    assert aggregate.hyperstaticity == 6
    assert not aggregate.is_tree
    tetrahedron = np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) / np.sqrt(2)
    assert len(rc.Aggregate.touching(rc.Spheres(tetrahedron, 1.0)).pairs) == 6
    compact = rc.Aggregate.touching(rc.Spheres(FCC_13, 1.0))
    assert len(compact.pairs) == 36
    assert compact.hyperstaticity == 6 * (36 - 13 + 1)


def test_one_sphere_is_an_aggregate_without_contacts():
    """Empty arrays of the right shapes, and a tree."""
    aggregate = rc.Aggregate.touching(rc.Spheres([[1.0, 2.0, 3.0]], 1e-6))
    assert aggregate.pairs.shape == (0, 2)
    assert aggregate.normals.shape == (0, 3)
    assert aggregate.contact_points.shape == (0, 3)
    assert aggregate.hyperstaticity == 0
    assert aggregate.is_tree
    assert rc.Aggregate(aggregate.spheres, []).pairs.shape == (0, 2)


def test_given_pairs_are_sorted_within_the_pair():
    """(2, 1) is the contact (1, 2); the order of contacts stays the caller's."""
    spheres = rc.Spheres([[0, 0, 0], [2, 0, 0], [4, 0, 0]], 1.0)
    given = np.array([[2, 1], [1, 0]])
    aggregate = rc.Aggregate(spheres, given)
    assert aggregate.pairs.tolist() == [[1, 2], [0, 1]]
    np.testing.assert_array_equal(aggregate.normals, [[1.0, 0, 0], [1.0, 0, 0]])
    assert given.tolist() == [[2, 1], [1, 0]]


def test_touching_leaves_no_order_to_chance():
    """Contacts come in lexicographic order."""
    aggregate = rc.Aggregate.touching(rc.Spheres(FCC_13, 1.0))
    assert aggregate.pairs.tolist() == sorted(aggregate.pairs.tolist())


def test_aggregate_is_frozen():
    """Neither the pairs nor the attribute can be changed."""
    pairs = np.array([[0, 1]])
    aggregate = rc.Aggregate(rc.Spheres([[0, 0, 0], [2, 0, 0]], 1.0), pairs)
    pairs[0, 1] = 0
    assert aggregate.pairs.tolist() == [[0, 1]]
    with pytest.raises(dataclasses.FrozenInstanceError):
        aggregate.pairs = pairs
    with pytest.raises(ValueError, match="read-only"):
        aggregate.pairs[0, 0] = 1


@pytest.mark.parametrize(
    ("pairs", "message"),
    [
        ([[0, 1], [1, 3]], r"^pairs\[1\] = \[1, 3\]: expected indices of spheres from 0 to 2$"),
        ([[0, 1], [-1, 2]], r"^pairs\[1\] = \[-1, 2\]: expected indices of spheres from 0 to 2$"),
        ([[0, 1], [2, 2]], r"^pairs\[1\] = \[2, 2\]: expected two different spheres$"),
        ([[0, 1], [1, 2], [1, 0]], r"^pairs\[2\] = \[1, 0\]: this contact is already in the list; give it once$"),
        ([[0.0, 1.0]], r"^pairs: expected integers of shape \(C, 2\), got float64 of shape \(1, 2\)$"),
        ([0, 1], r"^pairs: expected integers of shape \(C, 2\), got int64 of shape \(2,\)$"),
        ([[0, 1, 2]], r"^pairs: expected integers of shape \(C, 2\), got int64 of shape \(1, 3\)$"),
    ],
)
def test_refused_pairs(pairs, message):
    """Indices, repetitions and shapes are checked, and the contact is named as the caller gave it."""
    spheres = rc.Spheres([[0, 0, 0], [2, 0, 0], [4, 0, 0]], 1.0)
    with pytest.raises(ValueError, match=message):
        rc.Aggregate(spheres, pairs)


def test_refused_tolerance():
    """A contact tolerance is zero or positive."""
    with pytest.raises(ValueError, match=r"^tolerance: expected zero or a positive number, got -1$"):
        rc.Aggregate.touching(rc.Spheres([[0, 0, 0]], 1.0), tolerance=-1)


def test_a_loose_sphere_is_named():
    """The message names the loose sphere, the nearest other one and the tolerance that would join them."""
    spheres = rc.Spheres([[0, 0, 0], [2, 0, 0], [4.25, 0, 0]], 1.0)
    with pytest.raises(
        rc.GeometryError,
        match=r"^the aggregate is in 2 parts, expected one: sphere 2 \(1 of 3\) touches no other part; "
        r"nearest are spheres 2 and 1 with a gap of 0\.25 mean radii; "
        r"raise the contact tolerance above it or remove the loose part$",
    ):
        rc.Aggregate.touching(spheres)
    assert rc.Aggregate.touching(spheres, tolerance=0.250001).is_tree


def test_a_long_loose_part_is_abbreviated():
    """At most eight spheres are listed; the smallest part is the loose one."""
    line = [[2.0 * k, 0, 0] for k in range(10)]
    other = [[2.0 * k, 5, 0] for k in range(12)]
    with pytest.raises(
        rc.GeometryError,
        match=r"in 2 parts, expected one: spheres 0, 1, 2, 3, 4, 5, 6, 7, … \(10 of 22\) touch no other part; "
        r"nearest are spheres (\d) and 1\1 with a gap of 3 mean radii; "
        r"are these several aggregates, or one cut by a periodic box\?",
    ):
        rc.Aggregate.touching(rc.Spheres(line + other, 1.0))


def test_no_contacts_at_all():
    """Given no pairs, every sphere is a part of its own."""
    with pytest.raises(rc.GeometryError, match=r"in 3 parts, expected one: sphere 0 \(1 of 3\) touches no other part"):
        Aggregate(rc.Spheres([[0, 0, 0], [2, 0, 0], [4, 0, 0]], 1.0), np.empty((0, 2), dtype=int))


def test_nearest_surface_is_named_among_very_unequal_spheres():
    """The nearest surface may belong to a large sphere whose centre is farther than twenty small ones.

    Sphere 0 is loose. The surface of the large sphere 1 is 0.5 away, 0.0196 mean radii of 25.5; the small spheres
    are more than 5 radii off. The tolerance that the message offers must be the one that joins the parts.
    """
    angle = 2 * np.pi * np.arange(20) / 20
    small = np.stack([np.full(20, -3.0), 10 * np.cos(angle), 10 * np.sin(angle)], axis=1)
    spheres = rc.Spheres(np.vstack([[[0, 0, 0], [51.5, 0, 0]], small]), [1.0, 50.0] + [1.0] * 20)
    with pytest.raises(rc.GeometryError, match=r"nearest are spheres 0 and 1 with a gap of 0\.0196 mean radii"):
        rc.Aggregate(spheres, [[1, k] for k in range(2, 22)])
