"""Power laws between measured quantities, such as critical rate and radius of gyration, or breakage and dissipation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.fits import CONFIDENCE, straight_line


@dataclass(frozen=True)
class PowerLaw:
    """y = prefactor · x^exponent, each with the bounds of its confidence interval. Made by `power_law`."""

    exponent: float
    exponent_interval: tuple[float, float]
    prefactor: float
    prefactor_interval: tuple[float, float]

    def __call__(self, x: ArrayLike) -> FloatArray:
        """The law's y (...) at positive x (...)."""
        return self.prefactor * _checks.positive_array("x", x, np.shape(x)) ** self.exponent


def power_law(x: ArrayLike, y: ArrayLike, *, confidence: float = CONFIDENCE) -> PowerLaw:
    """Exponent and prefactor of y over x, by least squares of ln y on ln x.

    Parameters
    ----------
    x, y
        Positive numbers (n,), n ≥ 3: x is what was chosen, y what scatters, by a factor of the same distribution
        everywhere.
    confidence
        Of the intervals, which are Student's for independent points. The prefactor is y at x = 1, in the units of both;
        where x = 1 is far from all points its interval is wide.

    Raises
    ------
    ValueError
        If there are fewer than three points, a number is not positive, or all x are alike.
    """
    given = _checks.positive_array("x", x, ("n",))
    measured = _checks.positive_array("y", y, (len(given),))
    if len(given) < 3:
        raise ValueError(f"x: expected at least 3 points, got {len(given)}; measure at more places")
    if np.ptp(np.log(given)) == 0:
        raise ValueError(f"x: expected several places, got {len(given)} times {given[0]:g}; measure at other places")
    line = straight_line(np.log(given), np.log(measured), confidence)
    below, above = line.slope - line.slope_reach, line.slope + line.slope_reach
    reach = line.reach_at(0.0)
    lowest, prefactor, highest = np.exp([line.intercept - reach, line.intercept, line.intercept + reach]).tolist()
    return PowerLaw(line.slope, (below, above), prefactor, (lowest, highest))
