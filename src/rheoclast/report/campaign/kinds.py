"""Events by kinds: aggregates of one family, size and material in one flow, or at one dissipation."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rheoclast._checks import FloatArray, IntArray
from rheoclast.report.campaign.folder import AGGREGATE, ArrowTable, CampaignResult
from rheoclast.report.wording import written

SIZE, RADIUS = "count", "radius"
MET = {"first failure": "flow", "breakup": "flow", "history": "dissipation_m2_per_s3"}
MOST_SERIES = 8
Condition = tuple[str, str | float]


@dataclass(frozen=True, eq=False)
class Kind:
    """Aggregates of one kind under one condition, and their events.

    Attributes
    ----------
    family, parameters, material
        As in the tables of the campaign.
    met
        Name of the flow, or the dissipation in m²/s³.
    events
        Columns by name, one row per event; `aggregate` counts the aggregates of the campaign, and what is known of
        them stands in every one of their rows.
    """

    family: str
    parameters: Mapping[str, Any]
    material: str
    met: str | float
    events: Mapping[str, NDArray[Any]]

    @property
    def condition(self) -> Condition:
        """Material and flow, or dissipation."""
        return self.material, self.met

    @cached_property
    def _grouped(self) -> tuple[IntArray, IntArray]:
        """Where the first event of every aggregate stands, and how many it has."""
        _, first, counts = np.unique(self.events["aggregate"], return_index=True, return_counts=True)
        return first, counts

    @property
    def number(self) -> int:
        """Of aggregates."""
        return len(self._grouped[0])

    def each(self, name: str) -> FloatArray:
        """What is known of every aggregate."""
        return self.events[name][self._grouped[0]]

    def known(self, name: str) -> FloatArray:
        """Numbers of those events that have one."""
        values = self.events[name]
        return values[~np.isnan(values)]

    def words(self, name: str) -> Counter[str]:
        """Words of those events that have one, counted."""
        return Counter(word for word in self.events[name] if word is not None)

    def medians(self, name: str) -> FloatArray:
        """The median of the events of every aggregate, the lower of the two in the middle."""
        values, counts = self.events[name], self._grouped[1]
        order = np.lexsort((values, self.events["aggregate"]))
        return values[order[np.cumsum(counts) - counts + (counts - 1) // 2]]


def quantiles(values: FloatArray, shares: Sequence[float]) -> FloatArray:
    """Quantiles that are values; infinite ones are no obstacle."""
    return np.quantile(values, shares, method="inverted_cdf") if len(values) else np.full(len(shares), np.nan)


def kinds(result: CampaignResult) -> tuple[Kind, ...]:
    """All kinds of which there are events, in the order of the campaign."""
    events = _known(result)
    if result.event == "breakup":
        events = _with_fragments(events)
    keys = ["family", "parameters", "material", MET[result.event]]
    columns = [name for name in events.column_names if name not in keys]
    groups = events.group_by(keys, use_threads=False).aggregate([(name, "list") for name in columns])
    lists = {name: groups[f"{name}_list"] for name in columns}
    return tuple(
        Kind(family, json.loads(parameters), material, met, {name: _column(lists[name][k]) for name in columns})
        for k, (family, parameters, material, met) in enumerate(
            zip(*(groups[key].to_pylist() for key in keys), strict=True)
        )
    )


def _column(values: Any) -> NDArray[Any]:
    """Numbers, not a number where there is none; words as they are."""
    return values.values.to_numpy(zero_copy_only=False)


def _known(result: CampaignResult) -> ArrowTable:
    """The events, with what is known of their aggregates in place of the name of the task."""
    compute = import_module("pyarrow.compute")
    aggregates = result.aggregates.group_by("task", use_threads=False).aggregate([(name, "max") for name in AGGREGATE])
    place = compute.index_in(result.events["task"], value_set=aggregates["task"])
    events = result.events.drop_columns(["task"]).append_column("aggregate", place)
    for name in AGGREGATE:
        events = events.append_column(name, aggregates[f"{name}_max"].take(place))
    return events


def _with_fragments(events: ArrowTable) -> ArrowTable:
    """The number of fragments, and the share of spheres outside the largest, in place of the list of their sizes."""
    compute = import_module("pyarrow.compute")
    listed = events["fragments"]
    largest = compute.divide(compute.cast(compute.list_element(listed, 0), "float64"), events["spheres"])
    return (
        events.drop_columns(["fragments"])
        .append_column("pieces", compute.list_value_length(listed))
        .append_column("smaller_share", compute.subtract(1.0, largest))
    )


def conditions(all_kinds: Sequence[Kind]) -> dict[Condition, str]:
    """Conditions with their names, in the order of the campaign."""
    return {kind.condition: f"{kind.material}, {met_name(kind.met)}" for kind in all_kinds}


def met_name(met: str | float) -> str:
    """A flow or a dissipation in words."""
    return met if isinstance(met, str) else written(met, "m²/s³")


def differing(all_kinds: Sequence[Kind]) -> tuple[str, ...]:
    """Parameters, but the size, in which aggregates of one family differ."""
    found: dict[str, None] = {}
    for family in dict.fromkeys(kind.family for kind in all_kinds):
        own = [kind.parameters for kind in all_kinds if kind.family == family]
        names = dict.fromkeys(name for parameters in own for name in parameters if name != SIZE)
        found |= {name: None for name in names if len({str(each.get(name)) for each in own}) > 1}
    return tuple(found)


def series(all_kinds: Sequence[Kind]) -> dict[str, list[Kind]]:
    """Kinds that are drawn in one colour: of all sizes; of all parameters too if there are too many otherwise."""
    names = differing(all_kinds)
    together: dict[str, list[Kind]] = {}
    for kind in all_kinds:
        told = [
            f"{parameter_name(name)} {parameter(kind.parameters[name])}" for name in names if name in kind.parameters
        ]
        together.setdefault(", ".join([kind.family, *told]), []).append(kind)
    if len(together) <= MOST_SERIES:
        return together
    families = dict.fromkeys(kind.family for kind in all_kinds)
    return {family: [kind for kind in all_kinds if kind.family == family] for family in families}


def parameter_name(name: str) -> str:
    """A parameter in words."""
    return name.replace("_", " ")


def parameter(value: Any) -> str:
    """The value of a parameter in words."""
    if isinstance(value, list):
        return " × ".join(parameter(each) for each in value)
    return written(value) if isinstance(value, float) else str(value)


def told_parameters(parameters: Mapping[str, Any]) -> str:
    """Parameters of one aggregate in words; all but the radius, which is in m."""
    told = (f"{parameter_name(name)} {parameter(value)}" for name, value in parameters.items() if name != RADIUS)
    return ", ".join(told)
