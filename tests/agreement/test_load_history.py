"""Loads along a trajectory against the flow seen from the aggregate, instant by instant."""

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.breakup.load_history import load_history
from rheoclast.generation import cluster_cluster, compacted

STRENGTHS = {"tensile_strength": 3.0, "shear_strength": 2.5, "bending_strength": 4.0, "twisting_strength": 1.5}


def cluster(looped):
    tree = cluster_cluster(40, seed=7)
    return compacted(tree, 0.4) if looped else tree


@pytest.fixture(scope="module", params=[False, True], ids=["tree", "loops"])
def case(request):
    aggregate = cluster(request.param)
    response = rc.rigid_response(aggregate.spheres, rc.StokesianDynamics(), viscosity=1.0)
    bonds = rc.Bonds(1.0, 0.8, 6e-3, 8e-3, **STRENGTHS).scattered(len(aggregate.pairs), 5.0, seed=1)
    gradients = rc.gaussian_histories(1, 20.0, 1.0, 1.0, seed=2)[0]
    return (
        aggregate,
        response,
        rc.contact_response(aggregate, response, bonds),
        bonds,
        rc.trajectory(response, gradients),
    )


@pytest.mark.parametrize("criterion", [rc.EVERY_LIMIT, rc.Tension(), rc.Sliding(0.3), rc.Combined(2.0) | rc.Tension()])
def test_every_instant_by_its_own_flow(case, criterion):
    _, _, table, bonds, trajectory = case
    times = np.sort(np.random.default_rng(3).uniform(0, 20, 60))
    history = load_history(trajectory, table, bonds, times=times, criterion=criterion)
    for k, time in enumerate(times):
        ratios = rc.load_ratios(table.loads(trajectory.flow(time)), bonds, criterion=criterion)
        assert history.largest[k] == pytest.approx(ratios.max(), rel=1e-11)
        assert (history.contact[k], history.criterion[k]) == np.unravel_index(ratios.argmax(), ratios.shape)


def test_contact_loads_without_the_table(case):
    """From the loads on every sphere, through the whole structure."""
    aggregate, response, table, bonds, trajectory = case
    times = np.array([0.3, 7.7, 19.0])
    history = load_history(trajectory, table, bonds, times=times)
    for time, largest in zip(times, history.largest, strict=True):
        carried = rc.contact_loads(aggregate, response.loads(trajectory.flow(time)), bonds)
        assert rc.load_ratios(carried, bonds).max() == pytest.approx(largest, rel=1e-8)


@pytest.mark.parametrize("quantile", [0.5, 0.9, 1.0])
def test_breakup_begins_where_and_when_the_history_says(case, quantile):
    """In the flow of the first failure the weakest contact fails at the rate over the level."""
    aggregate, response, table, bonds, trajectory = case
    history = load_history(trajectory, table, bonds)
    level = np.quantile(history.largest, quantile)
    failure = history.first_failure(level)
    flow = trajectory.flow(failure.time)
    first = rc.break_up(aggregate, response, bonds, flow).failures[0]
    assert (first.contact, first.criterion) == (failure.contact, failure.criterion)
    if failure.time > 0:
        assert first.rate / flow.rate == pytest.approx(1 / level, rel=1e-8)
    before = history.times < failure.time
    assert (history.largest[before] < level).all()


def test_orbit_fails_at_the_maximum(case):
    _, response, table, bonds, _ = case
    flow = rc.simple_shear(1.5)
    first = rc.orbit_initiation(response, table, bonds, flow, duration=20.0)
    times = np.linspace(0, 20, 4001)
    sampled = load_history(first.trajectory, table, bonds, times=times)
    assert flow.rate / first.rate == pytest.approx(sampled.maximum.ratio, rel=1e-4)
    assert flow.rate / first.rate >= sampled.maximum.ratio * (1 - 1e-12)
