"""Orientation of a freely suspended rigid aggregate in the course of time.

Without inertia, force and torque the aggregate turns with the angular velocity Ω = ω + R·[C : (Rᵀ E R)]. Here ω and E
are angular velocity and strain rate of the undisturbed flow, R takes body axes to lab axes, and C is
`RigidResponse.rotation_coupling`: F. P. Bretherton, J. Fluid Mech. 14 (1962) 284. Body axes are those in which the
coordinates of the spheres are given. A body of revolution moves as in G. B. Jeffery, Proc. R. Soc. Lond. A 102 (1922)
161.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.flows import LinearFlow
from rheoclast.histories import traceless
from rheoclast.hydrodynamics.response import RigidResponse
from rheoclast.vectors import LEVI_CIVITA, strain_components

if TYPE_CHECKING:
    from scipy.interpolate import PPoly

TOLERANCES = (1e-13, 1e-2)
LARGEST_STRAIN = 1e6
LINEARITY = 1e-6  # of the largest gradient; times far from zero round the place between two samples
SPAN_ROUNDING = 1e-9  # of the duration


@runtime_checkable
class Gradients(Protocol):
    """A velocity gradient that changes in time, linearly between samples."""

    @property
    def times(self) -> FloatArray:
        """Times (T,) of the samples in s, increasing."""

    def gradient(self, times: FloatArray, /) -> FloatArray:
        """Velocity gradients (..., 3, 3) in 1/s at times (...) in s, linear between `times`."""


@dataclass(frozen=True, eq=False)
class Trajectory:
    """Orientation of a free aggregate at all times of a span. Made by `trajectory`.

    Everything is a function of time: of one, or of an array of any shape, and then for all its times at once. Times
    outside the span are refused.

    Attributes
    ----------
    times
        (T,) in s: the start, and the ends of the integrator's steps.
    coefficients
        (8, T − 1, 4) of the quaternion within each step, in powers 7 … 0 of the fraction of the step that has passed.
    undisturbed
        The flow in lab axes.
    coupling
        Tensor C (3, 3, 3) in body axes, `RigidResponse.rotation_coupling`.
    """

    times: FloatArray
    coefficients: FloatArray
    undisturbed: LinearFlow | Gradients
    coupling: FloatArray

    @property
    def duration(self) -> float:
        """Length of the span in s."""
        return float(self.times[-1] - self.times[0])

    def quaternions(self, times: ArrayLike) -> FloatArray:
        """Unit quaternions (..., 4) of `rotation`, in SciPy's order (x, y, z, w), continuous in time."""
        steps = np.interp(self._within(times), self.times, np.arange(len(self.times)))
        quaternions = self._interpolant(steps)
        return quaternions / np.linalg.norm(quaternions, axis=-1, keepdims=True)

    def rotation(self, times: ArrayLike) -> FloatArray:
        """Rotations R (..., 3, 3) from body to lab axes: a vector v fixed in the aggregate is R·v in the lab."""
        quaternions = self.quaternions(times)
        matrices = Rotation.from_quat(quaternions.reshape(-1, 4)).as_matrix()
        return matrices.reshape(*quaternions.shape[:-1], 3, 3)

    def gradient(self, times: ArrayLike) -> FloatArray:
        """Velocity gradients Rᵀ Γ R (..., 3, 3) of the undisturbed flow in body axes, in 1/s."""
        rotation = self.rotation(times)
        return np.swapaxes(rotation, -1, -2) @ _gradients(self.undisturbed, self._within(times)) @ rotation

    def strain_rate(self, times: ArrayLike) -> FloatArray:
        """Strain rates Rᵀ E R (..., 3, 3) of the undisturbed flow in body axes, in 1/s."""
        gradient = self.gradient(times)
        return 0.5 * (gradient + np.swapaxes(gradient, -1, -2))

    def strain_components(self, times: ArrayLike) -> FloatArray:
        """Components (..., 5) of `strain_rate` on `rheoclast.vectors.STRAIN_BASIS`, in 1/s."""
        return strain_components(self.gradient(times))

    def angular_velocity(self, times: ArrayLike) -> FloatArray:
        """Angular velocities (..., 3) of the aggregate in lab axes, in rad/s."""
        in_body = np.tensordot(self.gradient(times), _turning(self.coupling), axes=((-2, -1), (1, 2)))
        return (self.rotation(times) @ in_body[..., None])[..., 0]

    def flow(self, time: float) -> LinearFlow:
        """The flow at one time as seen from the aggregate, for everything that takes a flow in body axes.

        A steady flow keeps the rate by which it is quoted; a changing one is quoted by its magnitude. The trace that
        rounding leaves where gradients nearly cancel between samples is taken away.
        """
        backwards = self.rotation(_checks.real_array("time", time, ())).T
        if isinstance(self.undisturbed, LinearFlow):
            return self.undisturbed.rotated(backwards)
        return LinearFlow(traceless(_gradients(self.undisturbed, self._within(time)))).rotated(backwards)

    @cached_property
    def _interpolant(self) -> PPoly:
        """The quaternion as a function of the number of steps passed."""
        from scipy.interpolate import PPoly

        return PPoly(self.coefficients, np.arange(len(self.times), dtype=np.float64), extrapolate=True)

    def _within(self, times: ArrayLike) -> FloatArray:
        """The times as an array, moved into the span where rounding put them outside."""
        given = np.asarray(times)
        checked = _checks.real_array("times", given, given.shape)
        start, end = self.times[[0, -1]]
        outside = np.abs(checked - np.clip(checked, start, end)) > SPAN_ROUNDING * self.duration
        if outside.any():
            raise ValueError(f"times: expected {start:g} s to {end:g} s, got {checked[outside][0]:g} s")
        return np.clip(checked, start, end)


def trajectory(
    response: RigidResponse,
    flow: LinearFlow | Gradients,
    duration: float | None = None,
    start: Any = None,
    tolerance: float = 1e-8,
) -> Trajectory:
    """Orientation of a freely suspended aggregate in a flow, from an initial one on.

    Parameters
    ----------
    response
        Hydrodynamic response of the aggregate; only its `rotation_coupling` is used.
    flow
        A steady `LinearFlow`, or a velocity gradient that changes in time as in `Gradients`: one that moves with the
        aggregate.
    duration
        In s, positive. A steady flow starts at time 0 and needs a duration; a changing one starts at its first sample
        and by default lasts to its last.
    start
        Rotation from body to lab axes at the start, a (3, 3) matrix or a SciPy `Rotation`. Default: none.
    tolerance
        Error of the unit quaternion in one step, the root mean square of its components, between 1e-13 and 0.01. The
        error of the orientation grows from step to step, and falls about in proportion to the tolerance.

    Raises
    ------
    TypeError
        If response or flow are something else.
    ValueError
        If the duration is not positive or exceeds the samples, the tolerance is out of its range, the gradients have a
        trace or are not linear between the samples, or their magnitude times the duration exceeds a million.
    """
    _checks.instance("response", response, RigidResponse, "make one with rigid_response(spheres, model, viscosity)")
    tolerance = _checks.positive("tolerance", tolerance)
    if not TOLERANCES[0] <= tolerance <= TOLERANCES[1]:
        raise ValueError(f"tolerance: expected {TOLERANCES[0]:g} to {TOLERANCES[1]:g}, got {tolerance:g}")
    initial = np.eye(3) if start is None else _checks.rotation_matrix("start", start)
    knots = _knots(flow, duration)
    span = knots[-1] - knots[0]
    fractions, strains = (knots - knots[0]) / span, span * _samples(flow, knots)
    _check_strain(fractions, strains)

    from rheoclast.hydrodynamics.turning_kernel import integrate

    coupling = response.rotation_coupling
    passed, coefficients = integrate(fractions, strains, _turning(coupling), _quaternion(initial), tolerance)
    times = np.append(knots[0] + span * passed, knots[-1])
    by_power = np.ascontiguousarray(coefficients.transpose(1, 0, 2))
    return Trajectory(_checks.frozen(times), _checks.frozen(by_power), flow, coupling)


def _quaternion(rotation: FloatArray) -> FloatArray:
    """Quaternion (4,) of a rotation matrix, in SciPy's order."""
    return Rotation.from_matrix(rotation.copy()).as_quat()  # older SciPy refuses arrays that are read-only


def _turning(coupling: FloatArray) -> FloatArray:
    """Tensor K (3, 3, 3) with angular velocity = K : gradient in body axes: half the vorticity, and the coupling."""
    return coupling - 0.5 * LEVI_CIVITA


def _gradients(flow: LinearFlow | Gradients, times: FloatArray) -> FloatArray:
    """Velocity gradients (..., 3, 3) in lab axes at times (...)."""
    if isinstance(flow, LinearFlow):
        return np.broadcast_to(flow.gradient, (*times.shape, 3, 3))
    return _checks.real_array("gradient", flow.gradient(times), (*times.shape, 3, 3))


def _knots(flow: LinearFlow | Gradients, duration: float | None) -> FloatArray:
    """Start, samples in between, and end, in s."""
    length = None if duration is None else _checks.positive("duration", duration)
    if isinstance(flow, LinearFlow):
        if length is None:
            raise ValueError("duration: expected a number of seconds for a steady flow, got None; pass duration")
        return np.array([0.0, length])
    if not isinstance(flow, Gradients):
        raise TypeError(
            f"flow: expected LinearFlow or an object with times and gradient(times), got {type(flow).__name__}; "
            "for instance simple_shear(rate=1.0)"
        )
    times = _checks.real_array("times", flow.times, ("T",))
    if len(times) < 2 or not np.all(np.diff(times) > 0):
        raise ValueError("times: expected two samples or more at increasing times; sort them and drop repetitions")
    available = times[-1] - times[0]
    if length is not None and length > (1 + SPAN_ROUNDING) * available:
        raise ValueError(f"duration: expected at most {available:g} s, which the samples span, got {length:g} s")
    end = times[-1] if length is None else min(times[0] + length, times[-1])
    return np.append(times[times < end], end)


def _samples(flow: LinearFlow | Gradients, knots: FloatArray) -> FloatArray:
    """Velocity gradients (n, 3, 3) at the knots."""
    gradients = _gradients(flow, knots)
    traces = np.abs(np.trace(gradients, axis1=1, axis2=2))
    if traces.max() > LINEARITY * np.abs(gradients).max():
        worst = int(traces.argmax())
        raise ValueError(
            f"gradient: expected zero trace (an incompressible flow), got {traces[worst]:.3g} 1/s at "
            f"{knots[worst]:g} s; subtract a third of it from the diagonal if it is an error of the data"
        )
    between = _gradients(flow, 0.5 * (knots[:-1] + knots[1:]))
    bend = np.abs(between - 0.5 * (gradients[:-1] + gradients[1:])).max(axis=(1, 2))
    if bend.max() > LINEARITY * np.abs(gradients).max():
        worst = int(bend.argmax())
        raise ValueError(
            f"gradient: expected it linear between samples, got one that bends by {bend[worst]:.3g} 1/s between "
            f"{knots[worst]:g} s and {knots[worst + 1]:g} s; give more times"
        )
    return gradients


def _check_strain(fractions: FloatArray, strains: FloatArray) -> None:
    """Refuse a span whose steps would not fit into memory."""
    sizes = np.linalg.norm(strains, axis=(1, 2))
    passed = float(np.diff(fractions) @ (0.5 * (sizes[:-1] + sizes[1:])))
    if not passed <= LARGEST_STRAIN:
        raise ValueError(
            f"duration: expected the magnitude of the gradient times the duration to be at most {LARGEST_STRAIN:g}, "
            f"got {passed:.3g}; follow the aggregate for shorter"
        )
