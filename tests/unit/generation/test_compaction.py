"""Compaction: every stage touches exactly, and the way leads from the tree to a close packing."""

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.generation.chains import bent_chain, straight_chain
from rheoclast.generation.compaction import compacted
from rheoclast.generation.lattices import lattice_ball
from rheoclast.particles.morphology import mean_coordination, radius_of_gyration


def random_tree(count, seed=0, radius=1.0):
    """Each sphere is put in contact with one of the last dozen, clear of all others: an open tree."""
    rng = np.random.default_rng(seed)
    centers = [np.zeros(3)]
    while len(centers) < count:
        mate, direction = centers[-rng.integers(1, min(len(centers), 12) + 1)], rng.normal(size=3)
        place = mate + 2 * direction / np.linalg.norm(direction)
        if np.sum(np.linalg.norm(np.array(centers) - place, axis=1) < 2.05) == 1:
            centers.append(place)
    return rc.Aggregate.touching(rc.Spheres(radius * np.array(centers), radius), 1e-9)


TREE = random_tree(120)


def extent(aggregate):
    """Contacts, and radius of gyration of the centres."""
    return np.array([len(aggregate.pairs), np.sqrt(radius_of_gyration(aggregate.spheres) ** 2 - 0.6)])


@pytest.mark.parametrize("amount", [0, 0.05, 0.3, 0.7, 1])
def test_every_stage_touches_exactly(assert_exactly_touching, amount):
    """In one part, without overlap, of the same number of spheres."""
    assert_exactly_touching(compacted(random_tree(120, radius=3e-8), amount), 120, 3e-8)


def test_the_way_leads_from_the_tree_to_a_close_packing():
    """Contacts rise and the radius of gyration falls; the end has a coordination above 5 and the size of a ball."""
    stages = [compacted(TREE, amount) for amount in np.linspace(0, 1, 9)]
    contacts, gyration = np.array([extent(stage) for stage in stages]).T
    assert contacts[0] == 119
    assert (np.diff(contacts) > 0).all()
    assert (np.diff(gyration) < 0).all()
    assert mean_coordination(stages[-1]) > 5
    close_packed_ball = np.sqrt(3 / 5) * np.cbrt(120 / 0.64)
    assert radius_of_gyration(stages[-1].spheres) < 1.05 * close_packed_ball


@pytest.mark.parametrize("amount", [0.1, 0.35, 0.8])
def test_amount_is_the_share_of_the_way(amount):
    """Mean of the shares of contacts gained and radius of gyration lost, met by the first move that reaches it."""
    start, stage, end = (extent(compacted(TREE, a, seed=4)) for a in (0, amount, 1))
    share = np.mean((stage - start) / (end - start))
    assert amount <= share < amount + 0.03


def test_nothing_moves_at_zero_and_one_sphere_first():
    """The stages begin with the given spheres; the smallest amount displaces one, into three contacts or two."""
    np.testing.assert_allclose(
        compacted(TREE, 0).spheres.centers, TREE.spheres.centers - TREE.spheres.center_of_mass, atol=1e-9
    )
    first = compacted(TREE, 1e-9)
    shift = first.spheres.centers - TREE.spheres.centers
    moved = np.linalg.norm(shift - np.median(shift, axis=0), axis=1) > 1e-9
    assert moved.sum() == 1
    assert len(first.pairs) in (120, 121)


def test_a_sphere_rolls_into_a_pocket_towards_the_centre_of_mass():
    """A fourth sphere beside a triangle closes a tetrahedron, the fifth a bipyramid: 9 contacts."""
    triangle = [[0, 0, 0], [2, 0, 0], [1, np.sqrt(3), 0]]
    tree = rc.Aggregate.touching(rc.Spheres([*triangle, [-2, 0, 0], [4, 0, 0]], 1.0), 1e-9)
    packed = compacted(tree, 1)
    assert len(packed.pairs) == 9


@pytest.mark.parametrize("chain", [straight_chain(25), bent_chain(25, bend=0.7, torsion=0.5)])
def test_chains_are_packed_too(assert_exactly_touching, chain):
    """Though only their ends can move at first, and symmetry leaves the direction open."""
    packed = compacted(chain, 1)
    assert_exactly_touching(packed, 25, 1.0)
    assert mean_coordination(packed) > 4.5
    assert radius_of_gyration(packed.spheres) < 1.1 * np.sqrt(3 / 5) * np.cbrt(25 / 0.64)


def test_seeds():
    """Equal seeds give equal stages, others not."""
    first, again, other = (compacted(TREE, 0.5, seed=s).spheres.centers for s in (1, 1, 2))
    np.testing.assert_array_equal(first, again)
    assert np.abs(first - other).max() > 0.1


def test_a_close_packing_stays_what_it_is():
    """The ball of 13 fcc spheres has no looser place to leave; two spheres have none to go to."""
    for aggregate in (lattice_ball("fcc", 13), straight_chain(2), straight_chain(1)):
        np.testing.assert_allclose(compacted(aggregate, 1).spheres.centers, aggregate.spheres.centers, atol=1e-9)


def test_contacts_open_by_rounding_are_closed(assert_exactly_touching):
    """As they come from a file with seven digits."""
    rough = rc.Aggregate(rc.Spheres(np.round(TREE.spheres.centers, 6), 1.0), TREE.pairs)
    closed = compacted(rough, 0)
    assert_exactly_touching(closed, 120, 1.0)
    np.testing.assert_array_equal(closed.pairs, TREE.pairs)
    np.testing.assert_allclose(closed.spheres.centers, TREE.spheres.centers - TREE.spheres.center_of_mass, atol=1e-5)


def test_bad_requests_are_refused():
    """With the reason."""
    with pytest.raises(ValueError, match=r"amount: expected a share from 0 to 1, got 1\.5"):
        compacted(TREE, 1.5)
    with pytest.raises(ValueError, match="amount: expected zero or a positive number, got -1"):
        compacted(TREE, -1)
    with pytest.raises(ValueError, match="seed: expected an integer"):
        compacted(TREE, 0.5, seed=0.5)
    unequal = rc.Aggregate.touching(rc.Spheres([[0, 0, 0], [2, 0, 0], [5, 0, 0]], [1.0, 1.0, 2.0]))
    with pytest.raises(ValueError, match="expected equal spheres, got radii 1 of sphere 0 and 2 of sphere 2"):
        compacted(unequal, 0.5)
    with pytest.raises(TypeError, match="aggregate: expected Aggregate, got Spheres"):
        compacted(TREE.spheres, 0.5)
    bipyramid = np.array([[0, 0, 0], [2, 0, 0], [1, np.sqrt(3), 0], [1, 1 / np.sqrt(3), 1.633], [1, 0.57735, -1.633]])
    every_pair = [[i, j] for i in range(5) for j in range(i + 1, 5)]
    with pytest.raises(rc.GeometryError, match=r"got a gap of .* radii that other contacts keep open; pass a tree"):
        compacted(rc.Aggregate(rc.Spheres(bipyramid, 1.0), every_pair), 0.5)
