"""What the records of one kind of aggregate tell: failures, rates and fragments at any dissipation.

Dissipation is in units of ν (F/(μ a²))², with F the strength of the contacts, and time in Kolmogorov times (ν/ε)^½.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from records import BLOCK, Columns, stacked

import rheoclast as rc

FEWEST_FAILURES = 20
FASTEST = 3.0  # failures per Kolmogorov time: beyond, waits are hardly longer than the step of the paths
DISSIPATIONS = 10.0 ** (np.arange(-90, 11) / 10)
RESAMPLINGS, TAIL = 1000, 0.025
Interval = tuple[float, float]


class Rate(NamedTuple):
    """Rate of breakage at one dissipation, and its interval from resampling whole seeds."""

    dissipation: float
    measured: rc.EventRate
    interval: Interval
    overloaded: float


@dataclass(frozen=True, eq=False)
class Ensemble:
    """All blocks of one model, family and number of spheres.

    Attributes
    ----------
    clusters
        Lengths and mean tension of the clusters, a row per seed.
    block, time, tension, smaller
        The records, block after block, each from its start on.
    seed
        Of every block.
    """

    model: str
    family: str
    spheres: int
    clusters: Columns
    block: NDArray[np.intp]
    time: NDArray[np.float64]
    tension: NDArray[np.float64]
    smaller: NDArray[np.intp]
    seed: NDArray[np.intp]

    def mean(self, measure: str) -> float:
        """Mean over the clusters of a column of their table, such as the radius of gyration."""
        return float(self.clusters[measure].mean())

    def first_failures(self, dissipation: float) -> NDArray[np.intp]:
        """Positions among the records of the first failure of every block that has one."""
        failing = np.flatnonzero(self.tension >= dissipation**-0.5)
        return failing[np.unique(self.block[failing], return_index=True)[1]]

    def rate(self, dissipation: float) -> Rate | None:
        """Rate of breakage; none where too few of those that do not start overloaded fail, or all too fast."""
        first = self.first_failures(dissipation)
        times, failed = np.full(len(self.seed), BLOCK), np.zeros(len(self.seed), dtype=bool)
        times[self.block[first]], failed[self.block[first]] = self.time[first], True
        whole = times > 0
        if np.sum(failed & whole) < FEWEST_FAILURES:
            return None
        waiting = rc.WaitingTimes(times[whole], failed[whole], overloaded=int((~whole).sum()))
        measured = rc.breakage_rate(waiting)
        if measured.rate > FASTEST:
            return None
        failures, time = resampled(self.seed[whole], waiting.failed, waiting.times)
        return Rate(dissipation, measured, bounds(failures / time), waiting.overloaded / len(self.seed))

    @cached_property
    def rates(self) -> tuple[Rate, ...]:
        """Rates at all of `DISSIPATIONS` where they can be measured."""
        return tuple(rate for rate in map(self.rate, DISSIPATIONS.tolist()) if rate is not None)

    def dissipation_at(self, rate: float) -> float:
        """Dissipation at which the rate has a value, between neighbours of `rates`; not a number if it never has."""
        found = self.rates
        logarithms = np.log([each.measured.rate for each in found])
        places = np.log([each.dissipation for each in found])
        return float(np.exp(np.interp(np.log(rate), logarithms, places, np.nan, np.nan)))

    def smaller_shares(self, dissipation: float) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
        """Mass fraction of the smaller fragment of every breakage, and the seeds; overloaded starts left out."""
        first = self.first_failures(dissipation)
        first = first[self.time[first] > 0]
        return self.smaller[first] / self.spheres, self.seed[self.block[first]]


def ensembles(seeds: Iterable[tuple[Columns, Columns]]) -> list[Ensemble]:
    """Every model, family and size, from the tables of `records.run` for every seed."""
    parts: dict[tuple[str, str, int], list[tuple[Columns, Columns]]] = {}
    for clusters, found in seeds:
        for row in range(len(clusters["seed"])):
            own = {name: column[row : row + 1] for name, column in clusters.items()}
            kind = own["model"].item(), own["family"].item(), own["spheres"].item()
            here = found["cluster"] == row
            parts.setdefault(kind, []).append((own, {name: column[here] for name, column in found.items()}))
    return [_ensemble(kind, each) for kind, each in parts.items()]


def _ensemble(kind: tuple[str, str, int], parts: Sequence[tuple[Columns, Columns]]) -> Ensemble:
    """One of them; blocks are counted through all seeds."""
    clusters, found = stacked([each for each, _ in parts]), stacked([each for _, each in parts])
    blocks = np.array([int(each["block"][-1]) + 1 for _, each in parts])
    first = np.repeat(np.cumsum(blocks) - blocks, [len(each["block"]) for _, each in parts])
    columns = (found[name] for name in ("time", "tension", "smaller"))
    return Ensemble(*kind, clusters, found["block"] + first, *columns, np.repeat(clusters["seed"], blocks))


def resampled(seed: ArrayLike, *values: ArrayLike) -> Iterator[NDArray[np.float64]]:
    """Sums (1000,) of each of the values over as many seeds as there are, drawn with replacement, all alike."""
    names, label = np.unique(np.asarray(seed), return_inverse=True)
    drawn = np.random.default_rng(1).multinomial(len(names), np.full(len(names), 1 / len(names)), RESAMPLINGS)
    for value in values:
        yield drawn @ np.bincount(label, np.asarray(value, dtype=np.float64))


def bounds(samples: NDArray[np.float64]) -> Interval:
    """The middle 95 % of samples."""
    low, high = np.quantile(samples, [TAIL, 1 - TAIL]).tolist()
    return low, high


def local_exponents(rates: Sequence[Rate]) -> NDArray[np.float64]:
    """Slope d ln f / d ln ε at every rate: f = (f τ) (ε/ν)^½ is taken in units that do not change with ε."""
    dissipation = np.log([each.dissipation for each in rates])
    return 0.5 + np.gradient(np.log([each.measured.rate for each in rates]), dissipation)
