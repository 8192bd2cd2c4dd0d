"""The exponential law of breakage in turbulence, for codes that need a rate as a formula.

k = (4/(15 π))^½ (ε/ν)^½ exp(−ε_c/ε), with ε the mean dissipation of energy per mass, ν the kinematic viscosity of the
liquid and ε_c a critical dissipation: K. A. Kusters, The influence of turbulence on aggregation of small particles in
agitated vessels, PhD thesis, Eindhoven University of Technology, 1991.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.fits import CONFIDENCE, student_quantile

PREFACTOR = np.sqrt(4 / (15 * np.pi))


@dataclass(frozen=True)
class CriticalDissipation:
    """Critical dissipation ε_c in m²/s³ and the bounds of its confidence interval."""

    value: float
    interval: tuple[float, float]


def turbulent_breakage_rate(
    dissipation: ArrayLike, kinematic_viscosity: float, critical_dissipation: float
) -> FloatArray:
    """Rate of breakage (...) in 1/s by Kusters' law.

    Parameters
    ----------
    dissipation
        Mean dissipation (...) of energy per mass ε, m²/s³.
    kinematic_viscosity
        ν, m²/s (water: 1e-6).
    critical_dissipation
        ε_c, m²/s³, from `critical_dissipation` or `fitted_critical_dissipation`.

    Raises
    ------
    ValueError
        If a number is not positive.
    """
    mean = _checks.positive_array("dissipation", dissipation, np.shape(dissipation))
    critical = _checks.positive("critical_dissipation", critical_dissipation)
    return _highest_rate(mean, kinematic_viscosity) * np.exp(-critical / mean)


def critical_dissipation(magnitude: float, kinematic_viscosity: float) -> float:
    """Dissipation ν γ² in m²/s³ of a flow whose strain rate has the magnitude γ = (2 E:E)^½ at which aggregates break.

    It is exactly the dissipation 2 ν E:E of that flow itself. In isotropic turbulence of this mean dissipation the root
    mean square of the magnitude is γ.

    Parameters
    ----------
    magnitude
        γ in 1/s, the `LinearFlow.magnitude` at failure, for instance ``worst_initiation(...).flow.magnitude``. It is
        the shear rate of simple shear, √3 extension rates of uniaxial and 2 of planar extension.
    kinematic_viscosity
        ν, m²/s.

    Notes
    -----
    In Kusters' law it is an estimate, good to a factor: there ε_c also stands for how loads fluctuate and aggregates
    turn. `fitted_critical_dissipation` tells the one that describes given rates.

    Raises
    ------
    ValueError
        If a number is not positive.
    """
    return _checks.positive("kinematic_viscosity", kinematic_viscosity) * _checks.positive("magnitude", magnitude) ** 2


def fitted_critical_dissipation(
    dissipations: ArrayLike, rates: ArrayLike, kinematic_viscosity: float, *, confidence: float = CONFIDENCE
) -> CriticalDissipation:
    """The critical dissipation by which Kusters' law describes rates of breakage best.

    By least squares of the logarithm of the rate, which is −ε_c/ε plus what is known; the interval is Student's, for
    independent rates that scatter by a factor of the same distribution everywhere.

    Parameters
    ----------
    dissipations
        Mean dissipations ε (n,), m²/s³, n ≥ 2.
    rates
        Rates of breakage (n,), 1/s, positive.
    kinematic_viscosity
        ν, m²/s.
    confidence
        Of the interval.

    Raises
    ------
    ValueError
        If there are fewer than two rates, a number is not positive, or the rates exceed what the law allows.
    """
    mean = _checks.positive_array("dissipations", dissipations, ("n",))
    measured = _checks.positive_array("rates", rates, (len(mean),))
    freedoms = len(mean) - 1
    if freedoms < 1:
        raise ValueError(f"dissipations: expected at least 2, got {len(mean)}; measure at more dissipations")
    inverse = 1 / mean
    shortfall = np.log(_highest_rate(mean, kinematic_viscosity) / measured)
    spread = float(inverse @ inverse)
    value = float(inverse @ shortfall) / spread
    if value <= 0:
        raise ValueError(
            "rates: expected them below (4/(15 π))^½ (ε/ν)^½ on the whole, as the law has it for any critical "
            f"dissipation, got up to {np.exp(-shortfall).max():.3g} times that; fit a power law instead"
        )
    residual = shortfall - value * inverse
    reach = student_quantile(confidence, freedoms) * float(np.sqrt(residual @ residual / freedoms / spread))
    return CriticalDissipation(value, (value - reach, value + reach))


def _highest_rate(dissipation: FloatArray, kinematic_viscosity: float) -> FloatArray:
    """What the rate tends to where the dissipation is far above the critical one."""
    return PREFACTOR * np.sqrt(dissipation / _checks.positive("kinematic_viscosity", kinematic_viscosity))
