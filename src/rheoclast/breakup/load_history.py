"""The largest load on an aggregate in the course of time: first failure, exceedances, maximum."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rheoclast import _checks
from rheoclast._checks import FloatArray, IntArray
from rheoclast.breakup.contact_response import ContactResponse
from rheoclast.breakup.ratio_response import RatioResponse
from rheoclast.breakup.trajectory_loads import INSTANTS_AT_ONCE, TrajectoryLoads
from rheoclast.hydrodynamics.trajectory import Trajectory
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.criteria.criterion import Criterion
from rheoclast.mechanics.criteria.load_ratios import EVERY_LIMIT

SAMPLES = 40  # per inverse size of the velocity gradient; the load turns by at most some degrees in between
MOST_SAMPLES = 10**8
INSIDE = 9  # instants inside a span that is narrowed to the two parts next to the best of them
NARROWINGS = 12  # of a span of two samples to 1e-8 of it: the square root of rounding, to which a peak can be told
ROOT = 1e-12  # of the time between samples
ROUNDING = 1e-12  # of a load ratio


@dataclass(frozen=True)
class FirstFailure:
    """The first time in s at which a contact fails, its index, and which of `LoadHistory.criteria` it fails by."""

    time: float
    contact: int
    criterion: str


@dataclass(frozen=True)
class LargestLoad:
    """A load ratio, the time in s at which it is reached, and by which contact and of `LoadHistory.criteria`."""

    time: float
    ratio: float
    contact: int
    criterion: str


@dataclass(frozen=True)
class Exceedances:
    """How often, and for how many seconds in all, a load ratio is above a level; a start above it does not count."""

    count: int
    duration: float


@dataclass(frozen=True, eq=False)
class LoadHistory:
    """Largest load ratio over all contacts and criteria, along a trajectory. Made by `load_history`.

    All that it tells is told of its samples, so that some load reaches a level if and only if `maximum` does. A level
    is a load over strength: 1 where contacts fail as they are, 1/2 where they would if they were half as strong, or the
    liquid twice as viscous, at the same motion.

    Attributes
    ----------
    times
        (T,) in s, increasing.
    largest
        (T,) load over strength: a contact fails where it reaches one. Negative where tension alone has a limit and
        every contact is compressed.
    contact
        (T,) index of the contact that has it.
    criterion
        (T,) position in `criteria` of the criterion that has it.
    loads
        The same at any time of the trajectory, not of the samples only.
    """

    times: FloatArray
    largest: FloatArray
    contact: IntArray
    criterion: IntArray
    loads: TrajectoryLoads

    @property
    def criteria(self) -> tuple[str, ...]:
        """Names of the criteria that `criterion` counts."""
        return self.loads.criteria

    @property
    def duration(self) -> float:
        """Time from the first sample to the last, s."""
        return float(self.times[-1] - self.times[0])

    @property
    def maximum(self) -> LargestLoad:
        """The largest load of all samples."""
        best = int(self.largest.argmax())
        criterion = self.criteria[self.criterion[best]]
        return LargestLoad(float(self.times[best]), float(self.largest[best]), int(self.contact[best]), criterion)

    def first_failure(self, level: float = 1.0) -> FirstFailure | None:
        """First time at which a load ratio reaches a level; None if none does.

        Between the sample before and the first at or above the level, the time is found to rounding.

        Raises
        ------
        ValueError
            If the level is not positive.
        """
        failing = self.largest >= _checks.positive("level", level)
        if not failing.any():
            return None
        first = int(failing.argmax())
        time = self._crossing(first, level) if first else float(self.times[0])
        _, contact, criterion = self.loads.largest(np.array([time]))
        return FirstFailure(time, int(contact[0]), self.criteria[criterion[0]])

    def peaks(self, level: float) -> IntArray:
        """Positions (P,) of the largest sample of every excursion to a level or above, in the order of time.

        ``history.times[peaks]`` and ``history.largest[peaks]`` are where and how large the peaks over threshold are.
        """
        above = self.largest >= float(_checks.real_array("level", level, ()))
        bounds = np.flatnonzero(np.diff(above, prepend=False, append=False))
        pairs = bounds.reshape(-1, 2).tolist()
        return np.array([start + self.largest[start:end].argmax() for start, end in pairs], dtype=np.intp)

    def exceedances(self, level: float) -> Exceedances:
        """Number of up-crossings of a level and total time above it, for straight lines between the samples."""
        excess = self.largest - float(_checks.real_array("level", level, ()))
        start, end = excess[:-1], excess[1:]
        upwards = int(np.count_nonzero((start < 0) & (end >= 0)))
        higher, change = np.maximum(start, end), np.abs(end - start)
        crossing = (start < 0) != (end < 0)
        share = np.where(crossing, higher / np.where(crossing, change, 1.0), start >= 0)
        return Exceedances(upwards, float(share @ np.diff(self.times)))

    def _crossing(self, sample: int, level: float) -> float:
        """Time at which the ratio reaches a level that it is below before a sample and not at the sample."""
        from scipy.optimize import brentq

        def excess(time: float) -> float:
            return self.loads.largest_at(time) - level

        before, after = self.times[sample - 1 : sample + 1].tolist()
        if not excess(before) < 0 < excess(after):  # one instant alone is rounded otherwise than many
            return float(after)
        return float(brentq(excess, before, after, xtol=ROOT * (after - before)))


@_checks.instances
def load_history(
    trajectory: Trajectory,
    table: ContactResponse,
    bonds: Bonds,
    *,
    times: ArrayLike | None = None,
    criterion: Criterion = EVERY_LIMIT,
) -> LoadHistory:
    """Largest load ratio of an aggregate along its trajectory, in the flow at its own rate.

    Parameters
    ----------
    trajectory, table
        Of the same aggregate: how it turns, and what its contacts then carry.
    bonds
        Strength of the contacts.
    times
        Increasing times (T,) in s, two or more, within the span of the trajectory, which are then the samples: a peak
        between two of them is not seen. By default the steps of the trajectory, which end wherever the gradients have a
        sample, each divided evenly until a part lasts at most 1/40 of 1/(Γ:Γ)^½, Γ the velocity gradient: 40 samples
        per inverse shear rate in simple shear. In addition the top of every peak that is higher than all before it.
    criterion
        When a contact fails. By default each load has its own limit, and strengths that are infinite do not count.

    Raises
    ------
    TypeError
        If an argument is something else.
    ValueError
        If no contact has a strength, the bonds have another number of contacts, the times do not increase or lie
        outside the trajectory, or the default would be more than 10⁸ times.
    """
    loads = TrajectoryLoads(trajectory, RatioResponse(table, bonds, criterion))
    instants = _resolved(trajectory) if times is None else _increasing(times)
    samples = _Samples(instants, *loads.largest(instants))
    if times is None:
        samples = _with_record_peaks(loads, samples)
    at, largest, contact, part = map(_checks.frozen, samples)
    return LoadHistory(at, largest, contact, part, loads)


class _Samples(NamedTuple):
    """Times, load ratios, contacts and criteria, (T,) each."""

    times: FloatArray
    largest: FloatArray
    contact: IntArray
    criterion: IntArray


def _with_record_peaks(loads: TrajectoryLoads, samples: _Samples) -> _Samples:
    """The samples and, between them, the tops of the peaks that are higher than all before."""
    near = _record_peaks(samples.times, samples.largest)
    tops = _tops(loads, samples.times, near)
    new = _Samples(tops, *loads.largest(tops))
    higher = new.largest > samples.largest[near]
    places = np.searchsorted(samples.times, tops[higher])
    return _Samples(*(np.insert(old, places, each[higher]) for old, each in zip(samples, new, strict=True)))


def _record_peaks(times: FloatArray, largest: FloatArray) -> IntArray:
    """Positions (P,) of samples no lower than their neighbours, near which the load may be larger than ever before.

    The parabola through such a sample and its neighbours rises above it by at most 1/8 of its second derivative times
    the square of the wider spacing. Four times as much is allowed for, and any rise at the ends. What would rise by
    rounding only, as a steady load does everywhere, is no peak.
    """
    spacing, rise = np.diff(times), np.diff(largest)
    top = np.append(True, rise > 0) & np.append(rise <= 0, True)
    bend = np.abs(np.diff(rise / spacing)) / (spacing[1:] + spacing[:-1])  # half the second derivative
    beyond = np.full(len(times), np.inf)
    beyond[1:-1] = bend * np.maximum(spacing[1:], spacing[:-1]) ** 2
    top &= beyond > ROUNDING * np.abs(largest)
    return np.flatnonzero(top & (largest + beyond >= np.maximum.accumulate(largest)))


def _tops(loads: TrajectoryLoads, times: FloatArray, near: IntArray) -> FloatArray:
    """Times (P,) of the largest loads between the neighbours of samples at positions (P,)."""
    start, end = times[np.maximum(near - 1, 0)], times[np.minimum(near + 1, len(times) - 1)]
    best = times[near]
    for _ in range(NARROWINGS):
        part = (end - start) / (INSIDE + 1)
        instants = start[:, None] + part[:, None] * np.arange(1, INSIDE + 1)
        largest = loads.largest(instants.ravel())[0].reshape(instants.shape)
        best = np.take_along_axis(instants, largest.argmax(axis=1)[:, None], axis=1)[:, 0]
        start, end = best - part, best + part
    return best


def _increasing(times: ArrayLike) -> FloatArray:
    instants = _checks.real_array("times", times, ("T",))
    if len(instants) < 2 or not np.all(np.diff(instants) > 0):
        raise ValueError("times: expected two or more increasing times; sort them and drop repetitions")
    return instants


def _resolved(trajectory: Trajectory) -> FloatArray:
    """The steps of a trajectory, divided until the velocity gradient hardly turns in a part."""
    steps = trajectory.times
    pieces = np.array_split(steps, -(-len(steps) // INSTANTS_AT_ONCE))
    sizes = np.concatenate([np.linalg.norm(trajectory.gradient(piece), axis=(1, 2)) for piece in pieces])
    lengths = np.diff(steps)
    parts = np.maximum(1, np.ceil(SAMPLES * lengths * np.maximum(sizes[1:], sizes[:-1]))).astype(np.intp)
    total = int(parts.sum())
    if total > MOST_SAMPLES:
        raise ValueError(f"times: expected at most {MOST_SAMPLES:g} by default, got {total:.3g}; pass fewer times")
    first = np.cumsum(parts) - parts
    within = np.arange(total) - np.repeat(first, parts)
    return np.append(np.repeat(steps[:-1], parts) + within * np.repeat(lengths / parts, parts), steps[-1])
