"""Breakage kernels as a table, for codes that solve population balances."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.populations.breakage_rate import EventRate
from rheoclast.populations.fragment_distribution import EROSIVE, FragmentDistribution

KERNEL_COLUMNS: Mapping[str, str] = MappingProxyType(
    {
        "spheres": "mean number of primary spheres of the aggregates that break",
        "radius_of_gyration": "their mean radius of gyration, m",
        "dissipation": "mean dissipation of turbulent energy per mass, m2/s3",
        "rate": "breakage rate of one aggregate, 1/s",
        "rate_low": "lower bound of its confidence interval, 1/s",
        "rate_high": "upper bound of its confidence interval, 1/s",
        "failures": "number of failures that the rate is from",
        "time": "total time in which they happened, s",
        "critical_dissipation": "critical dissipation in Kusters' exponential law, m2/s3",
        "mean_fragments": "mean number of fragments of one breakage",
        "second_moment": "mean sum of the squared mass fractions of the fragments of one breakage",
        "erosive_share": f"share of the fragments, by number, with a mass fraction below {EROSIVE:g}",
    }
)
"""What every column of `kernel_table` holds. What is not known is not a number."""


@dataclass(frozen=True, eq=False)
class KernelEntry:
    """How aggregates of one size break in turbulence of one dissipation.

    Parameters
    ----------
    spheres
        Mean number of primary spheres.
    radius_of_gyration
        Mean radius of gyration, m.
    dissipation
        Mean dissipation of energy per mass, m²/s³.
    rate
        Breakage rate of one aggregate.
    critical_dissipation
        In Kusters' law, m²/s³; None if not known.
    fragments
        Of these aggregates; None if not known.

    Raises
    ------
    ValueError
        If a number is not positive.
    TypeError
        If rate or fragments are something else.
    """

    spheres: float
    radius_of_gyration: float
    dissipation: float
    rate: EventRate
    critical_dissipation: float | None = None
    fragments: FragmentDistribution | None = None

    def __post_init__(self) -> None:
        for name in ("spheres", "radius_of_gyration", "dissipation"):
            _checks.positive(name, getattr(self, name))
        _checks.instance("rate", self.rate, EventRate)
        if self.critical_dissipation is not None:
            _checks.positive("critical_dissipation", self.critical_dissipation)
        if self.fragments is not None:
            _checks.instance("fragments", self.fragments, FragmentDistribution)


def kernel_table(entries: Iterable[KernelEntry]) -> dict[str, FloatArray]:
    """Columns (n,) with one row per entry, in the order given, as described in `KERNEL_COLUMNS`.

    Write them with `write_kernel`.

    Raises
    ------
    ValueError
        If there is no entry.
    TypeError
        If something is not a `KernelEntry`.
    """
    rows = []
    for k, entry in enumerate(entries):
        _checks.instance(f"entries[{k}]", entry, KernelEntry, "for instance KernelEntry(spheres=300, ...)")
        rows.append(_row(entry))
    if not rows:
        raise ValueError("entries: expected at least one, got none")
    return {name: np.array([row[name] for row in rows], dtype=np.float64) for name in KERNEL_COLUMNS}


def _row(entry: KernelEntry) -> dict[str, float]:
    fragments, critical = entry.fragments, entry.critical_dissipation
    return {
        "spheres": entry.spheres,
        "radius_of_gyration": entry.radius_of_gyration,
        "dissipation": entry.dissipation,
        "rate": entry.rate.rate,
        "rate_low": entry.rate.interval[0],
        "rate_high": entry.rate.interval[1],
        "failures": entry.rate.events,
        "time": entry.rate.time,
        "critical_dissipation": np.nan if critical is None else critical,
        "mean_fragments": np.nan if fragments is None else fragments.mean_fragments,
        "second_moment": np.nan if fragments is None else fragments.moment(2),
        "erosive_share": np.nan if fragments is None else fragments.erosive_share(),
    }
