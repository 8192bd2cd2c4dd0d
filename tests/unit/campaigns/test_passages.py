"""Aggregates carried along histories: rows against the library used by hand, in SI units."""

from itertools import chain

import msgspec
import numpy as np
import pytest
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

import rheoclast as rc

pytest.importorskip("pyarrow")

from rheoclast.campaigns.conditions import Conditions, ContactMaterial, Hydrodynamics
from rheoclast.campaigns.histories import Histories
from rheoclast.campaigns.task import Task, perform

DISSIPATIONS = (0.05, 0.4, 3.0)
VISCOSITY, DENSITY, RADIUS = 2e-3, 1e3, 1e-6
HISTORIES = Histories(model="gaussian", number=6, duration=10.0, dissipations=DISSIPATIONS, density=DENSITY)
WEAK = ContactMaterial("weak", 3.4e9, 0.33, 0.02, pull_off=2e-10)
STIFF = ContactMaterial("stiff", stiffness=(1.0, 0.5, 1e-13, 1e-13), pull_off=3e-10)
CONDITIONS = Conditions(
    event="history",
    viscosity=VISCOSITY,
    radius=RADIUS,
    histories=HISTORIES,
    materials=(WEAK, STIFF),
    hydrodynamics=Hydrodynamics("free-draining"),
)
TASK = Task(
    family="thinned-fcc-ball",
    parameters={"count": 24, "coordination": 4.0, "radius": RADIUS},
    replicate=0,
    seed=3,
    orientation_seed=11,
    history_seed=12,
    conditions=CONDITIONS,
)
TREE = msgspec.structs.replace(TASK, family="cluster-cluster", parameters={"count": 30, "radius": RADIUS})


def changed(task, **histories):
    conditions = msgspec.structs.replace(CONDITIONS, histories=msgspec.structs.replace(HISTORIES, **histories))
    return msgspec.structs.replace(task, conditions=conditions)


def rows(task):
    """Rows of both materials."""
    results = perform(task).to_pylist()
    assert [each["failure"] for each in results] == [None, None]
    return [each["events"] for each in results]


def assert_as_by_hand(row, orbit, aggregate, response, bonds):
    table = rc.contact_response(aggregate, response, bonds)
    loads = rc.load_history(orbit, table, bonds)
    failure = loads.first_failure()
    lasted = loads.duration if failure is None else failure.time - orbit.times[0]
    assert row["failed"] == (failure is not None)
    assert row["overloaded"] == (loads.largest[0] >= 1)
    assert row["time_s"] == pytest.approx(lasted, rel=1e-6)
    assert row["largest_load_ratio"] == pytest.approx(loads.maximum.ratio, rel=1e-6)
    if failure is None:
        missing = ("contact", "i", "j", "criterion", "radial_position", "depth", "fragments", "smaller_share")
        assert {row[name] for name in (*missing, "breakup_over_initiation")} == {None}
        return
    broken = rc.break_up(aggregate, response, bonds, orbit.flow(failure.time))
    point = aggregate.contact_points[[failure.contact]]
    assert (row["contact"], row["criterion"]) == (failure.contact, failure.criterion)
    assert [row["i"], row["j"]] == aggregate.pairs[failure.contact].tolist()
    assert row["radial_position"] == pytest.approx(rc.radial_position(aggregate, point)[0])
    assert row["depth"] == pytest.approx(rc.depth(aggregate, point)[0])
    assert row["fragments"] == [len(each) for each in broken.fragments]
    assert row["smaller_share"] == pytest.approx(1 - len(broken.fragments[0]) / len(aggregate))
    assert row["breakup_over_initiation"] == pytest.approx(broken.breakup_rate / broken.initiation_rate, rel=1e-6)


@pytest.mark.parametrize("task", [TASK, TREE], ids=["ball", "tree"])
def test_rows_are_those_of_every_dissipation_by_itself(task):
    aggregate = task.grown()
    response = rc.rigid_response(aggregate.spheres, rc.FreeDraining(), VISCOSITY)
    starts = rc.random_orientations(6, seed=11)
    for material, events in zip((WEAK, STIFF), rows(task), strict=True):
        bonds = material.contact_law().bonds(aggregate)
        assert [(row["history"], row["dissipation_m2_per_s3"]) for row in events] == [
            (number, each) for number in range(6) for each in DISSIPATIONS
        ]
        for column, dissipation in enumerate(DISSIPATIONS):
            unit = rc.kolmogorov_time(dissipation, VISCOSITY / DENSITY)
            paths = rc.gaussian_histories(6, 10 * unit, dissipation, VISCOSITY / DENSITY, seed=12)
            for row, path, start in zip(events[column::3], paths, starts, strict=True):
                assert row["kolmogorov_time_s"] == pytest.approx(unit)
                assert_as_by_hand(row, rc.trajectory(response, path, start=start), aggregate, response, bonds)


def test_the_cases_above_are_all_there():
    outcomes = {(row["failed"], row["overloaded"]) for events in rows(TREE) for row in events}
    assert outcomes == {(False, False), (True, False), (True, True)}


def test_rows_of_files(tmp_path):
    """Of several lengths, from another time than zero on, at their own dissipation."""
    paths = [
        rc.GradientHistory(path.times + 1.5, path.gradients)
        for k, duration in enumerate((0.03, 0.02, 0.05))
        for path in rc.recent_deformation_histories(1, duration, 0.8, 2e-6, seed=k)
    ]
    file = str(tmp_path / "paths.csv")
    rc.write_histories(file, paths)
    task = changed(TREE, model=None, files=(file,), number=2, duration=None, dissipations=None)
    drawn = list(task.conditions.histories.drawn(12))
    aggregate = task.grown()
    response = rc.rigid_response(aggregate.spheres, rc.FreeDraining(), VISCOSITY)
    bonds = WEAK.contact_law().bonds(aggregate)
    events = rows(task)[0]
    assert [row["history"] for row in events] == drawn
    mean = sum(path.dissipation(2e-6) * path.duration for path in paths) / sum(path.duration for path in paths)
    for row, start in zip(events, rc.random_orientations(2, seed=11), strict=True):
        assert row["dissipation_m2_per_s3"] == pytest.approx(mean)
        orbit = rc.trajectory(response, paths[row["history"]], start=start)
        assert_as_by_hand(row, orbit, aggregate, response, bonds)


def test_files_may_be_cut(tmp_path):
    file = str(tmp_path / "paths.npz")
    rc.write_histories(file, rc.gaussian_histories(2, 0.05, 0.8, 2e-6, seed=1))
    whole, cut = (
        rows(changed(TREE, model=None, files=(file,), number=None, duration=each, dissipations=(1e-4, 2.0)))[0]
        for each in (None, 3.0)
    )
    assert all(row["time_s"] == pytest.approx(3 * row["kolmogorov_time_s"]) for row in cut if not row["failed"])
    assert not all(row["failed"] for row in cut)
    for long, short in zip(whole, cut, strict=True):
        if short["failed"]:
            assert short == {**long, "largest_load_ratio": short["largest_load_ratio"]}


def test_loads_go_with_stress_and_times_with_the_rate():
    """A quarter of the dissipation in a liquid of twice the viscosity and density: the same stress, half as fast."""
    first = changed(TASK, dissipations=(0.8,))
    slower = changed(TASK, dissipations=(0.2,), density=2 * DENSITY)
    conditions = msgspec.structs.replace(slower.conditions, viscosity=2 * VISCOSITY)
    slower = msgspec.structs.replace(slower, conditions=conditions)
    for one, other in zip(*(chain(*rows(task)) for task in (first, slower)), strict=True):
        assert other["largest_load_ratio"] == pytest.approx(one["largest_load_ratio"])
        assert other["time_s"] == pytest.approx(2 * one["time_s"])
        assert (other["contact"], other["failed"]) == (one["contact"], one["failed"])


def test_the_first_failure_of_a_tree_splits_it():
    aggregate = TREE.grown()
    failing = [row for events in rows(TREE) for row in events if row["failed"]]
    assert failing
    for row in failing:
        i, j = np.delete(aggregate.pairs, row["contact"], axis=0).T
        graph = coo_array((np.ones(len(i)), (i, j)), shape=(30, 30))
        sizes = np.bincount(connected_components(graph, directed=False)[1])
        assert row["fragments"] == sorted(sizes.tolist(), reverse=True)
        assert row["smaller_share"] == pytest.approx(min(sizes) / 30)
        assert row["breakup_over_initiation"] == 1


def test_without_fragments():
    for plain, followed in zip(rows(changed(TASK, fragments=False)), rows(TASK), strict=True):
        unknown = {"fragments": None, "smaller_share": None, "breakup_over_initiation": None}
        assert plain == [{**row, **unknown} for row in followed]


def test_equal_tasks_have_equal_rows_to_the_last_bit():
    again = msgspec.structs.replace(TASK, replicate=0)
    assert perform(TASK).equals(perform(again))


def test_a_history_that_cannot_be_followed_is_a_row_with_the_reason(tmp_path):
    file = tmp_path / "paths.npz"
    rc.write_histories(file, rc.gaussian_histories(2, 0.05, 0.8, 2e-6, seed=1))
    task = changed(TREE, model=None, files=(str(file),), number=None, duration=None, dissipations=None)
    file.unlink()
    for row in perform(task).to_pylist():
        assert row["failure"].startswith(f"ValueError: path: {file} cannot be read")
        assert row["events"] == []
