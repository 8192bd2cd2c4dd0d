"""Laws that contact loads obey, each written out from its definition: equilibrium, invariance, least energy."""

import numpy as np
import pytest
from scipy.linalg import null_space
from scipy.spatial.transform import Rotation

import rheoclast as rc

FCC_13 = np.array(
    [[0, 0, 0]]
    + [[x, y, z] for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1) if abs(x) + abs(y) + abs(z) == 2]
) * np.sqrt(2.0)


def chain(count):
    """Straight chain of equal spheres of radius 1 along a direction that favours no axis."""
    return rc.Aggregate.touching(rc.Spheres(2.0 * np.arange(count)[:, None] * np.array([[2, -1, 2]]) / 3, 1.0))


def ring(count):
    """Regular polygon of equal spheres of radius 1."""
    angle = 2 * np.pi * np.arange(count) / count
    corners = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    return rc.Aggregate.touching(rc.Spheres(corners / np.sin(np.pi / count), 1.0))


def polydisperse_tree(count, seed):
    """Each sphere, of radius 0.4 to 2, is put in contact with a random earlier one, clear of all others."""
    rng = np.random.default_rng(seed)
    centers, radii = [np.zeros(3)], [1.0]
    while len(centers) < count:
        mate, radius, direction = int(rng.integers(len(centers))), float(rng.uniform(0.4, 2.0)), rng.normal(size=3)
        place = centers[mate] + (radii[mate] + radius) * direction / np.linalg.norm(direction)
        gaps = np.linalg.norm(np.array(centers) - place, axis=1) - np.array(radii) - radius
        gaps[mate] = np.inf
        if gaps.min() > 0.05:
            centers.append(place)
            radii.append(radius)
    return rc.Aggregate.touching(rc.Spheres(np.array(centers), np.array(radii)))


def polydisperse_cluster(seed):
    """Fourteen unequal spheres near the sites of a cubic lattice, with gaps and overlaps up to a tenth of a radius."""
    rng = np.random.default_rng(seed)
    sites = 2.0 * np.array([[x, y, z] for x in range(3) for y in range(3) for z in range(2)], dtype=float)
    sites = sites[np.sort(rng.permutation(18)[:14])] + rng.uniform(-0.03, 0.03, (14, 3))
    spheres = rc.Spheres(sites, rng.uniform(0.95, 1.05, 14), overlap_tolerance=0.3)
    return rc.Aggregate.touching(spheres, tolerance=0.3)


AGGREGATES = {
    "doublet": lambda: chain(2),
    "chain of 20": lambda: chain(20),
    "polydisperse tree": lambda: polydisperse_tree(40, seed=1),
    "ring of 8": lambda: ring(8),
    "fcc 13": lambda: rc.Aggregate.touching(rc.Spheres(FCC_13, 1.0)),
    "polydisperse cluster": lambda: polydisperse_cluster(2),
}
LOOPED = ["ring of 8", "fcc 13", "polydisperse cluster"]


@pytest.fixture(params=AGGREGATES)
def aggregate(request):
    return AGGREGATES[request.param]()


@pytest.fixture(params=LOOPED)
def looped(request):
    return AGGREGATES[request.param]()


def balanced_loads(aggregate, seed, batch=()):
    """Random loads of order one whose total force and torque vanish."""
    rng = np.random.default_rng(seed)
    force, torque = rng.normal(size=(2, *batch, len(aggregate), 3))
    force = force - force.mean(axis=-2, keepdims=True)
    total = (np.cross(aggregate.spheres.centers, force) + torque).sum(axis=-2, keepdims=True)
    return rc.SphereLoads(force, torque - total / len(aggregate))


def random_bonds(aggregate, seed, decades=3.0):
    """Stiffnesses spread evenly over decades, per contact and per spring (radii are of order one)."""
    rng = np.random.default_rng(seed)
    stiffness = 10 ** rng.uniform(-decades / 2, decades / 2, (4, len(aggregate.pairs)))
    return rc.Bonds(normal=stiffness[0], tangential=stiffness[1], bending=stiffness[2], twisting=stiffness[3])


def scaled_bonds(bonds, force_per_length, torque):
    """The same springs in other units, or all stiffer."""
    return rc.Bonds(
        normal=bonds.normal * force_per_length,
        tangential=bonds.tangential * force_per_length,
        bending=bonds.bending * torque,
        twisting=bonds.twisting * torque,
    )


def largest(carried):
    """Largest component of any contact force or moment (radii of order one)."""
    return max(np.abs(carried.force).max(), np.abs(carried.moment).max())


def assert_same(carried, force, moment, tolerance):
    """Contact loads equal within a fraction of the largest of them."""
    size = max(np.abs(force).max(), np.abs(moment).max())
    np.testing.assert_allclose(carried.force, force, rtol=0, atol=tolerance * size)
    np.testing.assert_allclose(carried.moment, moment, rtol=0, atol=tolerance * size)


def unbalanced(aggregate, loads, carried):
    """Largest force and torque left over on any sphere, summed contact by contact, torque about its own centre."""
    centers, points = aggregate.spheres.centers, aggregate.contact_points
    force, torque = loads.force.copy(), loads.torque.copy()
    for c, (i, j) in enumerate(aggregate.pairs):
        force[i] += carried.force[c]
        torque[i] += carried.moment[c] + np.cross(points[c] - centers[i], carried.force[c])
        force[j] -= carried.force[c]
        torque[j] -= carried.moment[c] + np.cross(points[c] - centers[j], carried.force[c])
    return max(np.abs(force).max(), np.abs(torque).max())


def equilibrium_matrix(aggregate):
    """Matrix (6 N, 6 C) from contact forces and moments to the force and torque they put on every sphere."""
    spheres, contacts = len(aggregate), len(aggregate.pairs)
    matrix = np.zeros((spheres, 6, contacts, 6))
    for c, pair in enumerate(aggregate.pairs):
        for sphere, sign in zip(pair, (1.0, -1.0), strict=True):
            arm = aggregate.contact_points[c] - aggregate.spheres.centers[sphere]
            matrix[sphere, :, c, :] = sign * np.eye(6)
            for axis in range(3):
                matrix[sphere, 3:, c, axis] = sign * np.cross(arm, np.eye(3)[axis])
    return matrix.reshape(6 * spheres, 6 * contacts)


def complementary_energy(aggregate, bonds, first, second):
    """Σ over all springs of load · load / stiffness, of two sets of contact loads (C, 6)."""
    energy = 0.0
    for c, normal in enumerate(aggregate.normals):
        for columns, along, across in (
            (slice(0, 3), bonds.normal, bonds.tangential),
            (slice(3, 6), bonds.twisting, bonds.bending),
        ):
            one, two = first[c, columns], second[c, columns]
            parallel = (one @ normal) * (two @ normal)
            energy += parallel / along[c] + (one @ two - parallel) / across[c]
    return energy


@pytest.mark.parametrize("seed", range(3))
def test_every_sphere_is_in_equilibrium(aggregate, seed):
    """Load, contact forces and contact moments balance on each sphere, whatever the springs."""
    loads = balanced_loads(aggregate, seed)
    carried = rc.contact_loads(aggregate, loads, random_bonds(aggregate, seed))
    assert unbalanced(aggregate, loads, carried) < 1e-10 * largest(carried)


@pytest.mark.parametrize("seed", range(3))
def test_springs_leave_every_sphere_in_equilibrium(aggregate, seed):
    """The same when trees are solved by springs too, with stiffnesses over six decades."""
    loads = balanced_loads(aggregate, seed)
    carried = rc.contact_loads(aggregate, loads, random_bonds(aggregate, seed, decades=6), method="springs")
    assert unbalanced(aggregate, loads, carried) < 1e-10 * largest(carried)


@pytest.mark.parametrize(
    "tree",
    [chain(2), chain(20), chain(200), polydisperse_tree(40, seed=3), polydisperse_tree(150, seed=4)],
    ids=["doublet", "chain of 20", "chain of 200", "tree of 40", "tree of 150"],
)
@pytest.mark.parametrize("seed", range(3))
def test_springs_equal_statics_on_a_tree(tree, seed):
    """An isostatic structure carries its loads by balance alone: stiffnesses over six decades make no difference."""
    loads = balanced_loads(tree, seed)
    balance = rc.contact_loads(tree, loads, method="statics")
    springs = rc.contact_loads(tree, loads, random_bonds(tree, seed, decades=6), method="springs")
    assert_same(springs, balance.force, balance.moment, 1e-9)


def test_statics_of_a_tree_by_cutting_it():
    """Each contact carries the resultant of all loads on the side of sphere j, about the contact point."""
    tree = polydisperse_tree(60, seed=5)
    loads, centers = balanced_loads(tree, 6), tree.spheres.centers
    carried = rc.contact_loads(tree, loads)
    for c, (_, j) in enumerate(tree.pairs):
        side, others = {int(j)}, [tuple(pair) for k, pair in enumerate(tree.pairs.tolist()) if k != c]
        for _ in others:
            side |= {b for a, b in others if a in side} | {a for a, b in others if b in side}
        force = sum(loads.force[k] for k in side)
        moment = sum(loads.torque[k] + np.cross(centers[k] - tree.contact_points[c], loads.force[k]) for k in side)
        np.testing.assert_allclose(carried.force[c], force, atol=1e-11 * largest(carried))
        np.testing.assert_allclose(carried.moment[c], moment, atol=1e-11 * largest(carried))


@pytest.mark.parametrize("parity", [1, -1], ids=["rotation", "reflection"])
def test_turning_shifting_and_mirroring(aggregate, parity):
    """Forces turn like vectors, moments like axial vectors; a shift changes nothing; four scalars stay."""
    turn = parity * Rotation.from_rotvec([1.2, -0.5, 2.0]).as_matrix()
    spheres = aggregate.spheres
    moved = rc.Aggregate(
        rc.Spheres(spheres.centers @ turn.T + [30.0, -50.0, 20.0], spheres.radii, spheres.overlap_tolerance),
        aggregate.pairs,
    )
    loads, bonds = balanced_loads(aggregate, 1), random_bonds(aggregate, 2)
    before = rc.contact_loads(aggregate, loads, bonds)
    turned = rc.SphereLoads(loads.force @ turn.T, parity * loads.torque @ turn.T)
    after = rc.contact_loads(moved, turned, bonds)
    assert_same(after, before.force @ turn.T, parity * before.moment @ turn.T, 1e-10)
    np.testing.assert_allclose(after.tension, before.tension, atol=1e-10 * largest(before))
    np.testing.assert_allclose(after.shear, before.shear, atol=1e-10 * largest(before))
    np.testing.assert_allclose(after.bending, before.bending, atol=1e-10 * largest(before))
    np.testing.assert_allclose(after.twisting, parity * before.twisting, atol=1e-10 * largest(before))


def test_far_from_the_origin(aggregate):
    """Balance is a property of the loads, not of the origin: 10⁵ radii away only rounding of positions shows."""
    loads, bonds = balanced_loads(aggregate, 3), random_bonds(aggregate, 4)
    here = rc.contact_loads(aggregate, loads, bonds)
    spheres = aggregate.spheres
    centers = spheres.centers + np.array([1e5, -2e5, 1e5])
    away = rc.Aggregate(rc.Spheres(centers, spheres.radii, spheres.overlap_tolerance), aggregate.pairs)
    assert_same(rc.contact_loads(away, loads, bonds), here.force, here.moment, 1e-7)


@pytest.mark.parametrize(("length", "force"), [(1e-6, 1e-12), (1e-9, 1e-15), (1e3, 1e6)])
def test_change_of_units(aggregate, length, force):
    """In other units of length and force the numbers change by those units and nothing else."""
    spheres, loads, bonds = aggregate.spheres, balanced_loads(aggregate, 1), random_bonds(aggregate, 2)
    plain = rc.contact_loads(aggregate, loads, bonds)
    small = rc.Aggregate(
        rc.Spheres(length * spheres.centers, length * spheres.radii, spheres.overlap_tolerance), aggregate.pairs
    )
    scaled = rc.contact_loads(
        small,
        rc.SphereLoads(force * loads.force, force * length * loads.torque),
        scaled_bonds(bonds, force / length, force * length),
    )
    size = largest(plain)
    np.testing.assert_allclose(scaled.force / force, plain.force, rtol=0, atol=1e-10 * size)
    np.testing.assert_allclose(scaled.moment / (force * length), plain.moment, rtol=0, atol=1e-10 * size)


def test_superposition_and_batches(aggregate):
    """A batch holds its load cases one by one, and sums of load cases give sums of contact loads."""
    loads, bonds = balanced_loads(aggregate, 1, batch=(2, 3)), random_bonds(aggregate, 2)
    batch = rc.contact_loads(aggregate, loads, bonds)
    contacts = len(aggregate.pairs)
    assert batch.force.shape == batch.moment.shape == (2, 3, contacts, 3)
    for scalar in (batch.tension, batch.shear, batch.bending, batch.twisting):
        assert scalar.shape == (2, 3, contacts)
    weights = np.array([[2.0, -1.0, 0.5], [0.0, 3.0, -4.0]])
    for index in np.ndindex(2, 3):
        single = rc.contact_loads(aggregate, rc.SphereLoads(loads.force[index], loads.torque[index]), bonds)
        assert_same(single, batch.force[index], batch.moment[index], 1e-11)
        np.testing.assert_allclose(batch.tension[index], single.tension, atol=1e-11 * largest(single))
    combined = rc.SphereLoads(
        np.einsum("ab,abik->ik", weights, loads.force), np.einsum("ab,abik->ik", weights, loads.torque)
    )
    assert_same(
        rc.contact_loads(aggregate, combined, bonds),
        np.einsum("ab,abik->ik", weights, batch.force),
        np.einsum("ab,abik->ik", weights, batch.moment),
        1e-10,
    )


def test_numbering_of_spheres_does_not_matter(aggregate):
    """Renumbered spheres: where i and j change places, normal, force and moment change sign and tension stays."""
    order = np.random.default_rng(3).permutation(len(aggregate))
    number = np.argsort(order)  # new number of each old sphere
    spheres, loads, bonds = aggregate.spheres, balanced_loads(aggregate, 1), random_bonds(aggregate, 2)
    before = rc.contact_loads(aggregate, loads, bonds)
    renumbered = rc.Aggregate(
        rc.Spheres(spheres.centers[order], spheres.radii[order], spheres.overlap_tolerance), number[aggregate.pairs]
    )
    after = rc.contact_loads(renumbered, rc.SphereLoads(loads.force[order], loads.torque[order]), bonds)
    sign = np.where(number[aggregate.pairs[:, 0]] < number[aggregate.pairs[:, 1]], 1.0, -1.0)[:, None]
    assert len(aggregate) < 3 or (sign < 0).any()
    assert_same(after, sign * before.force, sign * before.moment, 1e-10)
    np.testing.assert_allclose(after.tension, before.tension, atol=1e-10 * largest(before))
    np.testing.assert_allclose(after.twisting, before.twisting, atol=1e-10 * largest(before))


def test_numbering_of_contacts_does_not_matter(looped):
    """Contacts given in another order, with their bonds, carry the same loads."""
    order = np.random.default_rng(4).permutation(len(looped.pairs))
    loads, bonds = balanced_loads(looped, 1), random_bonds(looped, 2)
    before = rc.contact_loads(looped, loads, bonds)
    shuffled = rc.Bonds(
        normal=bonds.normal[order],
        tangential=bonds.tangential[order],
        bending=bonds.bending[order],
        twisting=bonds.twisting[order],
    )
    after = rc.contact_loads(rc.Aggregate(looped.spheres, looped.pairs[order, ::-1]), loads, shuffled)
    assert_same(after, before.force[order], before.moment[order], 1e-10)


@pytest.mark.parametrize("factor", [1e-8, 1e8])
def test_only_ratios_of_stiffness_matter(looped, factor):
    """All springs stiffer by one factor share the loads as before."""
    loads, bonds = balanced_loads(looped, 1), random_bonds(looped, 2)
    before = rc.contact_loads(looped, loads, bonds)
    after = rc.contact_loads(looped, loads, scaled_bonds(bonds, factor, factor))
    assert_same(after, before.force, before.moment, 1e-10)


def test_stiffness_matters_where_there_are_loops(looped):
    """The counterpart of the test on trees: other ratios, other loads."""
    loads = balanced_loads(looped, 1)
    one, two = (rc.contact_loads(looped, loads, random_bonds(looped, seed)) for seed in (2, 3))
    assert np.abs(one.force - two.force).max() > 0.01 * largest(one)


@pytest.mark.parametrize("seed", range(3))
def test_complementary_energy_is_least(looped, seed):
    """Of all contact loads in balance, the springs choose those of least Σ f²/k (Castigliano; Menabrea).

    Self-stresses are the null space of the equilibrium matrix; there are as many as the degree of hyperstaticity.
    The first variation vanishes along every one of them, so any of them adds its own energy.
    """
    loads, bonds = balanced_loads(looped, seed), random_bonds(looped, seed, decades=2)
    carried = rc.contact_loads(looped, loads, bonds)
    solution = np.concatenate([carried.force, carried.moment], axis=1)
    self_stress = null_space(equilibrium_matrix(looped)).T.reshape(-1, len(looped.pairs), 6)
    assert len(self_stress) == looped.hyperstaticity
    stored = complementary_energy(looped, bonds, solution, solution)
    for stress in self_stress:
        own = complementary_energy(looped, bonds, stress, stress)
        assert abs(complementary_energy(looped, bonds, solution, stress)) < 1e-10 * np.sqrt(own * stored)
    rng = np.random.default_rng(seed)
    for size in (1e-3, 1.0):
        other = solution + size * np.einsum("s,scx->cx", rng.normal(size=len(self_stress)), self_stress)
        assert complementary_energy(looped, bonds, other, other) > stored


def test_energy_from_the_four_scalars(looped):
    """Tension, shear, bending and twisting hold all of the load: their energy is that of the vectors."""
    loads, bonds = balanced_loads(looped, 1), random_bonds(looped, 2)
    carried = rc.contact_loads(looped, loads, bonds)
    vectors = np.concatenate([carried.force, carried.moment], axis=1)
    by_scalars = np.sum(
        carried.tension**2 / bonds.normal
        + carried.shear**2 / bonds.tangential
        + carried.bending**2 / bonds.bending
        + carried.twisting**2 / bonds.twisting
    )
    assert by_scalars == pytest.approx(complementary_energy(looped, bonds, vectors, vectors), rel=1e-12)


def test_a_contact_without_stiffness_carries_nothing():
    """A ring whose last contact is 10⁻¹³ times as stiff is an open chain, known from statics.

    The remaining load is of order 10⁻¹³ times the ratio of the chain's compliance to the contact's, about 10³ here.
    """
    closed = ring(8)
    loads = balanced_loads(closed, 1)
    opened = rc.Aggregate(closed.spheres, closed.pairs[1:])
    expected = rc.contact_loads(opened, loads, method="statics")
    stiffness = np.where(np.arange(8) == 0, 1e-13, 1.0)
    bonds = rc.Bonds(normal=stiffness, tangential=stiffness, bending=stiffness, twisting=stiffness)
    carried = rc.contact_loads(closed, loads, bonds)
    np.testing.assert_allclose(carried.force[1:], expected.force, atol=1e-9 * largest(expected))
    np.testing.assert_allclose(carried.moment[1:], expected.moment, atol=1e-9 * largest(expected))
    assert np.abs(carried.force[0]).max() < 1e-9 * largest(expected)


def test_loads_at_rest_are_zero(aggregate):
    """No load, no stress: nothing is locked in."""
    zeros = np.zeros((len(aggregate), 3))
    carried = rc.contact_loads(aggregate, rc.SphereLoads(zeros, zeros), random_bonds(aggregate, 1))
    np.testing.assert_array_equal(carried.force, 0.0)
    np.testing.assert_array_equal(carried.moment, 0.0)
