"""Straight lines by least squares, with Student's confidence intervals for independent errors of equal size.

Source: N. R. Draper and H. Smith, Applied Regression Analysis, 3rd ed. (Wiley, 1998), sections 1.4 and 3.1.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray

CONFIDENCE = 0.95


@dataclass(frozen=True)
class StraightLine:
    """y = slope · x + intercept, fitted to points. Made by `straight_line`.

    Attributes
    ----------
    slope, intercept
        Of the line; the intercept is its y at x = 0.
    reach
        Quantile of Student's distribution times the standard deviation of the points from the line.
    count, mean, spread
        Number of points, mean of their x, and sum of the squares of their distances from it.
    """

    slope: float
    intercept: float
    reach: float
    count: int
    mean: float
    spread: float

    @property
    def slope_reach(self) -> float:
        """Half the width of the confidence interval of the slope."""
        return self.reach / float(np.sqrt(self.spread))

    def reach_at(self, x: float) -> float:
        """Half the width of the confidence interval of the line's y at x."""
        return self.reach * float(np.sqrt(1 / self.count + (x - self.mean) ** 2 / self.spread))


def straight_line(x: FloatArray, y: FloatArray, confidence: float = CONFIDENCE) -> StraightLine:
    """The straight line through points x (n,) and y (n,), n ≥ 3, not all x alike, by least squares of y."""
    offsets = x - x.mean()
    spread = float(offsets @ offsets)
    slope = float(offsets @ y) / spread
    residual = y - y.mean() - slope * offsets
    freedoms = len(x) - 2
    reach = student_quantile(confidence, freedoms) * float(np.sqrt(residual @ residual / freedoms))
    return StraightLine(slope, float(y.mean() - slope * x.mean()), reach, len(x), float(x.mean()), spread)


def student_quantile(confidence: float, freedoms: int) -> float:
    """Half the width, in standard errors, of a two-sided confidence interval by Student's distribution."""
    from scipy.special import stdtrit  # scipy.stats would double the time that importing the package takes

    return float(stdtrit(freedoms, 0.5 + checked_confidence(confidence) / 2))


def checked_confidence(confidence: float) -> float:
    """A share between 0 and 1."""
    confidence = _checks.positive("confidence", confidence)
    if confidence >= 1:
        raise ValueError(f"confidence: expected a share between 0 and 1, got {confidence:g}; take 0.95")
    return confidence
