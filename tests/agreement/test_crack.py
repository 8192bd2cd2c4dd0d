"""A crack by updates of one factorization ↔ every share of the load solved anew; trees ↔ statics; symmetry ↔ ties."""

from dataclasses import replace
from itertools import chain

import numpy as np
import pytest
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

import rheoclast as rc
from rheoclast.generation import cluster_cluster, compacted_cluster, lattice_ball, random_packed_ball, ring
from rheoclast.hydrodynamics.truncation import FORCE
from rheoclast.mechanics.loosened import loosenable

RADIUS = 0.5e-6
MATERIAL = rc.MATERIALS["polystyrene"]
ASKEW = rc.random_orientations(1, seed=1)[0]
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


def tension_alone(tension, shear, bending, twisting):
    return tension


def steps(aggregate, response, bonds, flow, at_once=False, ratio_of=tension_alone):
    """The definition, one whole solution per step: contacts kept, those that fail and their rates; then the parts.

    `ratio_of` makes one load ratio of tension, shear, bending and twisting over their strengths.
    """
    kept = np.ones(len(aggregate.pairs), bool)
    loads, reached = response.loads(flow), 0.0
    while True:
        pairs = aggregate.pairs[kept]
        graph = coo_array((np.ones(len(pairs)), pairs.T), shape=(len(aggregate),) * 2)
        count, parts = connected_components(graph, directed=False)
        if count > 1:
            return parts
        carried = rc.contact_loads(rc.Aggregate(aggregate.spheres, pairs), loads, chosen(bonds, kept), "springs")
        ratio = ratio_of(*relative_loads(carried, chosen(bonds, kept).strength(len(pairs))))
        if ratio.max() <= 0:
            return parts
        reached = max(reached, 1 / ratio.max())
        failing = np.flatnonzero(ratio * reached >= 1 - 1e-9) if at_once else np.array([ratio.argmax()])
        numbers = np.flatnonzero(kept)[failing]
        yield kept.copy(), numbers, flow.rate / ratio[failing]
        kept[numbers] = False


def relative_loads(carried, strength):
    """Tension, shear, bending and size of twisting over strengths (C, 4)."""
    parts = carried.tension, carried.shear, carried.bending, abs(carried.twisting)
    return [load / limit for load, limit in zip(parts, strength.T, strict=True)]


def solved_anew(*setting, **options):
    """Contacts and rates of all failures, and the parts at the end."""
    failures, sequence = [], steps(*setting, **options)
    while True:
        try:
            _, contacts, rates = next(sequence)
        except StopIteration as end:
            return failures, end.value
        failures += zip(contacts.tolist(), rates.tolist(), strict=True)


@pytest.mark.parametrize("flow", FLOWS)
@pytest.mark.parametrize("name", ["packing", "loose"])
def test_sequence_is_that_of_solving_anew(name, flow):
    """Irregular clusters, where no two contacts tie."""
    aggregate = CLUSTERS[name]
    response, bonds = setting(aggregate)
    breakup = rc.break_up(aggregate, response, bonds, FLOWS[flow])
    expected, parts = solved_anew(aggregate, response, bonds, FLOWS[flow])
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


RATIOS = {
    "tension": (rc.Tension(), tension_alone),
    "sliding": (rc.Sliding(), lambda t, s, b, w: s),
    "friction": (rc.Sliding(0.7), lambda t, s, b, w: np.maximum(s + 0.7 * t, 0)),
    "rolling": (rc.Rolling(), lambda t, s, b, w: b),
    "twisting": (rc.Twisting(), lambda t, s, b, w: w),
    "sum": (rc.Combined(1), lambda t, s, b, w: np.maximum(t, 0) + s + b + w),
    "squares": (rc.Combined(2), lambda t, s, b, w: np.sqrt(np.maximum(t, 0) ** 2 + s**2 + b**2 + w**2)),
    "any of": (rc.Tension() | rc.Rolling(), lambda t, s, b, w: np.maximum(t, b)),
    "every limit": (rc.EVERY_LIMIT, lambda t, s, b, w: np.max([t, s, b, w], axis=0)),
}


def of_many_strengths(aggregate, seed, spread=1.0):
    """Bonds of the material with unlike strengths of all four kinds; shear as strong as tension, as friction needs."""
    bonds = rc.jkr_bonds(aggregate, MATERIAL)
    decades = np.random.default_rng(seed).uniform(-spread, 0, (3, len(aggregate.pairs)))
    tensile, bending, twisting = bonds.tensile_strength * 10**decades
    moment = 0.1 * RADIUS
    return replace(
        bonds,
        tensile_strength=tensile,
        shear_strength=tensile,
        bending_strength=moment * bending,
        twisting_strength=moment * twisting,
    )


@pytest.mark.parametrize("at_once", [False, True], ids=["weakest", "overloaded"])
@pytest.mark.parametrize("name", RATIOS)
def test_sequence_by_every_criterion_is_that_of_solving_anew(name, at_once):
    """Contacts of unlike strength, to the last failure."""
    aggregate, (criterion, ratio_of) = lattice_ball("fcc", 55, RADIUS), RATIOS[name]
    bonds, flow = of_many_strengths(aggregate, seed=6, spread=0.5), rc.simple_shear(1.0)
    response = rc.rigid_response(aggregate.spheres, rc.FreeDraining(), viscosity=1e-3)
    rule = "overloaded" if at_once else "weakest"
    breakup = rc.break_up(aggregate, response, bonds, flow, rule=rule, criterion=criterion)
    expected, parts = solved_anew(aggregate, response, bonds, flow, at_once=at_once, ratio_of=ratio_of)
    assert len(expected) >= 5
    found = [(failure.contact, failure.rate) for failure in breakup.failures]
    if at_once:
        found, expected = sorted(found), sorted(expected)
    assert [contact for contact, _ in found] == [contact for contact, _ in expected]
    np.testing.assert_allclose([rate for _, rate in found], [rate for _, rate in expected], rtol=1e-7)
    assert sorted(map(len, breakup.spheres)) == sorted(np.bincount(parts).tolist())


def expected_margins_and_rivals(aggregate, response, bonds, flow, kept, failing):
    """Of each contact that fails in a step: lead over the next that holds; those that hold, but are behind by less than
    what the orders tell of the error of that difference.
    """
    rest = rc.Aggregate(aggregate.spheres, aggregate.pairs[kept])
    strength, numbers, ratios = chosen(bonds, kept).strength(kept.sum()), np.flatnonzero(kept), []
    for order in response.by_order:
        carried = rc.contact_loads(rest, order.loads(flow), chosen(bonds, kept), "springs")
        ratios.append(relative_loads(carried, strength)[0])
    others = (ratios[-1] > 0) & ~np.isin(numbers, failing)
    for contact in failing:
        own = numbers == contact
        leads = [ratio[own] - ratio for ratio in ratios]
        changes = np.diff(leads, axis=0)
        if response.order == 2:
            error = FORCE.share * abs(changes[-1])
        else:
            error = response.order / 6 * np.hypot(changes[-1], FORCE.weight * changes[-2])
        margin = leads[-1][others].min() / ratios[-1][own].item() if others.any() else 1.0
        yield int(contact), margin, tuple(numbers[others & (leads[-1] < error)].tolist())


@pytest.mark.parametrize("rule", ["weakest", "overloaded"])
@pytest.mark.parametrize("order", [2, 3, 4])
def test_margin_and_rivals_within_the_error_of_the_lead(order, rule):
    """At every failure of a crack, from the loads at all orders. Contacts that fail at once are no rivals."""
    aggregate = random_packed_ball(24, RADIUS, seed=2)
    response, bonds = setting(aggregate, rc.StokesianDynamics(order))
    setup = aggregate, response, bonds, rc.simple_shear(1.0)
    breakup = rc.break_up(*setup, rule=rule)
    taken = list(steps(*setup, at_once=rule == "overloaded"))
    assert (max(len(failing) for _, failing, _ in taken) > 1) == (rule == "overloaded")
    told = chain.from_iterable(expected_margins_and_rivals(*setup, kept, failing) for kept, failing, _ in taken)
    expected = {contact: (margin, rivals) for contact, margin, rivals in told}
    margins, rivals = zip(*(expected[failure.contact] for failure in breakup.failures), strict=True)
    np.testing.assert_allclose([failure.margin for failure in breakup.failures], margins, rtol=1e-6)
    assert tuple(failure.rivals for failure in breakup.failures) == rivals
    assert breakup.near_ties() == tuple(k for k, each in enumerate(rivals) if each)
    assert 0 < len(breakup.near_ties()) < len(rivals)


@pytest.mark.parametrize("model", [rc.FreeDraining(), rc.StokesianDynamics(order=1)], ids=["no order", "order 1"])
def test_without_a_lower_order_there_are_no_rivals(model):
    aggregate = CLUSTERS["ring"]
    response, bonds = setting(aggregate, model)
    breakup = rc.break_up(aggregate, response, bonds, rc.planar_extension(1.0))
    assert {failure.rivals for failure in breakup.failures} == {None}
    with pytest.raises(ValueError, match=r"^tolerance: expected a number, as the hydrodynamics has no lower order"):
        breakup.near_ties()
    margins = np.array([failure.margin for failure in breakup.failures])
    for tolerance in (1e-6, 0.1, 1.1):
        assert breakup.near_ties(tolerance) == tuple(np.flatnonzero(margins < tolerance).tolist())


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


@pytest.mark.parametrize("order", [2, 3])
@pytest.mark.parametrize("aggregate", [ring(8, RADIUS), lattice_ball("fcc", 13, RADIUS)], ids=["ring", "fcc"])
def test_contacts_that_mirror_each_other_are_rivals(aggregate, order):
    """No order tells them apart."""
    response, bonds = setting(aggregate, rc.StokesianDynamics(order))
    flow = rc.biaxial_extension(1.0)
    first = rc.break_up(aggregate, response, bonds, flow).failures[0]
    tension = rc.contact_loads(aggregate, response.loads(flow), bonds).tension
    mirrored = np.flatnonzero(tension > (1 - 1e-9) * tension[first.contact])
    assert len(mirrored) >= 4
    assert set(mirrored.tolist()) - {first.contact} <= set(first.rivals)


def mirror_images(aggregate, axis):
    """The contact (C,) that each becomes when its aggregate is mirrored."""
    places = aggregate.contact_points - aggregate.spheres.center_of_mass
    mirrored = places * np.where(np.arange(3) == axis, -1, 1)
    distance, image = cKDTree(places).query(mirrored)
    assert distance.max() < 1e-9 * RADIUS
    return image


@pytest.mark.parametrize(
    ("count", "flow"),
    [
        (19, rc.uniaxial_extension(1.0)),
        (43, rc.uniaxial_extension(1.0)),
        (43, rc.biaxial_extension(1.0)),
        (135, rc.uniaxial_extension(1.0)),
        (19, rc.planar_extension(1.0)),
        (43, rc.planar_extension(1.0)),
    ],
)
def test_what_is_overloaded_at_once_is_as_symmetric_as_flow_and_aggregate(count, flow):
    """In the three planes through the axes of a lattice, however many failures follow each other."""
    aggregate = lattice_ball("fcc", count, RADIUS)
    response, bonds = setting(aggregate)
    breakup = rc.break_up(aggregate, response, bonds, flow, rule="overloaded")
    lost = np.sort([failure.contact for failure in breakup.failures])
    assert len(lost) >= 8
    for axis in range(3):
        np.testing.assert_array_equal(np.sort(mirror_images(aggregate, axis)[lost]), lost)


def unbalanced(aggregate, loads, carried):
    """Size of the force (N) and of the torque (N m) that contacts leave on every sphere, (N,) each."""
    force, torque = loads.force.copy(), loads.torque.copy()
    for end, sign in ((0, 1.0), (1, -1.0)):
        sphere = aggregate.pairs[:, end]
        arm = aggregate.contact_points - aggregate.spheres.centers[sphere]
        np.add.at(force, sphere, sign * carried.force)
        np.add.at(torque, sphere, sign * (np.cross(arm, carried.force) + carried.moment))
    return np.linalg.norm(force, axis=1), np.linalg.norm(torque, axis=1)


def test_loads_of_a_long_crack_balance_to_its_end():
    """Every sphere after each of two hundred failures and more, and as if solved anew at the last before the split."""
    aggregate = lattice_ball("fcc", 135, RADIUS)
    bonds, flow = of_many_strengths(aggregate, seed=0, spread=1.5), rc.simple_shear(1.0).rotated(ASKEW)
    response = rc.rigid_response(aggregate.spheres, rc.FreeDraining(), viscosity=1e-3)
    failures = rc.break_up(aggregate, response, bonds, flow, criterion=rc.Tension()).failures
    assert len(failures) > 200
    loads = response.loads(flow)
    largest = np.abs(loads.force).max()
    state = loosenable(aggregate, bonds).loaded(loads)
    for failure in failures[:-1]:
        assert flow.rate * bonds.tensile_strength[failure.contact] / failure.rate == pytest.approx(
            state.loads.tension[failure.contact], rel=1e-9
        )
        state = state.without(failure.contact)
        assert state.residual < 1e-8
        force, torque = unbalanced(aggregate, loads, state.loads)
        assert max(force[1:].max(), torque[1:].max() / RADIUS) < 1e-8 * largest
        assert max(force[0], torque[0] / RADIUS) < 1e-7 * largest  # takes what all others leave
    kept = np.ones(len(aggregate.pairs), bool)
    kept[state.lost] = False
    rest = rc.Aggregate(aggregate.spheres, aggregate.pairs[kept])
    anew = rc.contact_loads(rest, loads, chosen(bonds, kept), "springs")
    np.testing.assert_allclose(state.loads.force[kept], anew.force, rtol=0, atol=1e-8 * np.abs(anew.force).max())
    np.testing.assert_allclose(state.loads.moment[kept], anew.moment, rtol=0, atol=1e-8 * np.abs(anew.moment).max())
    np.testing.assert_array_equal(state.loads.force[~kept], 0)


def test_turned_with_the_flow_it_breaks_the_same():
    aggregate = CLUSTERS["packing"]
    flow = rc.simple_shear(1.0)
    events = [
        rc.break_up(each, *setting(each), turned)
        for each, turned in ((aggregate, flow.rotated(ASKEW.T)), (aggregate.rotated(ASKEW), flow))
    ]
    one, other = ([failure.contact for failure in event.failures] for event in events)
    assert one == other
    np.testing.assert_allclose(*([failure.rate for failure in event.failures] for event in events), rtol=1e-8)


def test_rates_scale_with_strength_over_viscosity_and_area():
    """Stiffness only in proportion; all lengths times 10, viscosity times 3, strength times 7."""
    aggregate = CLUSTERS["packing"]
    flow, bonds = rc.uniaxial_extension(1.0), rc.jkr_bonds(aggregate, MATERIAL)
    response = rc.rigid_response(aggregate.spheres, rc.FreeDraining(), 1e-3)
    large = aggregate.scaled(10)
    stiffness = bonds.stiffness(len(aggregate.pairs)) * [2, 2, 200, 200]
    others = rc.Bonds(*stiffness.T, tensile_strength=7 * bonds.tensile_strength)
    one = rc.break_up(aggregate, response, bonds, flow)
    other = rc.break_up(large, rc.rigid_response(large.spheres, rc.FreeDraining(), 3e-3), others, flow)
    assert [failure.contact for failure in one.failures] == [failure.contact for failure in other.failures]
    assert other.breakup_rate == pytest.approx(one.breakup_rate * 7 / (3 * 100), rel=1e-8)
