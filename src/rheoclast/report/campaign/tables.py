"""Tables of a campaign: one row per kind of aggregates and condition."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rheoclast.fits import CONFIDENCE
from rheoclast.populations.breakage_rate import EventRate, poisson_rate
from rheoclast.report.campaign.folder import CampaignResult
from rheoclast.report.campaign.kinds import Kind, differing, parameter, parameter_name, quantiles, told_parameters
from rheoclast.report.numbers import shortened
from rheoclast.view.quantities import prefixed

QUARTILES = (0.25, 0.5, 0.75)
Content = dict[str, Any]
OfKind = Callable[[Kind], float]


@dataclass(frozen=True)
class Column:
    """A column as it is shown: key, label and unit, and its values, None where there is none."""

    key: str
    label: str
    values: list[Any]
    unit: str = ""
    whole: bool = False


@dataclass(frozen=True)
class Measure:
    """A number that is worked out of every kind, and the column that it stands in."""

    key: str
    label: str
    of: OfKind
    unit: str = ""
    whole: bool = False

    def column(self, all_kinds: Sequence[Kind]) -> Column:
        """Its values, in few digits unless they are counts."""
        values = [self.of(kind) for kind in all_kinds]
        return Column(
            self.key, self.label, values if self.whole else shortened(np.array(values)), self.unit, self.whole
        )


def _of_each(name: str) -> OfKind:
    """Mean over the aggregates."""
    return lambda kind: float(kind.each(name).mean())


def _mean(name: str) -> OfKind:
    return lambda kind: float(kind.events[name].mean())


def _quantile(name: str, share: float = 0.5) -> OfKind:
    """Of those events that have a value."""
    return lambda kind: float(quantiles(kind.known(name), (share,))[0])


def _percent(name: str, word: str) -> OfKind:
    """Share of a word among all that there are."""

    def share(kind: Kind) -> float:
        counts = kind.words(name)
        return 100 * counts[word] / counts.total() if counts else np.nan

    return share


def _quartiles(name: str, label: str) -> tuple[Measure, ...]:
    """The middle half of all events."""
    labels = (f"{label}: lower quartile", "Median", "Upper quartile")
    return tuple(
        Measure(f"{name}_{share}", label, _quantile(name, share), "1/s")
        for share, label in zip(QUARTILES, labels, strict=True)
    )


def found_rate(kind: Kind) -> EventRate | None:
    """First failures over the time in which they may have happened: those overloaded from the start have none."""
    overloaded, time = kind.events["overloaded"], float(kind.events["time_s"].sum())
    return poisson_rate(int((kind.events["failed"] & ~overloaded).sum()), time) if time else None


def _failures(kind: Kind) -> int:
    found = found_rate(kind)
    return 0 if found is None else found.events


def _rate(number: int) -> OfKind:
    """Breakage rate, or the lower or upper bound of its interval."""

    def rate(kind: Kind) -> float:
        found = found_rate(kind)
        return np.nan if found is None else (found.rate, *found.interval)[number]

    return rate


SIZES = (
    Measure("spheres", "Spheres", _of_each("spheres")),
    Measure("aggregates", "Aggregates", lambda kind: kind.number, whole=True),
    Measure("coordination", "Contacts per sphere", _of_each("mean_coordination")),
)
EVENTS = Measure("events", "Events", lambda kind: len(kind.events["aggregate"]), whole=True)
INITIATION = (EVENTS, *_quartiles("initiation_rate_per_s", "Initiation rate"))
BREAKAGE = (
    EVENTS,
    Measure("overloaded", "Overloaded at the start", lambda kind: int(kind.events["overloaded"].sum()), whole=True),
    Measure("failures", "Failures", _failures, whole=True),
    Measure("rate", "Breakage rate", _rate(0), "1/s"),
    Measure("low", f"{CONFIDENCE:.0%} interval: from", _rate(1), "1/s"),
    Measure("high", "to", _rate(2), "1/s"),
)
POSITION = Measure("position", "Distance from centre / Rg: median", _quantile("radial_position"))
OUTSIDE = Measure("smaller_share", "Share of spheres outside the largest fragment: median", _quantile("smaller_share"))
OUTCOMES = {"whole": "Stay whole", "bond": "Split by one bond", "crack": "Split by a crack"}
RATES: dict[str, tuple[str, tuple[Measure, ...]]] = {
    "first failure": ("Rates of the first failure", INITIATION),
    "breakup": ("Critical rates", (*INITIATION, *_quartiles("breakup_rate_per_s", "Breakup rate"))),
    "history": ("Rates of breakage", BREAKAGE),
}
COURSES: dict[str, tuple[str, tuple[Measure, ...]]] = {
    "first failure": (
        "What fails first",
        (POSITION, Measure("margin", "Margin to the next: median", _quantile("margin"))),
    ),
    "breakup": (
        "How they break",
        (
            *(Measure(word, label, _percent("outcome", word), "%") for word, label in OUTCOMES.items()),
            Measure("surface", "Failed contacts between fragments: mean", _mean("surface")),
            Measure("pieces", "Fragments: mean", _mean("pieces")),
            OUTSIDE,
        ),
    ),
    "history": (
        "What fails first",
        (Measure("ratio", "Largest load / strength: median", _quantile("largest_load_ratio")), POSITION, OUTSIDE),
    ),
}


def campaign_tables(result: CampaignResult, all_kinds: Sequence[Kind]) -> dict[str, Content]:
    """Titles, columns and rows of all tables, as the script takes them."""
    tables: dict[str, Content] = {}
    if all_kinds:
        named = _named(all_kinds, result.event)
        sizes = [*_columns(SIZES, all_kinds), _radius_of_gyration(all_kinds)]
        (rates, measured), (course, followed) = RATES[result.event], COURSES[result.event]
        tables["rates"] = _table(rates, [*named, *sizes, *_columns(measured, all_kinds)])
        criteria = () if result.event == "breakup" else _criteria(all_kinds)
        tables["course"] = _table(course, [*named, *_columns((*criteria, *followed), all_kinds)])
    if result.failures:
        tables["reasons"] = _table("What came to nothing", _reasons(result))
    return tables


def _table(title: str, columns: Sequence[Column]) -> Content:
    shown = [
        {"key": each.key, "label": each.label, "unit": each.unit, "error": None, "whole": each.whole}
        for each in columns
    ]
    return {"title": title, "columns": shown, "rows": {each.key: each.values for each in columns}}


def _columns(measures: Iterable[Measure], all_kinds: Sequence[Kind]) -> list[Column]:
    return [measure.column(all_kinds) for measure in measures]


def _criteria(all_kinds: Sequence[Kind]) -> tuple[Measure, ...]:
    """Shares of all criteria by which anything fails."""
    names = dict.fromkeys(name for kind in all_kinds for name in kind.words("criterion"))
    return tuple(Measure(f"by_{name}", f"By {name}", _percent("criterion", name), "%") for name in names)


def _named(all_kinds: Sequence[Kind], event: str) -> list[Column]:
    """What tells the rows apart."""
    met = Column("met", "Dissipation", [kind.met for kind in all_kinds], "m²/s³")
    if event != "history":
        met = Column("met", "Flow", met.values)
    return [
        Column("family", "Family", [kind.family for kind in all_kinds]),
        *(_parameter(name, all_kinds) for name in differing(all_kinds)),
        Column("material", "Material", [kind.material for kind in all_kinds]),
        met,
    ]


def _parameter(name: str, all_kinds: Sequence[Kind]) -> Column:
    """As numbers if all of them are, else in words."""
    given = [kind.parameters.get(name) for kind in all_kinds]
    if not all(value is None or isinstance(value, int | float) for value in given):
        given = [None if value is None else parameter(value) for value in given]
    return Column(f"asked_{name}", parameter_name(name).capitalize(), given, whole=True)


def _radius_of_gyration(all_kinds: Sequence[Kind]) -> Column:
    radii = np.array([kind.each("radius_of_gyration_m").mean() for kind in all_kinds])
    divisor, unit = prefixed(float(radii.max()), "m")
    return Column("radius_of_gyration", "Radius of gyration", shortened(radii, divisor), unit)


def _reasons(result: CampaignResult) -> list[Column]:
    counts = Counter(result.failures)
    families, parameters, reasons = zip(*counts, strict=True)
    return [
        Column("family", "Family", list(families)),
        Column("parameters", "Parameters", [told_parameters(json.loads(each)) for each in parameters]),
        Column("number", "Number", list(counts.values()), whole=True),
        Column("reason", "Reason", list(reasons)),
    ]
