"""The largest load on an aggregate in the course of time: first failure, exceedances, maximum."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from rheoclast import _checks
from rheoclast._checks import FloatArray, IntArray
from rheoclast.breakup.contact_response import ContactResponse
from rheoclast.breakup.trajectory_loads import INSTANTS_AT_ONCE, TrajectoryLoads
from rheoclast.hydrodynamics.trajectory import Trajectory
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.criteria.criterion import Criterion
from rheoclast.mechanics.criteria.load_ratios import EVERY_LIMIT

SAMPLES = 40  # per inverse size of the velocity gradient; the load turns by at most some degrees in between
MOST_SAMPLES = 10**8
REFINEMENT = 1e-8  # of the time between samples: the square root of rounding, to which a maximum can be told

ROOT = 1e-12  # of the time between samples


@dataclass(frozen=True)
class FirstFailure:
    """The first time in s at which a contact fails, its index, and the `Criterion.name` that it fails by."""

    time: float
    contact: int
    criterion: str


@dataclass(frozen=True)
class LargestLoad:
    """A load ratio, the time in s at which it is reached, and by which contact and `Criterion.name`."""

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

    def first_failure(self, scale: float = 1.0) -> FirstFailure | None:
        """First time at which the load ratio times `scale` reaches one; None if it does not.

        A scale above one stands for a more viscous liquid, or weaker contacts, at the same motion. Between two samples
        the time is found to rounding; an excursion that begins and ends between two samples is not seen.

        Raises
        ------
        ValueError
            If the scale is not positive.
        """
        level = 1 / _checks.positive("scale", scale)
        failing = self.largest >= level
        if not failing.any():
            return None
        first = int(failing.argmax())
        time = self._crossing(first, level) if first else float(self.times[0])
        _, contact, criterion = self.loads.largest(np.array([time]))
        return FirstFailure(time, int(contact[0]), self.criteria[criterion[0]])

    def peaks(self, threshold: float) -> IntArray:
        """Positions (P,) of the largest sample of every excursion to the threshold or above, in the order of time.

        ``history.times[peaks]`` and ``history.largest[peaks]`` are where and how large the peaks over threshold are.
        """
        above = self.largest >= float(_checks.real_array("threshold", threshold, ()))
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

    @cached_property
    def maximum(self) -> LargestLoad:
        """The largest load, refined between the samples next to the largest one."""
        from scipy.optimize import minimize_scalar

        best = int(self.largest.argmax())
        before, after = self.times[[max(best - 1, 0), min(best + 1, len(self.times) - 1)]]
        refined = minimize_scalar(
            lambda time: -self.loads.largest_at(time),
            bounds=(before, after),
            method="bounded",
            options={"xatol": REFINEMENT * (after - before)},
        )
        time = float(refined.x if -refined.fun > self.largest[best] else self.times[best])
        ratio, contact, criterion = self.loads.largest(np.array([time]))
        return LargestLoad(time, float(ratio[0]), int(contact[0]), self.criteria[criterion[0]])

    def _crossing(self, sample: int, level: float) -> float:
        """Time at which the ratio reaches a level that it is below before a sample and not at the sample."""
        from scipy.optimize import brentq

        def excess(time: float) -> float:
            return self.loads.largest_at(time) - level

        before, after = self.times[sample - 1 : sample + 1].tolist()
        if not excess(before) < 0 < excess(after):  # one instant alone is rounded otherwise than many
            return float(after)
        return float(brentq(excess, before, after, xtol=ROOT * (after - before)))


def load_history(
    trajectory: Trajectory,
    table: ContactResponse,
    bonds: Bonds,
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
        Increasing times (T,) in s, two or more, within the span of the trajectory. By default the steps of the
        trajectory, which end wherever the gradients have a sample, each divided evenly until a part lasts at most 1/40
        of 1/(Γ:Γ)^½, Γ the velocity gradient: 40 samples per inverse shear rate in simple shear.
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
    loads = TrajectoryLoads(trajectory, table, bonds, criterion)
    instants = _resolved(trajectory) if times is None else _increasing(times)
    largest, contact, part = map(_checks.frozen, loads.largest(instants))
    return LoadHistory(_checks.frozen(instants), largest, contact, part, loads)


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
