"""A crack by updates of one factorization ↔ every share of the load solved anew; trees ↔ statics; symmetry ↔ ties."""

import numpy as np
import pytest
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

import rheoclast as rc
from rheoclast.generation import cluster_cluster, compacted_cluster, lattice_ball, random_packed_ball, ring

RADIUS = 0.5e-6
MATERIAL = rc.MATERIALS["polystyrene"]
FLOWS = {"shear": rc.simple_shear(1.0), "extension": rc.uniaxial_extension(1.0)}
CLUSTERS = {
    "ring": ring(9, RADIUS),
    "fcc": lattice_ball("fcc", 19, RADIUS),
    "packing": random_packed_ball(40, RADIUS, seed=2),
    "loose": compacted_cluster(60, RADIUS, amount=0.35, seed=3),
}


def setting(aggregate, model=None):
    model = rc.FreeDraining() if model is None else model
    return rc.rigid_response(aggregate.spheres, model, viscosity=1e-3), rc.jkr_bonds(aggregate, MATERIAL)


def chosen(bonds, kept):
    """Bonds of the contacts that are kept, one value per contact."""
    count = len(kept)
    stiffness, strength = bonds.stiffness(count)[kept], bonds.strength(count)[kept]
    return rc.Bonds(*stiffness.T, *strength.T)


def solved_anew(aggregate, response, bonds, flow, at_once):
    """The definition, one whole solution per step: contacts and rates of all failures, and the parts at the end."""
    kept = np.ones(len(aggregate.pairs), bool)
    loads, reached, failures = response.loads(flow), 0.0, []
    while True:
        pairs = aggregate.pairs[kept]
        graph = coo_array((np.ones(len(pairs)), pairs.T), shape=(len(aggregate),) * 2)
        count, parts = connected_components(graph, directed=False)
        if count > 1:
            return failures, parts
        carried = rc.contact_loads(rc.Aggregate(aggregate.spheres, pairs), loads, chosen(bonds, kept), "springs")
        ratio = carried.tension / chosen(bonds, kept).strength(len(pairs))[:, 0]
        if ratio.max() <= 0:
            return failures, parts
        reached = max(reached, 1 / ratio.max())
        failing = np.flatnonzero(ratio * reached >= 1 - 1e-9) if at_once else np.array([ratio.argmax()])
        numbers = np.flatnonzero(kept)[failing]
        failures += [(int(k), flow.rate / r) for k, r in zip(numbers, ratio[failing], strict=True)]
        kept[numbers] = False


@pytest.mark.parametrize("flow", FLOWS)
@pytest.mark.parametrize("name", ["packing", "loose"])
def test_sequence_is_that_of_solving_anew(name, flow):
    """Irregular clusters, where no two contacts tie."""
    aggregate = CLUSTERS[name]
    response, bonds = setting(aggregate)
    breakup = rc.break_up(aggregate, response, bonds, FLOWS[flow])
    expected, parts = solved_anew(aggregate, response, bonds, FLOWS[flow], at_once=False)
    assert [failure.contact for failure in breakup.failures] == [contact for contact, _ in expected]
    np.testing.assert_allclose(
        [failure.rate for failure in breakup.failures], [rate for _, rate in expected], rtol=1e-7
    )
    assert sorted(map(len, breakup.fragments)) == sorted(np.bincount(parts).tolist())
    assert breakup.splits == (parts.max() > 0)
    largest = max(rate for _, rate in expected) if breakup.splits else np.inf
    assert breakup.breakup_rate == pytest.approx(largest, rel=1e-7)


@pytest.mark.parametrize("name", CLUSTERS)
def test_all_overloaded_at_once(name):
    aggregate = CLUSTERS[name]
    response, bonds = setting(aggregate)
    breakup = rc.break_up(aggregate, response, bonds, FLOWS["extension"], rule="overloaded")
    expected, parts = solved_anew(aggregate, response, bonds, FLOWS["extension"], at_once=True)
    assert sorted(failure.contact for failure in breakup.failures) == sorted(contact for contact, _ in expected)
    assert sorted(map(len, breakup.fragments)) == sorted(np.bincount(parts).tolist())


@pytest.mark.parametrize("seed", range(4))
def test_tree_breaks_at_the_contact_that_statics_tells(seed):
    """One failure, at the rate of `initiation`, into the two sides of that contact."""
    aggregate = cluster_cluster(40, RADIUS, seed=seed)
    response, bonds = setting(aggregate, rc.StokesianDynamics())
    flow = rc.uniaxial_extension(2.0)
    breakup = rc.break_up(aggregate, response, bonds, flow)
    first = rc.initiation(rc.contact_response(aggregate, response), bonds, flow)
    assert breakup.is_single_bond
    assert breakup.failures[0].contact == first.contact
    assert breakup.initiation_rate == pytest.approx(first.rate, rel=1e-9)
    assert breakup.breakup_rate == breakup.initiation_rate
    assert len(breakup.fragments) == 2
    assert sum(map(len, breakup.fragments)) == 40


def test_symmetric_contacts_tie():
    """A ring across the axis of extension in its plane: contacts that mirror each other carry the same."""
    aggregate = ring(8, RADIUS)
    response, bonds = setting(aggregate)
    flow = rc.planar_extension(1.0)
    breakup = rc.break_up(aggregate, response, bonds, flow)
    assert breakup.failures[0].margin < 1e-9
    assert breakup.near_ties(1e-6)[0] == 0
    together = rc.break_up(aggregate, response, bonds, flow, rule="overloaded")
    assert len({round(failure.rate / breakup.initiation_rate, 9) for failure in together.failures[:2]}) == 1
