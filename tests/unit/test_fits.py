"""Straight lines against NumPy's fit and covariance, and against many samples of known scatter."""

import numpy as np
import pytest
from scipy.stats import linregress, t

from rheoclast.fits import checked_confidence, straight_line, student_quantile

X = np.array([1.0, 2.0, 4.0, 4.5, 7.0, 9.0])
Y = np.array([2.1, 2.9, 5.3, 5.0, 8.2, 9.6])


def test_line_and_errors_are_the_textbook_ones():
    found, expected = straight_line(X, Y, 0.9), linregress(X, Y)
    quantile = t.ppf(0.95, len(X) - 2)
    assert found.slope == pytest.approx(expected.slope, rel=1e-12)
    assert found.intercept == pytest.approx(expected.intercept, rel=1e-12)
    assert found.slope_reach == pytest.approx(quantile * expected.stderr, rel=1e-12)
    assert found.reach_at(0.0) == pytest.approx(quantile * expected.intercept_stderr, rel=1e-12)


def test_error_at_any_place_is_that_of_the_intercept_there():
    found = straight_line(X, Y)
    for place in (-3.0, 4.2, 20.0):
        assert found.reach_at(place) == pytest.approx(straight_line(X - place, Y).reach_at(0.0), rel=1e-12)


def test_interval_covers_as_often_as_it_says():
    rng = np.random.default_rng(0)
    lines = [straight_line(X, 3 - 0.5 * X + rng.normal(size=len(X)), 0.8) for _ in range(2000)]
    assert np.mean([abs(line.slope + 0.5) < line.slope_reach for line in lines]) == pytest.approx(0.8, abs=0.03)
    covered = [abs(line.intercept + 2 * line.slope - 2) < line.reach_at(2.0) for line in lines]
    assert np.mean(covered) == pytest.approx(0.8, abs=0.03)


def test_quantile():
    assert student_quantile(0.95, 7) == pytest.approx(t.ppf(0.975, 7), rel=1e-12)


@pytest.mark.parametrize("share", [1.0, 95])
def test_confidence_above_one(share):
    with pytest.raises(ValueError, match=f"confidence: expected a share between 0 and 1, got {share:g}; take 0.95"):
        checked_confidence(share)
