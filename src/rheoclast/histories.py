"""Histories of the velocity gradient Γ(t) along the path of a fluid particle."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.flows import LARGEST_RATE, TRACE_TOLERANCE, LinearFlow

ROUNDING_OF_TIME = 1e-12  # of the largest time: by so much an integrator may step past an end


@dataclass(frozen=True, eq=False, init=False)
class GradientHistory:
    """Velocity gradient of an incompressible flow along a path, straight lines between the instants.

    Parameters
    ----------
    times
        Instants (T,) in s, T ≥ 2, strictly increasing, at any spacing.
    gradients
        Velocity gradient Γ (T, 3, 3) in 1/s at these instants, Γ[t, i, j] = ∂u_i/∂x_j.
    tolerance
        Largest trace, as a fraction of the largest entry of all gradients, that counts as an error of the data. It is
        taken away by subtracting a third of it from the diagonal. By default only rounding passes; interpolated
        velocity fields may need 0.01 to 0.1.

    Raises
    ------
    ValueError
        If a shape does not fit, an entry is not finite, times do not increase, or a trace exceeds the tolerance.
    """

    times: FloatArray
    gradients: FloatArray

    def __init__(self, times: ArrayLike, gradients: ArrayLike, tolerance: float = TRACE_TOLERANCE) -> None:
        instants = _increasing_times(times)
        given = _checks.real_array("gradients", gradients, (len(instants), 3, 3))
        size = float(np.abs(given).max())
        if size > LARGEST_RATE:
            raise ValueError(f"gradients: expected rates up to {LARGEST_RATE:g} 1/s, got {size:.3g}; check the unit")
        _refuse_traces(given, _checks.not_negative("tolerance", tolerance), size)
        _checks.set_fields(self, times=instants, gradients=_checks.frozen(traceless(given)))

    def __len__(self) -> int:
        """Number of instants."""
        return len(self.times)

    @property
    def duration(self) -> float:
        """Time from the first instant to the last, s."""
        return float(self.times[-1] - self.times[0])

    def gradient(self, times: ArrayLike) -> FloatArray:
        """Velocity gradient (..., 3, 3) in 1/s at times (...) in s.

        Raises
        ------
        ValueError
            If a time lies before the first instant or after the last.
        """
        wanted = self._within(times)
        right = np.clip(np.searchsorted(self.times, wanted, side="right"), 1, len(self) - 1)
        start, end = self.times[right - 1], self.times[right]
        share = np.clip((wanted - start) / (end - start), 0, 1)[..., None, None]
        return (1 - share) * self.gradients[right - 1] + share * self.gradients[right]

    def strain_rate(self, times: ArrayLike) -> FloatArray:
        """Strain rate E = (Γ + Γᵀ)/2, (..., 3, 3) in 1/s, at times (...) in s; errors as in `gradient`."""
        gradient = self.gradient(times)
        return 0.5 * (gradient + np.swapaxes(gradient, -1, -2))

    def magnitude(self, times: ArrayLike) -> FloatArray:
        """sqrt(2 E:E), (...) in 1/s, at times (...) in s, as `LinearFlow.magnitude`; errors as in `gradient`."""
        return np.sqrt(2 * np.sum(self.strain_rate(times) ** 2, axis=(-1, -2)))

    def flow(self, time: float) -> LinearFlow:
        """The linear flow at one time in s; errors as in `gradient`."""
        return LinearFlow(traceless(self.gradient(float(_checks.real_array("time", time, ())))))

    def dissipation(self, kinematic_viscosity: float) -> float:
        """Mean dissipation of energy 2 ν E:E per mass over the history, m²/s³, for a kinematic viscosity ν in m²/s.

        Every instant counts by half the time between its two neighbours (the trapezoidal rule).
        """
        viscosity = _checks.positive("kinematic_viscosity", kinematic_viscosity)
        squares = self.magnitude(self.times) ** 2
        return viscosity * float(np.diff(self.times) @ (squares[1:] + squares[:-1])) / (2 * self.duration)

    def scaled(self, factor: float) -> GradientHistory:
        """The same path run through `factor` > 0 times as fast: gradients times the factor, times divided by it."""
        factor = _checks.positive("factor", factor)
        return GradientHistory(self.times / factor, factor * self.gradients)

    def _within(self, times: ArrayLike) -> FloatArray:
        """Times as an array, none of them outside the history."""
        wanted: Any = np.asarray(times, dtype=np.float64)
        first, last = self.times[[0, -1]]
        slack = ROUNDING_OF_TIME * max(abs(first), abs(last))
        outside = wanted[~((wanted >= first - slack) & (wanted <= last + slack))]
        if outside.size:
            raise ValueError(
                f"times: expected times from {first:g} to {last:g} s, which the history spans, got {outside[0]:g} s"
            )
        return wanted


def traceless(gradients: FloatArray) -> FloatArray:
    """The deviators (..., 3, 3) of matrices (..., 3, 3): a third of the trace is taken from the diagonal."""
    return gradients - np.trace(gradients, axis1=-2, axis2=-1)[..., None, None] / 3 * np.eye(3)


def _increasing_times(value: Any) -> FloatArray:
    times = _checks.real_array("times", value, ("T",))
    if len(times) < 2:
        raise ValueError(f"times: expected at least two instants, got {len(times)}")
    bad = np.flatnonzero(np.diff(times) <= 0)
    if len(bad):
        k = int(bad[0])
        raise ValueError(
            f"times[{k + 1}]: expected a time after {times[k]:.12g} s, the instant before, got "
            f"{times[k + 1]:.12g} s; sort the instants and leave out repeated ones"
        )
    return times


def _refuse_traces(gradients: FloatArray, tolerance: float, size: float) -> None:
    traces = np.abs(np.trace(gradients, axis1=1, axis2=2))
    worst = int(np.argmax(traces))
    if traces[worst] > tolerance * size:
        raise ValueError(
            f"gradients[{worst}]: expected zero trace (an incompressible flow), got {traces[worst]:.3g} 1/s, "
            f"{traces[worst] / size:.2g} of the largest entry; check the order of the nine values, or pass a "
            "tolerance above this fraction to have the trace taken away as an error of the data"
        )
