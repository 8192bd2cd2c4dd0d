"""How large the fragments of broken aggregates are.

The daughter distribution b(x) of population balances is the number of fragments per event and unit of their mass
fraction x: its integral is the mean number of fragments, and that of x b(x) is 1 (D. Ramkrishna, Population Balances
(Academic Press, 2000), section 3.2). Intervals are from resampling whole events, because the fragments of one event
depend on each other: B. Efron, Ann. Stat. 7 (1979) 1.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rheoclast import _checks
from rheoclast._checks import FloatArray, IntArray
from rheoclast.breakup.event import Breakup
from rheoclast.fits import CONFIDENCE, checked_confidence

EROSIVE = 0.05
RESAMPLINGS = 1000


@dataclass(frozen=True, eq=False)
class FragmentDistribution:
    """Sizes of fragments, as fractions of the mass of what broke. Made by `fragment_distribution`.

    Attributes
    ----------
    fractions
        (F,) mass fraction of every fragment, event by event.
    event
        (F,) the event that it comes from, 0 … events − 1.
    edges
        (B + 1,) bounds of the bins, from 0 to 1. A fraction that lies on a bound belongs to the bin above.
    number, number_interval
        (B,) share of all fragments, by number, in each bin; bounds (B, 2) of its confidence interval.
    mass, mass_interval
        (B,) share of all mass in each bin, every event alike; bounds (B, 2).
    """

    fractions: FloatArray
    event: IntArray
    edges: FloatArray
    number: FloatArray
    number_interval: FloatArray
    mass: FloatArray
    mass_interval: FloatArray

    @property
    def events(self) -> int:
        """Number of events."""
        return int(self.event[-1]) + 1

    @property
    def mean_fragments(self) -> float:
        """Mean number of fragments of an event."""
        return len(self.fractions) / self.events

    @property
    def daughter_density(self) -> FloatArray:
        """Mean b (B,) of the daughter distribution over each bin: Σ b · width is the mean number of fragments."""
        return self.mean_fragments * self.number / np.diff(self.edges)

    def moment(self, order: float) -> float:
        """Moment ∫ x^order b(x) dx of the daughter distribution, from the fragments themselves, not from the bins.

        Of order 0 it is the mean number of fragments, of order 1 it is 1.
        """
        return float(np.sum(self.fractions ** float(_checks.real_array("order", order, ()))) / self.events)

    def cumulative(self, fraction: ArrayLike) -> FloatArray:
        """Share of all fragments, by number, with a mass fraction of at most `fraction` (...)."""
        given = _checks.real_array("fraction", fraction, np.shape(fraction))
        return np.searchsorted(np.sort(self.fractions), given, side="right") / len(self.fractions)

    def erosive_share(self, fraction: float = EROSIVE) -> float:
        """Share of all fragments, by number, with a mass fraction below `fraction`.

        Where every event makes two fragments, the share of events that only erode is twice as large.
        """
        return float(np.mean(self.fractions < _checks.positive("fraction", fraction)))


def fragment_distribution(
    breakups: Iterable[Breakup] | Iterable[ArrayLike],
    *,
    bins: int | ArrayLike = 20,
    confidence: float = CONFIDENCE,
    seed: int = 0,
) -> FragmentDistribution:
    """Distribution of the sizes of fragments over many events.

    Parameters
    ----------
    breakups
        Events: each a `Breakup`, whose spheres count by their volume, or the masses of its fragments, two or more
        positive numbers in any unit. Breakups without a split are left out.
    bins
        Number of bins of equal width, or their bounds, increasing from 0 to 1.
    confidence
        Of the intervals, which are percentiles over 1000 resamplings of the events. They need some tens of events, and
        have no width for a bin into which no fragment fell.
    seed
        Of the resampling.

    Raises
    ------
    ValueError
        If no event splits, masses are not positive or fewer than two, or bins are not bounds from 0 to 1.
    """
    edges = _edges(bins)
    tail = (1 - checked_confidence(confidence)) / 2
    random = _checks.seeded(seed)
    each = _fractions(breakups)
    fractions, event = np.concatenate(each), np.repeat(np.arange(len(each)), [len(parts) for parts in each])
    shares, bounds = [], []
    for weight in (np.ones(len(fractions)), fractions):
        counts = _by_event(event, fractions, weight, edges)
        shares.append(_checks.frozen(_normalised(counts.sum(axis=0))))
        resampled = _normalised(_resampled(counts, random))
        bounds.append(_checks.frozen(np.quantile(resampled, [tail, 1 - tail], axis=0).T))
    fractions, event, edges = map(_checks.frozen, (fractions, event, edges))
    return FragmentDistribution(fractions, event, edges, shares[0], bounds[0], shares[1], bounds[1])


def _fractions(breakups: Iterable[Breakup] | Iterable[ArrayLike]) -> Sequence[FloatArray]:
    """Mass fractions (n,) of the fragments of every event that splits."""
    masses = [_masses(k, each) for k, each in enumerate(breakups)]
    split = [each / each.sum() for each in masses if each is not None]
    if not split:
        raise ValueError(f"breakups: expected at least one that splits, got none of {len(masses)}")
    return split


def _masses(position: int, event: Breakup | ArrayLike) -> FloatArray | None:
    """Masses of the fragments of an event, in any unit; None if it does not split."""
    if isinstance(event, Breakup):
        volumes = event.aggregate.spheres.radii**3
        return np.array([volumes[members].sum() for members in event.spheres]) if event.splits else None
    masses = _checks.positive_array(f"breakups[{position}]", event, ("n",))
    if len(masses) < 2:
        raise ValueError(f"breakups[{position}]: expected the masses of two fragments or more, got {len(masses)}")
    return masses


def _edges(bins: int | ArrayLike) -> FloatArray:
    if np.ndim(bins) == 0:
        return np.linspace(0, 1, _checks.whole_number("bins", bins, 1) + 1)
    edges = _checks.real_array("bins", bins, ("n",))
    if len(edges) < 2 or edges[0] != 0 or edges[-1] != 1 or not np.all(np.diff(edges) > 0):
        raise ValueError(f"bins: expected bounds that increase from 0 to 1, got {edges.tolist()!r:.60}")
    return edges


def _by_event(event: IntArray, fractions: FloatArray, weight: FloatArray, edges: FloatArray) -> FloatArray:
    """Weight (events, B) of the fragments in every bin."""
    bins = len(edges) - 1
    sums = np.zeros((int(event[-1]) + 1, bins))
    place = np.minimum(np.searchsorted(edges, fractions, side="right") - 1, bins - 1)
    np.add.at(sums, (event, place), weight)
    return sums


def _resampled(counts: FloatArray, random: np.random.Generator) -> FloatArray:
    """Sums (1000, B) over as many events as there are, drawn with replacement."""
    events = len(counts)
    drawn = (np.bincount(random.integers(events, size=events), minlength=events) for _ in range(RESAMPLINGS))
    return np.stack([each @ counts for each in drawn])


def _normalised(sums: FloatArray) -> FloatArray:
    return sums / sums.sum(axis=-1, keepdims=True)
