"""What happens to one aggregate in every flow and orientation, as columns of an Arrow table.

The first failure needs no more than the linear map from strain rate to contact loads, so that all orientations are
worked out at once; a breakup is followed contact by contact, for one orientation after the other.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import Any

import numpy as np
import pyarrow as pa

from rheoclast._checks import FloatArray, IntArray
from rheoclast.breakup.contact_response import ContactResponse, contact_response
from rheoclast.breakup.crack import Rule, break_up_each
from rheoclast.breakup.event import Breakup
from rheoclast.breakup.initiation import worst_initiation
from rheoclast.flows import LinearFlow
from rheoclast.hydrodynamics.response import RigidResponse
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.contact_loads import ContactLoads
from rheoclast.mechanics.criteria.any_of import AnyOf
from rheoclast.mechanics.criteria.criterion import Criterion
from rheoclast.mechanics.criteria.load_ratios import EVERY_LIMIT, load_ratios, refuse_without_strength
from rheoclast.particles.aggregate import Aggregate
from rheoclast.particles.morphology import depth, radial_position
from rheoclast.vectors import strain_components

CHUNK = 100_000
"""Contacts times orientations at a time: the arrays stay in the cache."""

IN_WHICH = {"flow": pa.string(), "orientation": pa.int32()}
"""Name of the flow, and position of the orientation among those of the aggregate."""

FIRST_FAILURE = pa.struct(
    {
        **IN_WHICH,
        "initiation_rate_per_s": pa.float64(),
        "contact": pa.int32(),
        "i": pa.int32(),
        "j": pa.int32(),
        "criterion": pa.string(),
        "margin": pa.float64(),
        "radial_position": pa.float64(),
        "depth": pa.float64(),
    }
)
"""Contact and what is known of it are null, and the rate is infinite, where no rate breaks any."""

BREAKUP = pa.struct(
    {
        **IN_WHICH,
        "outcome": pa.string(),
        "initiation_rate_per_s": pa.float64(),
        "breakup_rate_per_s": pa.float64(),
        "surface": pa.int32(),
        "inwardness": pa.float64(),
        "fragments": pa.list_(pa.int32()),
        "contacts": pa.list_(pa.int32()),
        "rates_per_s": pa.list_(pa.float64()),
        "criteria": pa.list_(pa.string()),
    }
)
"""Numbers of spheres of the fragments, the largest first; contacts, rates and criteria of all failures, in order."""


@dataclass(frozen=True, eq=False)
class Setting:
    """An aggregate, its bonds, and the flows that it meets.

    Attributes
    ----------
    rotations
        (n, 3, 3) by which every flow is turned; None for the worst orientation for tension in each flow.
    """

    aggregate: Aggregate
    response: RigidResponse
    bonds: Bonds
    flows: Mapping[str, LinearFlow]
    rotations: FloatArray | None
    criterion: Criterion
    rule: Rule
    up_to: float

    @cached_property
    def table(self) -> ContactResponse:
        """Contact loads in every flow."""
        return contact_response(self.aggregate, self.response, self.bonds)

    def turned(self, flow: LinearFlow) -> tuple[LinearFlow, FloatArray]:
        """A flow, and the rotations (n, 3, 3) by which the aggregate meets it turned."""
        if self.rotations is not None:
            return flow, self.rotations
        worst = worst_initiation(self.table, self.bonds, flow).flow
        return worst.scaled(flow.rate / worst.rate), np.eye(3)[None]


@dataclass(frozen=True, eq=False)
class FirstFailures:
    """The first failure in each of n orientations of one flow.

    Attributes
    ----------
    contact
        (n,) indices; −1 where no rate breaks any.
    rate
        (n,) rates of the flow in 1/s, infinite where no rate breaks any.
    criterion
        (n,) positions among `Criterion.parts` of the criterion asked for.
    margin
        (n,) by how much the load ratio of the next contact is smaller, as a share of the largest, at most 1.
    """

    contact: IntArray
    rate: FloatArray
    criterion: IntArray
    margin: FloatArray


def first_failures(
    table: ContactResponse, bonds: Bonds, flow: LinearFlow, rotations: FloatArray, criterion: Criterion = EVERY_LIMIT
) -> FirstFailures:
    """First failure in a flow turned by each of several rotations (n, 3, 3), as `initiation` has it for one.

    Raises
    ------
    ValueError
        If the bonds have another number of contacts, or no contact has a strength that the criterion needs.
    """
    refuse_without_strength(bonds, criterion)
    limited = [k for k, part in enumerate(criterion.parts) if _has_limit(part, bonds)]
    counting = AnyOf(*(criterion.parts[k] for k in limited))
    strain_rates = np.asarray(rotations) @ flow.strain_rate @ np.swapaxes(rotations, -1, -2)
    pieces = np.array_split(strain_rates, max(1, len(strain_rates) * len(table.normals) // CHUNK))
    found = [_first(table, bonds, strain_components(piece), counting) for piece in pieces]
    contact, part, largest, next_largest = (np.concatenate(column) for column in zip(*found, strict=True))
    fails = largest > 0
    return FirstFailures(
        np.where(fails, contact, -1),
        np.divide(flow.rate, largest, out=np.full(len(largest), np.inf), where=fails),
        np.array(limited)[part],
        np.divide(largest - np.maximum(next_largest, 0.0), largest, out=np.zeros(len(largest)), where=fails),
    )


def _has_limit(part: Criterion, bonds: Bonds) -> bool:
    return any(np.isfinite(getattr(bonds, strength)).any() for strength in part.strengths)


def _first(table: ContactResponse, bonds: Bonds, components: FloatArray, criterion: Criterion) -> tuple[Any, ...]:
    """Contact and criterion (n,) of the largest load ratio, that ratio, and the largest of any other contact."""
    force, moment = (np.tensordot(components, part, (1, 2)) for part in (table.force, table.moment))
    ratios = load_ratios(ContactLoads(table.normals, force, moment), bonds, criterion)
    largest = ratios.max(axis=2)
    contact = largest.argmax(axis=1)
    each = np.arange(len(components))
    first = largest[each, contact]
    part = ratios[each, contact].argmax(axis=1)
    largest[each, contact] = -np.inf
    return contact, part, first, largest.max(axis=1)


def _first_failure_columns(setting: Setting) -> Iterator[dict[str, Any]]:
    points = setting.aggregate.contact_points
    places = [place(setting.aggregate, points) for place in (radial_position, depth)]
    names = np.array([part.name for part in setting.criterion.parts])
    for name, flow in setting.flows.items():
        found = first_failures(setting.table, setting.bonds, *setting.turned(flow), setting.criterion)
        contact, number = found.contact, len(found.contact)
        i, j = setting.aggregate.pairs[contact].T
        known = (contact, i, j, names[found.criterion], found.margin, *(place[contact] for place in places))
        columns = (np.ma.array(each, mask=contact < 0) for each in known)
        yield dict(zip(FIRST_FAILURE.names, ([name] * number, np.arange(number), found.rate, *columns), strict=True))


def _breakup_columns(setting: Setting) -> Iterator[dict[str, Any]]:
    for name, given in setting.flows.items():
        flow, rotations = setting.turned(given)
        broken = break_up_each(
            setting.aggregate,
            setting.response,
            setting.bonds,
            (flow.rotated(each) for each in rotations),
            setting.rule,
            setting.criterion,
            setting.up_to,
        )
        rows = [{"flow": name, "orientation": k, **_breakup_row(each)} for k, each in enumerate(broken)]
        yield {key: [row[key] for row in rows] for key in BREAKUP.names}


def _breakup_row(breakup: Breakup) -> dict[str, Any]:
    return {
        "outcome": breakup.outcome,
        "initiation_rate_per_s": breakup.initiation_rate,
        "breakup_rate_per_s": breakup.breakup_rate,
        "surface": len(breakup.surface),
        "inwardness": breakup.inwardness,
        "fragments": [len(spheres) for spheres in breakup.spheres],
        "contacts": [failure.contact for failure in breakup.failures],
        "rates_per_s": [failure.rate for failure in breakup.failures],
        "criteria": [failure.criterion for failure in breakup.failures],
    }


@dataclass(frozen=True)
class Event:
    """A kind of event: the type of its rows, and what computes their columns flow by flow."""

    type: pa.StructType
    columns: Callable[[Setting], Iterator[dict[str, Any]]]

    def rows(self, setting: Setting) -> pa.StructArray:
        """One row for every flow and orientation."""
        return pa.concat_arrays([_rows(self.type, columns) for columns in self.columns(setting)])


def _rows(kind: pa.StructType, columns: Mapping[str, Any]) -> pa.StructArray:
    fields = list(kind)
    return pa.StructArray.from_arrays(
        [pa.array(columns[field.name], type=field.type) for field in fields], fields=fields
    )


EVENTS: Mapping[str, Event] = MappingProxyType(
    {
        "first failure": Event(FIRST_FAILURE, _first_failure_columns),
        "breakup": Event(BREAKUP, _breakup_columns),
    }
)
"""What a campaign may ask for."""
