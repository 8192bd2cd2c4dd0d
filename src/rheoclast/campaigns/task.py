"""One unit of work: one aggregate with all its materials, and all flows or histories that it meets."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from importlib.metadata import version
from typing import Any, cast

import numpy as np
import pyarrow as pa
from msgspec import Struct

from rheoclast._threads import one_blas_thread
from rheoclast.breakup.crack import Rule
from rheoclast.campaigns.conditions import Conditions, ContactMaterial, Orientations
from rheoclast.campaigns.events import EVENTS
from rheoclast.campaigns.families import SEED
from rheoclast.campaigns.identity import canonical, digest
from rheoclast.campaigns.passages import orbits
from rheoclast.campaigns.setting import Flows, Orbits, Setting
from rheoclast.generation.families import FAMILIES
from rheoclast.hydrodynamics.response import RigidResponse, rigid_response
from rheoclast.particles.aggregate import Aggregate
from rheoclast.particles.morphology import mean_coordination, radius_of_gyration
from rheoclast.populations.orientations import random_orientations

IDENTITY = pa.schema(
    {
        "task": pa.string(),
        "family": pa.string(),
        "parameters": pa.string(),
        "replicate": pa.int64(),
        "seed": pa.int64(),
        "orientation_seed": pa.int64(),
        "history_seed": pa.int64(),
        "material": pa.string(),
        "rheoclast": pa.string(),
        "numpy": pa.string(),
        "scipy": pa.string(),
    }
)
"""Where a row comes from: the hash of the inputs, the inputs that tell aggregates apart, and the versions."""

AGGREGATE = pa.schema(
    {
        "spheres": pa.int64(),
        "contacts": pa.int64(),
        "mean_coordination": pa.float64(),
        "radius_of_gyration_m": pa.float64(),
        "order": pa.int32(),
        "failure": pa.string(),
    }
)
"""What an aggregate is; `failure` says why there are no events of it, and is null otherwise."""

EVENT_LIST = "events"


class Task(Struct, frozen=True, kw_only=True):
    """An aggregate to grow, and what is asked of it.

    Attributes
    ----------
    family, parameters
        Name in `FAMILIES`, and the parameters but the seed.
    replicate
        Number of the aggregate among those of its kind.
    seed
        That it grows from; None if its family knows only one.
    orientation_seed
        Of `random_orientations`.
    history_seed
        Of its histories; None where it meets none.
    conditions
        What it meets.
    """

    family: str
    parameters: dict[str, Any]
    replicate: int
    seed: int | None
    orientation_seed: int
    history_seed: int | None = None
    conditions: Conditions

    @property
    def digest(self) -> str:
        """Hash of all inputs."""
        return digest(self)

    def grown(self) -> Aggregate:
        """The aggregate."""
        seed = {} if self.seed is None else {SEED: self.seed}
        return FAMILIES[self.family](**self.parameters, **seed)


def perform(task: Task) -> pa.Table:
    """Results of a task: one row per material, with the list of its events.

    An aggregate that cannot be grown or solved, or whose contacts cannot be, is a row with the reason as `failure`.
    """
    materials = task.conditions.contact_materials
    with _one_thread(), warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # of what is asked for, which was said when the campaign was read
        try:
            aggregate, conditions = task.grown(), task.conditions
            response = rigid_response(aggregate.spheres, conditions.hydrodynamics.chosen(), conditions.viscosity)
            met = _met(task, response)
        except Exception as error:  # whatever is wrong with one aggregate must not stop the others
            return failed(task, _reason(error))
        return pa.concat_tables([_material_table(task, material, aggregate, response, met) for material in materials])


def failed(task: Task, reason: str) -> pa.Table:
    """Results of a task that came to nothing."""
    return pa.concat_tables(
        [_table(task, material, {"failure": reason}) for material in task.conditions.contact_materials]
    )


def result_schema(event: str) -> pa.Schema:
    """Columns of the results of a task."""
    listed = pa.field(EVENT_LIST, pa.list_(EVENTS[event].type))
    return pa.schema([*IDENTITY, *AGGREGATE, listed])


def _material_table(
    task: Task, material: ContactMaterial, aggregate: Aggregate, response: RigidResponse, met: Flows | Orbits
) -> pa.Table:
    known = {
        "spheres": len(aggregate),
        "contacts": len(aggregate.pairs),
        "mean_coordination": mean_coordination(aggregate),
        "radius_of_gyration_m": radius_of_gyration(aggregate.spheres),
        "order": response.order,
    }
    try:
        bonds = material.contact_law().bonds(aggregate)
        criterion = task.conditions.failure_criterion(material)
        setting = Setting(aggregate, response, bonds, criterion, cast(Rule, task.conditions.rule))
        events = EVENTS[task.conditions.event].rows(setting, met)
    except Exception as error:  # as above
        return _table(task, material, {**known, "failure": _reason(error)})
    return _table(task, material, known, events)


def _met(task: Task, response: RigidResponse) -> Flows | Orbits:
    """What the aggregate meets, the same for all materials."""
    asked = task.conditions
    if asked.histories is not None:
        assert task.history_seed is not None
        return orbits(response, asked.histories, asked.viscosity, task.history_seed, task.orientation_seed)
    rotations = None
    if isinstance(asked.orientations, Orientations):
        rotations = random_orientations(asked.orientations.number, task.orientation_seed)
    return Flows(asked.linear_flows, rotations, np.inf if asked.up_to is None else asked.up_to)


def _table(
    task: Task, material: ContactMaterial, known: dict[str, Any], events: pa.StructArray | None = None
) -> pa.Table:
    """One row."""
    schema = result_schema(task.conditions.event)
    row = {
        "task": task.digest,
        "family": task.family,
        "parameters": canonical(task.parameters).decode(),
        "replicate": task.replicate,
        "seed": task.seed,
        "orientation_seed": task.orientation_seed if task.conditions.draws_orientations else None,
        "history_seed": task.history_seed,
        "material": material.name,
        **_versions(),
        **known,
    }
    listed = EVENTS[task.conditions.event].type
    rows = pa.array([], type=listed) if events is None else events
    columns = [pa.array([row.get(field.name)], type=field.type) for field in [*IDENTITY, *AGGREGATE]]
    return pa.table([*columns, pa.ListArray.from_arrays([0, len(rows)], rows, type=pa.list_(listed))], schema=schema)


@cache
def _versions() -> dict[str, str]:
    return {package: version(package) for package in ("rheoclast", "numpy", "scipy")}


def _reason(error: Exception) -> str:
    return f"{type(error).__name__}: {' '.join(str(error).split())}"


@contextmanager
def _one_thread() -> Iterator[None]:
    """One thread for linear algebra and compiled loops: the workers share the cores."""
    import numba

    before = numba.get_num_threads()
    numba.set_num_threads(1)
    try:
        with one_blas_thread():
            yield
    finally:
        numba.set_num_threads(before)
