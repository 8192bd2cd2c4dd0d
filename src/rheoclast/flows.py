"""Linear flows u(x) = Γ·x, measured from the origin of coordinates."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.vectors import LEVI_CIVITA

TRACE_TOLERANCE = 1e-9
ROUNDING = 1e-14
LARGEST_RATE = 1e100  # 1/s; beyond it products overflow


@dataclass(frozen=True, eq=False, init=False)
class LinearFlow:
    """Undisturbed incompressible linear flow u(x) = Γ·x.

    Parameters
    ----------
    gradient
        Velocity gradient Γ (3, 3) in 1/s, Γ[i, j] = ∂u_i/∂x_j, with zero trace.
    rate
        The rate by which the flow is quoted, 1/s: the shear rate of a simple shear, the extension rate of an
        extension. Defaults to the magnitude sqrt(2 E:E), which is the shear rate in simple shear. To change the speed
        of a flow use `scaled`, which keeps gradient and rate together.

    Raises
    ------
    ValueError
        If the gradient has another shape, is not finite, or has a trace.
    """

    gradient: FloatArray
    rate: float

    def __init__(self, gradient: ArrayLike, rate: float | None = None) -> None:
        matrix = _checks.real_array("gradient", gradient, (3, 3))
        trace, size = float(np.trace(matrix)), float(np.abs(matrix).max())
        if abs(trace) > TRACE_TOLERANCE * size:
            raise ValueError(
                f"gradient: expected zero trace (an incompressible flow), got {trace:g}; "
                f"subtract trace/3 = {trace / 3:g} from the diagonal if it is rounding"
            )
        if size > LARGEST_RATE:
            raise ValueError(f"gradient: expected rates up to {LARGEST_RATE:g} 1/s, got {size:.3g}; check the unit")
        _checks.set_fields(self, gradient=matrix)
        quoted = self.magnitude if rate is None else _checks.not_negative("rate", rate)
        if quoted == 0 < self.magnitude:
            raise ValueError(f"rate: expected a positive number for a flow of magnitude {self.magnitude:.3g}, got 0")
        _checks.set_fields(self, rate=quoted)

    @cached_property
    def strain_rate(self) -> FloatArray:
        """Strain rate E = (Γ + Γᵀ)/2, (3, 3), in 1/s."""
        strain_rate = 0.5 * (self.gradient + self.gradient.T)
        if np.abs(strain_rate).max() <= ROUNDING * np.abs(self.gradient).max():
            strain_rate = np.zeros((3, 3))  # a rotation, and rounding
        return _checks.frozen(strain_rate)

    @cached_property
    def angular_velocity(self) -> FloatArray:
        """Angular velocity of the fluid ω = ½ curl u, (3,), in rad/s."""
        return _checks.frozen(-0.5 * np.einsum("ijk,jk->i", LEVI_CIVITA, self.gradient))

    @cached_property
    def principal_rates(self) -> FloatArray:
        """Eigenvalues e1 ≥ e2 ≥ e3 of the strain rate, (3,), in 1/s."""
        return _checks.frozen(np.linalg.eigvalsh(self.strain_rate)[::-1])

    @property
    def magnitude(self) -> float:
        """sqrt(2 E:E) in 1/s, the dissipation rate over viscosity being its square."""
        return float(np.sqrt(2 * np.sum(self.strain_rate**2)))

    def velocity(self, points: ArrayLike) -> FloatArray:
        """Velocity (..., 3) in m/s at points (..., 3) in m."""
        return np.asarray(points, dtype=np.float64) @ self.gradient.T

    def rotated(self, rotation: Any) -> LinearFlow:
        """The flow turned by a rotation R, a (3, 3) matrix or a SciPy `Rotation`: gradient R Γ Rᵀ.

        Turning the flow by R is the same as turning the aggregate by Rᵀ.
        """
        matrix = _checks.rotation_matrix("rotation", rotation)
        return LinearFlow(matrix @ self.gradient @ matrix.T, self.rate)

    def scaled(self, factor: float) -> LinearFlow:
        """The same flow, `factor` ≥ 0 times as fast."""
        factor = _checks.not_negative("factor", factor)
        return LinearFlow(factor * self.gradient, factor * self.rate)


def simple_shear(rate: float) -> LinearFlow:
    """Simple shear u = (rate·y, 0, 0); `rate` in 1/s."""
    rate = _checks.not_negative("rate", rate)
    return LinearFlow(rate * np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]), rate)


def uniaxial_extension(rate: float) -> LinearFlow:
    """Uniaxial extension along z, u = rate·(−x/2, −y/2, z); `rate` in 1/s."""
    rate = _checks.not_negative("rate", rate)
    return LinearFlow(rate * np.diag([-0.5, -0.5, 1.0]), rate)


def biaxial_extension(rate: float) -> LinearFlow:
    """Biaxial extension in the xy plane, u = rate·(x, y, −2z); `rate` in 1/s."""
    rate = _checks.not_negative("rate", rate)
    return LinearFlow(rate * np.diag([1.0, 1.0, -2.0]), rate)


def planar_extension(rate: float) -> LinearFlow:
    """Planar extension, u = rate·(x, −y, 0); `rate` in 1/s."""
    rate = _checks.not_negative("rate", rate)
    return LinearFlow(rate * np.diag([1.0, -1.0, 0.0]), rate)
