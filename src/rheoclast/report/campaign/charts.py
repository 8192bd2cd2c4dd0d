"""Charts of a campaign, ready for the script that draws them, for every material and flow or dissipation.

A chart of "points" has small ones for aggregates, and large ones with bars for kinds of them; one of "steps" shows
distributions as shares of all events.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rheoclast._checks import FloatArray
from rheoclast.fits import CONFIDENCE
from rheoclast.report.campaign.kinds import Condition, Kind, conditions, met_name, quantiles, series
from rheoclast.report.campaign.tables import QUARTILES, found_rate
from rheoclast.report.numbers import ROUNDING, shortened
from rheoclast.report.wording import percent
from rheoclast.view.fragments import counted
from rheoclast.view.quantities import prefixed

MOST_POINTS = 3000  # on the page
BINS = 30
WIDENED = 1.2  # of a range that is a point
Content = dict[str, Any]


@dataclass(frozen=True)
class Axis:
    """A column along an axis, with its label, and whether ticks go by factors."""

    name: str
    label: str
    is_logarithmic: bool = False
    until: float | None = None


INITIATION = Axis("initiation_rate_per_s", "initiation rate (1/s)", is_logarithmic=True)
POSITION = Axis("radial_position", "distance from the centre / Rg")
OUTSIDE = Axis("smaller_share", "share of spheres outside the largest fragment", until=1.0)
LOAD_RATIO = Axis("largest_load_ratio", "largest load / strength", is_logarithmic=True)
BREAKUP = Axis("breakup_rate_per_s", "breakup rate (1/s)", is_logarithmic=True)

DISTRIBUTIONS: Mapping[str, tuple[tuple[str, Axis], ...]] = {
    "first failure": (("Rates of the first failure", INITIATION), ("Where the first contact fails", POSITION)),
    "breakup": (
        ("Rates of the first failure", INITIATION),
        ("Rates of breakup", BREAKUP),
        ("Sizes of fragments", OUTSIDE),
    ),
    "history": (
        ("Largest loads of the histories", LOAD_RATIO),
        ("Where the first contact fails", POSITION),
        ("Sizes of fragments", OUTSIDE),
    ),
}


def campaign_charts(all_kinds: Sequence[Kind], event: str) -> Content:
    """Names of series and conditions, and what is drawn of each."""
    if not all_kinds:
        return {"choice": "", "series": [], "conditions": [], "charts": []}
    together, met = series(all_kinds), conditions(all_kinds)
    first = _breakage_rates(together, met) if event == "history" else _critical_rates(together, met)
    drawn = [_distribution(title, axis, together, met) for title, axis in DISTRIBUTIONS[event]]
    choice = "Material and dissipation" if event == "history" else "Material and flow"
    return {"choice": choice, "series": list(together), "conditions": list(met.values()), "charts": [first, *drawn]}


def _labels(axis: Axis, label: str | None = None) -> Content:
    return {"label": label or axis.label, "log": axis.is_logarithmic}


def _critical_rates(together: Mapping[str, Sequence[Kind]], met: Mapping[Condition, str]) -> Content:
    """Against the radius of gyration: medians of every aggregate over its orientations, and those of every kind."""
    radii = [kind.each("radius_of_gyration_m").max() for each in together.values() for kind in each]
    divisor, unit = prefixed(float(max(radii)), "m")
    most = max(MOST_POINTS // len(met), 1)
    return {
        "kind": "points",
        "title": "Initiation rate against radius of gyration",
        "x": {"label": f"radius of gyration ({unit})", "log": True},
        "y": _labels(INITIATION),
        "views": [_cloud(_under(together, condition), divisor, most) for condition in met],
    }


def _under(together: Mapping[str, Sequence[Kind]], condition: Condition) -> list[list[Kind]]:
    return [[kind for kind in each if kind.condition == condition] for each in together.values()]


def _cloud(drawn: Sequence[Sequence[Kind]], divisor: float, most: int) -> Content:
    """Points, of which the same share is left out of every kind if there are too many."""
    number = sum(kind.number for each in drawn for kind in each)
    share = min(1.0, most / number) if number else 1.0
    kept = [[_some(kind, divisor, share) for kind in each] for each in drawn]
    points = [{"x": [x for one in each for x in one[0]], "y": [y for one in each for y in one[1]]} for each in kept]
    note = "small: each aggregate, its median over all orientations; large: median and quartiles of all of one kind"
    if share < 1:
        note += f"; {sum(len(each['x']) for each in points)} of {counted(number, 'aggregate')} are drawn"
    return {"points": points, "medians": [[_middle(kind, divisor) for kind in each] for each in drawn], "note": note}


def _some(kind: Kind, divisor: float, share: float) -> tuple[list[float | None], list[float | None]]:
    chosen = np.unique(np.linspace(0, kind.number - 1, max(1, int(share * kind.number))).round().astype(int))
    radii, rates = kind.each("radius_of_gyration_m"), kind.medians(INITIATION.name)
    return shortened(radii[chosen], divisor), shortened(rates[chosen])


def _middle(kind: Kind, divisor: float) -> Content:
    low, median, high = shortened(quantiles(kind.events[INITIATION.name], QUARTILES))
    radius = kind.each("radius_of_gyration_m").mean()
    return {"x": shortened(np.array([radius]), divisor)[0], "y": median, "low": low, "high": high, "told": _told(kind)}


def _told(kind: Kind) -> str:
    return f"{kind.family}, {kind.each('spheres').mean():.4g} spheres, {met_name(kind.met)}"


def _distribution(
    title: str, axis: Axis, together: Mapping[str, Sequence[Kind]], met: Mapping[Condition, str]
) -> Content:
    return {
        "kind": "steps",
        "title": title,
        "x": _labels(axis),
        "y": {"label": "share of events", "log": False},
        "views": [_histogram([_values(each, axis) for each in _under(together, condition)], axis) for condition in met],
    }


def _values(all_kinds: Sequence[Kind], axis: Axis) -> FloatArray:
    return np.concatenate([kind.events[axis.name] for kind in all_kinds]) if all_kinds else np.empty(0)


def _histogram(columns: Sequence[FloatArray], axis: Axis) -> Content:
    """Shares of all events in bins; those without a value are in none."""
    finite = [
        column[np.isfinite(column) & (column > 0)] if axis.is_logarithmic else column[np.isfinite(column)]
        for column in columns
    ]
    joined = np.concatenate(finite)
    if not len(joined):
        return {"edges": [], "shares": [], "note": "nothing fails"}
    edges = _edges(joined, axis)
    shares = [np.histogram(some, edges)[0] / max(1, len(all_)) for some, all_ in zip(finite, columns, strict=True)]
    missing = 1 - len(joined) / sum(len(column) for column in columns)
    note = f"{percent(missing)} of all events have no such value" if missing else ""
    return {"edges": shortened(edges), "shares": [shortened(each) for each in shares], "note": note}


def _edges(values: FloatArray, axis: Axis) -> FloatArray:
    low, high = float(values.min()), float(values.max())
    if axis.is_logarithmic:
        return np.geomspace(*((low, high) if low < high else (low / WIDENED, high * WIDENED)), BINS + 1)
    return np.linspace(0, axis.until or (high if high > ROUNDING else 1.0), BINS + 1)


def _breakage_rates(together: Mapping[str, Sequence[Kind]], met: Mapping[Condition, str]) -> Content:
    """Against the dissipation, of one material."""
    return {
        "kind": "points",
        "title": "Breakage rate against dissipation",
        "x": {"label": "dissipation (m²/s³)", "log": True},
        "y": {"label": "breakage rate (1/s)", "log": True},
        "views": [_intervals(together, material) for material, _ in met],
    }


def _intervals(together: Mapping[str, Sequence[Kind]], material: str) -> Content:
    drawn = [[_interval(kind) for kind in each if kind.material == material] for each in together.values()]
    note = f"bars: {CONFIDENCE:.0%} intervals; without a point: upper bounds, where nothing has failed"
    return {"points": [{"x": [], "y": []} for _ in drawn], "medians": drawn, "note": note}


def _interval(kind: Kind) -> Content:
    """What is zero is None, which no axis by factors has."""
    found = found_rate(kind)
    rates = (0.0, 0.0, 0.0) if found is None else (found.rate, *found.interval)
    middle, low, high = (each or None for each in shortened(np.array(rates)))
    return {"x": kind.met, "y": middle, "low": low, "high": high, "told": _told(kind)}
