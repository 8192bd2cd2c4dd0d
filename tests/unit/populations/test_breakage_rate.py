"""Rates of breakage from waiting times of known distribution, and from crossings counted by hand."""

import numpy as np
import pytest
from scipy.stats import poisson

import rheoclast as rc
from rheoclast.breakup.load_history import LoadHistory
from rheoclast.populations.breakage_rate import (
    WaitingTimes,
    breakage_rate,
    exceedance_rate,
    first_failure_times,
    poisson_rate,
)


class Interpolated:
    """Loads with straight lines between samples."""

    criteria = ("tension",)

    def __init__(self, times, largest):
        self.samples = times, largest

    def largest_at(self, time):
        return float(np.interp(time, *self.samples))

    def largest(self, times):
        return np.interp(times, *self.samples), np.zeros(len(times), int), np.zeros(len(times), int)


def sampled(times, largest):
    times, largest = np.array(times, float), np.array(largest, float)
    zeros = np.zeros(len(times), int)
    return LoadHistory(times, largest, zeros, zeros, Interpolated(times, largest))


RISING = sampled([10, 14], [0, 2])
HOLDING = sampled([0, 5, 7], [0, 0.4, 0.2])
OVERLOADED = sampled([0, 3, 4, 9], [3, 0, 3, 0])


class TestWaiting:
    def test_by_hand(self):
        waiting = first_failure_times([RISING, HOLDING, OVERLOADED])
        np.testing.assert_allclose(waiting.times, [2, 7])
        assert waiting.failed.tolist() == [True, False]
        assert waiting.overloaded == 1

    def test_scale(self):
        waiting = first_failure_times([RISING, HOLDING], level=1 / 4)
        np.testing.assert_allclose(waiting.times, [0.5, 3.125], rtol=1e-9)
        assert waiting.failed.all()
        assert not first_failure_times([RISING, OVERLOADED], level=10).failed.any()

    def test_a_generator_is_read_once(self):
        assert len(first_failure_times(each for each in (RISING, HOLDING)).times) == 2

    def test_failure_after_zero_crosses_from_negative_ratios(self):
        assert first_failure_times([sampled([-3, 1], [-1, 1])], level=1.0).times == pytest.approx(4.0)

    def test_refused(self):
        with pytest.raises(ValueError, match=r"not start overloaded, got 1 of 1 that do; give more"):
            first_failure_times([OVERLOADED])
        with pytest.raises(ValueError, match=r"not start overloaded, got 0 of 0 that do; give more"):
            first_failure_times([])
        with pytest.raises(TypeError, match=r"histories\[1\]: expected LoadHistory, got int; make one with"):
            first_failure_times([RISING, 3])
        with pytest.raises(ValueError, match=r"times\[1\]: expected a positive number, got 0"):
            WaitingTimes([1.0, 0.0], [True, True])
        with pytest.raises(ValueError, match=r"failed: expected 2 of True and False, one per time, got int"):
            WaitingTimes([1.0, 2.0], [1, 0])
        with pytest.raises(ValueError, match=r"failed: expected 1 of True and False, one per time, got bool of shape"):
            WaitingTimes([1.0], [True, False])


class TestPoisson:
    @pytest.mark.parametrize("events", [1, 4, 60])
    def test_bounds_are_the_rates_at_which_the_count_would_be_extreme(self, events):
        found = poisson_rate(events, 20.0, confidence=0.9)
        lower, upper = (20.0 * bound for bound in found.interval)
        assert poisson.sf(events - 1, lower) == pytest.approx(0.05, rel=1e-9)
        assert poisson.cdf(events, upper) == pytest.approx(0.05, rel=1e-9)
        assert found.rate == events / 20.0

    def test_nothing_happened(self):
        """Rule of three: with 95 % confidence to one side, at most three over the time."""
        found = poisson_rate(0, 5.0, confidence=0.9)
        assert (found.rate, found.interval[0]) == (0, 0)
        assert found.interval[1] == pytest.approx(-np.log(0.05) / 5)

    def test_refused(self):
        with pytest.raises(ValueError, match="events: expected an integer of at least 0, got -1"):
            poisson_rate(-1, 1.0)
        with pytest.raises(ValueError, match="time: expected a positive number, got 0"):
            poisson_rate(1, 0.0)


def test_rate_by_hand():
    found = breakage_rate(WaitingTimes([1.0, 2.0, 5.0], [True, True, False]))
    assert (found.events, found.time, found.rate) == (2, 8.0, 0.25)
    with pytest.raises(TypeError, match="waiting: expected WaitingTimes, got list; make them with first_f"):
        breakage_rate([1.0])


@pytest.mark.parametrize("longest", [0.3, 1.0, 3.0])
def test_censored_exponential_times(longest):
    """Unbiased whatever is censored, and the interval covers the rate in 95 % of experiments, or somewhat more."""
    rng = np.random.default_rng(1)
    rate, covered, rates = 2.5, 0, []
    for _ in range(2000):
        waited = rng.exponential(1 / rate, 40)
        found = breakage_rate(WaitingTimes(np.minimum(waited, longest), waited <= longest))
        covered += found.interval[0] <= rate <= found.interval[1]
        rates.append(found.rate)
    assert 0.94 <= covered / 2000 <= 0.99
    assert np.mean(rates) == pytest.approx(rate, rel=0.04)  # the bias of the likelihood is 1/n of the rate


class TestExceedanceRate:
    def test_by_hand(self):
        """OVERLOADED is below 1 from 2 s to 3⅓ s and from 7⅓ s on; RISING for 2 s, HOLDING throughout."""
        found = exceedance_rate([RISING, HOLDING, OVERLOADED])
        assert found.events == 2
        assert found.time == pytest.approx(2 + 7 + 4 / 3 + 5 / 3)
        assert found.rate == pytest.approx(2 / 12)
        assert found.interval == poisson_rate(2, found.time).interval

    def test_waves(self):
        """A sine crosses upwards once per period, and is below ½ for two thirds of it."""
        times = np.linspace(0, 50, 50_001)
        found = exceedance_rate([sampled(times, np.sin(2 * np.pi * (times - 0.25)))], level=1 / 2)
        assert found.events == 50
        assert found.rate == pytest.approx(1.5, rel=1e-4)

    def test_memoryless_switching_meets_first_failures(self):
        """Exponential times below, then one above: up-crossings per time below are the rate of first failures."""
        rng = np.random.default_rng(6)
        histories = []
        for _ in range(200):
            lasts = np.stack([rng.exponential(1 / 0.8, 20), rng.exponential(0.5, 20)], axis=1).ravel()
            ends = np.cumsum(lasts)
            times = np.concatenate([[0], np.stack([ends, ends + 1e-9], axis=1).ravel()])
            histories.append(sampled(times, np.append(np.tile([0, 0, 2, 2], 20), 0)))
        crossings = exceedance_rate(histories)
        assert crossings.events == 4000
        assert crossings.rate == pytest.approx(0.8, rel=0.05)
        first = breakage_rate(first_failure_times(histories))
        assert first.interval[0] < crossings.rate < first.interval[1]

    def test_refused(self):
        with pytest.raises(ValueError, match="time: expected a positive number, got 0"):
            exceedance_rate([sampled([0, 1], [2, 3])])
        with pytest.raises(TypeError, match=r"histories\[0\]: expected LoadHistory, got GradientHistory"):
            exceedance_rate(rc.gaussian_histories(1, 1.0, 1.0, 1.0, seed=0))
