"""The first failure along the aggregate's own rotation."""

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.generation import cluster_cluster, lattice_ball, straight_chain


def setting(aggregate, model=None, **strength):
    response = rc.rigid_response(aggregate.spheres, model or rc.StokesianDynamics(), viscosity=1.0)
    bonds = rc.Bonds(1.0, 0.8, 6e-3, 8e-3, **(strength or {"tensile_strength": 2.0}))
    return response, rc.contact_response(aggregate, response, bonds), bonds


def test_doublet_fails_where_the_tension_of_its_jeffery_orbit_is_largest():
    """In the plane of shear the axis at angle φ carries c G sin φ cos φ: most at 45°, where every orbit passes."""
    response, table, bonds = setting(straight_chain(2))
    first = rc.orbit_initiation(response, table, bonds, rc.simple_shear(3.0))
    assert first.contact == 0
    assert first.criterion == "tension"
    assert first.rate == pytest.approx(rc.worst_initiation(table, bonds, rc.simple_shear(1.0)).rate, rel=1e-9)
    axis = first.trajectory.rotation(first.time) @ [1.0, 0, 0]
    assert abs(axis[0] * axis[1]) == pytest.approx(0.5, abs=1e-6)


def test_orbit_out_of_the_plane_of_shear_never_reaches_the_worst_orientation():
    """An axis along the vorticity stays there, and carries nothing but what is symmetric about it."""
    response, table, bonds = setting(straight_chain(2))
    upright = np.array([[0, 0, -1.0], [0, 1, 0], [1, 0, 0]])
    first = rc.orbit_initiation(response, table, bonds, rc.simple_shear(1.0), start=upright)
    assert first.rate > 1e9 * rc.worst_initiation(table, bonds, rc.simple_shear(1.0)).rate


@pytest.mark.parametrize("flow", [rc.simple_shear(2.0), rc.uniaxial_extension(0.7)], ids=["shear", "extension"])
@pytest.mark.parametrize("seed", range(3))
def test_no_sampled_instant_carries_more(flow, seed):
    """Against 20 000 instants, and at the instant told the load ratio is one."""
    response, table, bonds = setting(cluster_cluster(30, seed=seed), tensile_strength=np.linspace(1, 2, 29))
    start = rc.random_orientations(3, seed=5)[seed]
    first = rc.orbit_initiation(response, table, bonds, flow, start=start, duration=30 / flow.magnitude)
    times = np.linspace(0, 30 / flow.magnitude, 20_000)
    tension = np.einsum("cij,tij->tc", table.tension, first.trajectory.strain_rate(times))
    sampled = (tension / bonds.tensile_strength).max()
    assert flow.rate / first.rate == pytest.approx(sampled, rel=1e-5)
    assert flow.rate / first.rate >= sampled * (1 - 1e-9)
    at_failure = rc.load_ratios(table.loads(first.flow), bonds)
    assert at_failure.max() == pytest.approx(1, rel=1e-9)
    assert at_failure[first.contact].max() == at_failure.max()


def test_between_given_and_worst():
    response, table, bonds = setting(cluster_cluster(40, seed=8))
    flow = rc.simple_shear(1.0)
    given, worst = rc.initiation(table, bonds, flow).rate, rc.worst_initiation(table, bonds, flow).rate
    assert worst <= rc.orbit_initiation(response, table, bonds, flow).rate * (1 + 1e-12) <= given * (1 + 1e-9)


def test_regular_cluster_turns_with_the_vorticity():
    """Half a turn of the strain axes takes π/G: a longer orbit tells nothing new."""
    response, table, bonds = setting(lattice_ball("sc", 7))
    flow, start = rc.simple_shear(1.0), rc.random_orientations(1, seed=2)[0]
    short, long = (
        rc.orbit_initiation(response, table, bonds, flow, start=start, duration=k * 2 * np.pi).rate for k in (1, 3)
    )
    assert short == pytest.approx(long, rel=1e-7)


def test_other_criteria():
    response, table, bonds = setting(cluster_cluster(20, seed=1), tensile_strength=1.0, bending_strength=1e-3)
    flow = rc.simple_shear(1.0)
    rolls = rc.orbit_initiation(response, table, bonds, flow, criterion=rc.Rolling())
    assert rolls.criterion == "rolling"
    assert table.loads(rolls.flow).bending.max() == pytest.approx(1e-3, rel=1e-9)
    assert rc.orbit_initiation(response, table, bonds, flow).rate == pytest.approx(rolls.rate)


def test_breakup_in_the_orientation_of_failure_begins_there():
    aggregate = cluster_cluster(25, seed=6)
    response, table, bonds = setting(aggregate)
    first = rc.orbit_initiation(response, table, bonds, rc.simple_shear(1.0))
    breakup = rc.break_up(aggregate, response, bonds, first.flow)
    assert breakup.failures[0].contact == first.contact
    assert breakup.initiation_rate == pytest.approx(first.rate, rel=1e-9)


def test_flow_without_strain():
    response, table, bonds = setting(straight_chain(2))
    with pytest.raises(ValueError, match="flow: expected a strain rate that is not zero, got none; a rotation loads"):
        rc.orbit_initiation(response, table, bonds, rc.LinearFlow([[0, -1.0, 0], [1, 0, 0], [0, 0, 0]]))
