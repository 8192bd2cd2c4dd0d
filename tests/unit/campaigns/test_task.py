"""One unit of work."""

import json
import warnings
from dataclasses import replace
from importlib.metadata import version

import numpy as np
import pytest

import rheoclast as rc

pytest.importorskip("msgspec")
pytest.importorskip("pyarrow")

import msgspec

from rheoclast.campaigns.conditions import Conditions, ContactMaterial, Hydrodynamics, Orientations
from rheoclast.campaigns.task import Task, perform, result_schema

MATERIALS = ("polystyrene", ContactMaterial("weak", 3.4e9, 0.33, 0.02, pull_off=1e-12, friction=0.5))
CONDITIONS = Conditions(
    viscosity=2e-3,
    radius=1e-6,
    flows=("uniaxial",),
    orientations=Orientations(5),
    materials=MATERIALS,
    hydrodynamics=Hydrodynamics("free-draining"),
)
TASK = Task(
    family="thinned-fcc-ball",
    parameters={"count": 20, "coordination": 4.0, "radius": 1e-6},
    replicate=2,
    seed=77,
    orientation_seed=5,
    conditions=CONDITIONS,
)


def changed(**values):
    return msgspec.structs.replace(TASK, **values)


def test_rows_say_where_they_come_from_and_what_the_aggregate_is():
    results = perform(TASK)
    assert results.schema == result_schema("first failure")
    aggregate = rc.generation.thinned_fcc_ball(20, 4.0, 1e-6, seed=77)
    for row, material in zip(results.to_pylist(), ("polystyrene", "weak"), strict=True):
        assert (row["task"], row["family"], row["material"]) == (TASK.digest, "thinned-fcc-ball", material)
        assert (row["seed"], row["replicate"], row["orientation_seed"]) == (77, 2, 5)
        assert row["history_seed"] is None
        assert json.loads(row["parameters"]) == TASK.parameters
        assert {name: row[name] for name in ("rheoclast", "numpy", "scipy")} == {
            name: version(name) for name in ("rheoclast", "numpy", "scipy")
        }
        assert (row["spheres"], row["contacts"], row["order"]) == (20, len(aggregate.pairs), None)
        assert row["radius_of_gyration_m"] == rc.radius_of_gyration(aggregate.spheres)
        assert row["mean_coordination"] == rc.mean_coordination(aggregate)
        assert row["failure"] is None


def test_events_are_those_of_the_aggregate_with_its_own_orientations_and_bonds():
    aggregate = rc.generation.thinned_fcc_ball(20, 4.0, 1e-6, seed=77)
    response = rc.rigid_response(aggregate.spheres, rc.FreeDraining(), 2e-3)
    law = rc.JKR(rc.MATERIALS["polystyrene"])
    for row, each in zip(
        perform(TASK).to_pylist(), (law, rc.MeasuredPullOff(1e-12, replace(law, friction=0.5))), strict=True
    ):
        bonds = each.bonds(aggregate)
        criterion = rc.Tension() | rc.Sliding(0.5 if row["material"] == "weak" else 0.0) | rc.Twisting()
        table = rc.contact_response(aggregate, response, bonds)
        expected = [
            rc.initiation(table, bonds, rc.uniaxial_extension(1.0).rotated(rotation), criterion=criterion).rate
            for rotation in rc.random_orientations(5, seed=5)
        ]
        np.testing.assert_allclose([event["initiation_rate_per_s"] for event in row["events"]], expected, rtol=1e-12)


def test_an_aggregate_that_cannot_grow_is_a_row_with_the_reason():
    rows = perform(changed(parameters={"count": 20, "coordination": 40.0, "radius": 1e-6})).to_pylist()
    assert [row["material"] for row in rows] == ["polystyrene", "weak"]
    for row in rows:
        assert row["failure"].startswith("ValueError: coordination: expected from 1.9")
        assert row["spheres"] is None
        assert row["events"] == []


def test_contacts_that_cannot_be_solved_fail_alone(monkeypatch):
    """Springs ten decades softer than balance allows, next to sound ones."""
    soft = ContactMaterial("soft", stiffness=(1.0, 1e-30, 1e-30, 1e-30), pull_off=1e-9)
    conditions = msgspec.structs.replace(CONDITIONS, materials=("polystyrene", soft))
    sound, failed = perform(changed(conditions=conditions)).to_pylist()
    assert (sound["failure"], len(sound["events"])) == (None, 5)
    assert failed["failure"].startswith("ArithmeticError: ")
    assert (failed["spheres"], failed["events"]) == (20, [])


def test_what_is_asked_for_is_warned_of_once_and_not_in_every_task():
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        perform(changed(parameters={"count": 20, "coordination": 4.0, "radius": 1.0}))
    assert not caught


def test_warnings_of_what_goes_wrong_are_heard(monkeypatch):
    def doubtful(*_, **__):
        warnings.warn("a matrix is singular", RuntimeWarning, stacklevel=1)
        return rc.generation.straight_chain(3, 1e-6)

    monkeypatch.setattr("rheoclast.campaigns.task.FAMILIES", {TASK.family: doubtful})
    with pytest.warns(RuntimeWarning, match="a matrix is singular"):
        perform(TASK)


def test_hash_knows_every_input():
    conditions = [
        msgspec.structs.replace(CONDITIONS, **{name: value})
        for name, value in {"viscosity": 1.0, "flows": ("shear",), "orientations": "worst", "event": "breakup"}.items()
    ]
    others = [
        {"seed": 78},
        {"orientation_seed": 6},
        {"history_seed": 6},
        {"parameters": {"count": 21}},
        *({"conditions": c} for c in conditions),
    ]
    hashes = {TASK.digest, *(changed(**other).digest for other in others)}
    assert len(hashes) == 1 + len(others)
    assert changed(parameters=dict(reversed(TASK.parameters.items()))).digest == TASK.digest
