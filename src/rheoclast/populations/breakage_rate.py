"""How often the aggregates of a population break: rates from first failures, and from up-crossings of their strength.

Waiting times that end without failure are censored. For waiting times that are exponential the rate of maximum
likelihood is failures over total time: B. Epstein and M. Sobel, J. Am. Stat. Assoc. 48 (1953) 486. Its interval is that
of a Poisson count: F. Garwood, Biometrika 28 (1936) 437. The rate of up-crossings per time below the threshold: M. U.
Babler, M. Morbidelli and J. Baldyga, J. Fluid Mech. 612 (2008) 261; held against first failures in turbulence by M. U.
Babler, L. Biferale and A. S. Lanotte, Phys. Rev. E 85 (2012) 025301.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.breakup.load_history import LoadHistory
from rheoclast.fits import CONFIDENCE, checked_confidence


@dataclass(frozen=True, eq=False)
class WaitingTimes:
    """How long aggregates last. Made by `first_failure_times`.

    Parameters
    ----------
    times
        (n,) in s, positive: until failure, or until nobody looked any more.
    failed
        (n,) whether it ended with failure; otherwise the time is censored.
    overloaded
        Number of further aggregates that were overloaded from the beginning.

    Raises
    ------
    ValueError
        If a time is not positive, there is none, or the lengths differ.
    """

    times: FloatArray
    failed: np.ndarray[tuple[int], np.dtype[np.bool_]]
    overloaded: int = 0

    def __post_init__(self) -> None:
        times = _checks.positive_array("times", self.times, ("n",))
        failed = np.array(self.failed)
        if failed.dtype != np.bool_ or failed.shape != times.shape:
            raise ValueError(
                f"failed: expected {len(times)} of True and False, one per time, "
                f"got {failed.dtype} of shape {failed.shape}"
            )
        object.__setattr__(self, "times", times)
        object.__setattr__(self, "failed", _checks.frozen(failed))
        object.__setattr__(self, "overloaded", _checks.whole_number("overloaded", self.overloaded, 0))


@dataclass(frozen=True)
class EventRate:
    """Events per time: failures, crossings, or whatever was counted.

    Attributes
    ----------
    rate
        In 1/s; zero if nothing happened.
    interval
        Bounds of its confidence interval in 1/s, from zero if nothing happened.
    events
        Their number.
    time
        Total time in s in which they may have happened.
    """

    rate: float
    interval: tuple[float, float]
    events: int
    time: float


def first_failure_times(histories: Iterable[LoadHistory], *, level: float = 1.0) -> WaitingTimes:
    """Time from the start of each history to the first failure, censored where the history ends without one.

    Histories that start with an overloaded contact are counted apart: such an aggregate would not have come there.

    Parameters
    ----------
    histories
        Of any number of aggregates; a generator is read once and kept by none.
    level
        Load over strength at which contacts fail, as in `LoadHistory.first_failure`: 1/2 for contacts half as strong.

    Raises
    ------
    TypeError
        If something is not a load history.
    ValueError
        If there is no history, every one starts overloaded, or the level is not positive.
    """
    times, failed, overloaded, count = [], [], 0, 0
    for count, history in enumerate(histories, 1):
        _checks.instance(f"histories[{count - 1}]", history, LoadHistory)
        failure = history.first_failure(level)
        lasted = history.duration if failure is None else failure.time - float(history.times[0])
        if lasted == 0:
            overloaded += 1
            continue
        times.append(lasted)
        failed.append(failure is not None)
    if not times:
        raise ValueError(
            f"histories: expected at least one that does not start overloaded, got {overloaded} of {count} that do; "
            "give more histories, stronger bonds or a higher level"
        )
    return WaitingTimes(np.array(times), np.array(failed), overloaded)


@_checks.instances
def breakage_rate(waiting: WaitingTimes, *, confidence: float = CONFIDENCE) -> EventRate:
    """Rate of breakage from waiting times, censored ones included: failures over total time.

    The interval holds for waiting times that are exponential and independent, as those of rare failures are. It is
    that of a Poisson count: with the chosen confidence or more.

    Parameters
    ----------
    waiting
        From `first_failure_times`, or measured. Those overloaded from the beginning do not count.
    confidence
        Of the interval.

    Raises
    ------
    ValueError
        If the confidence is not between 0 and 1.
    TypeError
        If the waiting times are something else.
    """
    return poisson_rate(int(waiting.failed.sum()), float(waiting.times.sum()), confidence=confidence)


def exceedance_rate(
    histories: Iterable[LoadHistory], *, level: float = 1.0, confidence: float = CONFIDENCE
) -> EventRate:
    """Rate of breakage from up-crossings of the strength, per time below it.

    Every passage from holding to failing counts, as if whole aggregates took the place of broken ones at once, so that
    histories are used to their end. Loads come in bursts: a crossing is soon followed by others. The rate therefore
    exceeds that of `breakage_rate`, and the interval, which is for independent crossings, is too narrow.

    Use it for gradients that are smooth in time, as those of direct simulations. Those of the models in
    `rheoclast.turbulence` are driven by noise: their crossings multiply as the inverse square root of the time between
    instants, without end, where first failures approach a limit.

    Parameters
    ----------
    histories, level
        As in `first_failure_times`; parts of histories above the level do not count as time.
    confidence
        Of the interval.

    Raises
    ------
    TypeError
        If something is not a load history.
    ValueError
        If there is no time below the level, or it is not positive.
    """
    level = _checks.positive("level", level)
    crossings, below = 0, 0.0
    for k, history in enumerate(histories):
        _checks.instance(f"histories[{k}]", history, LoadHistory)
        above = history.exceedances(level)
        crossings, below = crossings + above.count, below + history.duration - above.duration
    return poisson_rate(crossings, below, confidence=confidence)


def poisson_rate(events: int, time: float, *, confidence: float = CONFIDENCE) -> EventRate:
    """Rate of independent events, from their number in a given time in s, with Garwood's interval.

    Its bounds are χ²(α/2; 2n)/2T and χ²(1 − α/2; 2n + 2)/2T for n events in the time T with confidence 1 − α.

    Raises
    ------
    ValueError
        If the number is negative, the time not positive, or the confidence not between 0 and 1.
    """
    from scipy.special import gammaincinv  # half a χ² with 2n freedoms is a gamma variable of shape n

    events, time = _checks.whole_number("events", events, 0), _checks.positive("time", time)
    tail = (1 - checked_confidence(confidence)) / 2
    lower = float(gammaincinv(events, tail)) if events else 0.0
    upper = float(gammaincinv(events + 1, 1 - tail))
    return EventRate(events / time, (lower / time, upper / time), events, time)
