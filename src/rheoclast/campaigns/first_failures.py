"""The first failure of one aggregate in every flow and orientation.

It needs no more than the linear map from strain rate to contact loads, so that all orientations are worked out at once.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import pyarrow as pa

from rheoclast._checks import FloatArray, IntArray
from rheoclast.breakup.contact_response import ContactResponse
from rheoclast.campaigns.setting import Flows, Setting
from rheoclast.flows import LinearFlow
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.criteria.any_of import AnyOf
from rheoclast.mechanics.criteria.criterion import Criterion
from rheoclast.mechanics.criteria.load_ratios import EVERY_LIMIT, limited_parts, load_ratios, refuse_without_strength
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
    limited = limited_parts(bonds, criterion)
    counting = AnyOf(*(criterion.parts[k] for k in limited))
    strain_rates = np.asarray(rotations) @ flow.strain_rate @ np.swapaxes(rotations, -1, -2)
    pieces = np.array_split(strain_rates, max(1, len(strain_rates) * len(table.normals) // CHUNK))
    found = [_first(table, bonds, strain_components(piece), counting) for piece in pieces]
    contact, part, largest, next_largest = (np.concatenate(column) for column in zip(*found, strict=True))
    fails = largest > 0
    return FirstFailures(
        np.where(fails, contact, -1),
        np.divide(flow.rate, largest, out=np.full(len(largest), np.inf), where=fails),
        limited[part],
        np.divide(largest - np.maximum(next_largest, 0.0), largest, out=np.zeros(len(largest)), where=fails),
    )


def _first(table: ContactResponse, bonds: Bonds, components: FloatArray, criterion: Criterion) -> tuple[Any, ...]:
    """Contact and criterion (n,) of the largest load ratio, that ratio, and the largest of any other contact."""
    ratios = load_ratios(table.loads_of(components), bonds, criterion)
    largest = ratios.max(axis=2)
    contact = largest.argmax(axis=1)
    each = np.arange(len(components))
    first = largest[each, contact]
    part = ratios[each, contact].argmax(axis=1)
    largest[each, contact] = -np.inf
    return contact, part, first, largest.max(axis=1)


def first_failure_columns(setting: Setting, flows: Flows) -> Iterator[dict[str, Any]]:
    """Columns of `FIRST_FAILURE`, flow by flow, with one row per orientation."""
    names = np.array([part.name for part in setting.criterion.parts])
    for name, flow in flows.named.items():
        found = first_failures(setting.table, setting.bonds, *flows.turned(flow, setting), setting.criterion)
        contact, number = found.contact, len(found.contact)
        i, j = setting.aggregate.pairs[contact].T
        known = (contact, i, j, names[found.criterion], found.margin, *setting.places[:, contact])
        columns = (np.ma.array(each, mask=contact < 0) for each in known)
        yield dict(zip(FIRST_FAILURE.names, ([name] * number, np.arange(number), found.rate, *columns), strict=True))
