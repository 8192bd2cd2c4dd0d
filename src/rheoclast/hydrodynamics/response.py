"""Response of a rigid aggregate to any linear flow: eleven elementary problems, solved once."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.errors import GeometryError
from rheoclast.flows import LinearFlow
from rheoclast.hydrodynamics import free_body
from rheoclast.hydrodynamics.model import HydrodynamicModel
from rheoclast.hydrodynamics.motion import RigidMotion, Settling
from rheoclast.loads import SphereLoads
from rheoclast.particles.spheres import Spheres
from rheoclast.progress import Progress
from rheoclast.scales import Scales, warn_of_radii, warn_of_viscosity
from rheoclast.stokes.solver import Convergence
from rheoclast.vectors import LEVI_CIVITA, STRAIN_BASIS, cross_matrix, strain_components

ROUNDING = 1e-12
SAME_PLACE = 1e-9  # units of length
DIMENSIONLESS_VISCOSITY = 1.0


def rigid_response(
    spheres: Spheres, model: HydrodynamicModel, viscosity: float, progress: Progress | None = None
) -> RigidResponse:
    """Solve the eleven elementary problems of a rigid aggregate: the expensive step, done once per geometry.

    Parameters
    ----------
    spheres
        The spheres, which move as one rigid body. Contacts play no role.
    model
        `StokesianDynamics(order)` or another hydrodynamic model.
    viscosity
        Of the liquid, in Pa s. With viscosity 1 the work is taken as dimensionless and large radii give no warning.
    progress
        Called as progress(step, fraction) during long solves.

    Raises
    ------
    ValueError
        If the viscosity is not positive.
    GeometryError
        If the spheres overlap so much that the problem has no solution.

    Warns
    -----
    UnitWarning
        If radii exceed 1 mm or are below 0.1 nm, or the viscosity exceeds 1000 Pa s.
    """
    _checks.instance("spheres", spheres, Spheres)
    _checks.instance("model", model, HydrodynamicModel)
    viscosity = _checks.positive("viscosity", viscosity)
    if viscosity != DIMENSIONLESS_VISCOSITY:
        warn_of_radii(spheres.radii)
        warn_of_viscosity(viscosity)
    scales = Scales(spheres.mean_radius, viscosity)
    centers = (spheres.centers - spheres.center_of_mass) / scales.length
    response = None
    for each in model.elementary_loads(centers, spheres.radii / scales.length, progress):
        loads = _checks.frozen(each.loads)
        response = RigidResponse(spheres, model, scales, loads, each.order, each.convergence, response)
    assert response is not None
    return response


@dataclass(frozen=True, eq=False)
class RigidResponse:
    """The linear response of one rigid geometry to flows and forces. Made by `rigid_response`.

    Attributes
    ----------
    spheres, model
        What was solved, and how.
    scales
        Units of length and viscosity.
    elementary_loads
        (N, 11, 11) dimensionless loads on every sphere, see `HydrodynamicModel.elementary_loads`.
    order
        Multipole order of the loads; None if the model has none.
    convergence
        Iterations, residual and time of the linear solution; None for models without one.
    coarser
        The response at the next lower order; None for order 1 and for models without order.
    """

    spheres: Spheres
    model: HydrodynamicModel
    scales: Scales
    elementary_loads: FloatArray
    order: int | None = None
    convergence: Convergence | None = None
    coarser: RigidResponse | None = None

    @property
    def by_order(self) -> tuple[RigidResponse, ...]:
        """The responses at all orders that were solved, the lowest first and this one last."""
        return (*(self.coarser.by_order if self.coarser else ()), self)

    @property
    def viscosity(self) -> float:
        """Viscosity of the liquid in Pa s."""
        return self.scales.viscosity

    @property
    def center(self) -> FloatArray:
        """Centre of mass (3,) in m, the reference point of motion, resistance and mobility."""
        return self.spheres.center_of_mass

    @_checks.instances
    def motion(self, flow: LinearFlow) -> RigidMotion:
        """Motion of the freely suspended aggregate: no total force, no total torque."""
        velocity = flow.velocity(self.center) + np.einsum("ijk,jk->i", self.translation_coupling, flow.strain_rate)
        angular_velocity = flow.angular_velocity + np.einsum("ijk,jk->i", self.rotation_coupling, flow.strain_rate)
        return RigidMotion(velocity, angular_velocity, self.center)

    @_checks.instances
    def loads(self, flow: LinearFlow) -> SphereLoads:
        """Loads of the fluid on every sphere of the freely suspended aggregate. They depend on the strain rate only."""
        components, unit = strain_components(flow.strain_rate), self.strain_loads
        rounding = unit.rounding * float(np.abs(components).max())
        return SphereLoads(np.tensordot(components, unit.force, 1), np.tensordot(components, unit.torque, 1), rounding)

    @_checks.instances
    def held(self, flow: LinearFlow) -> SphereLoads:
        """Loads of the fluid on every sphere of the aggregate held at rest where it is."""
        stream = flow.velocity(self.center) / self.scales.length
        ambient = np.concatenate([stream, flow.angular_velocity, strain_components(flow.strain_rate)])
        return self._dimensional(self.elementary_loads @ ambient)

    def settling(self, force: ArrayLike) -> Settling:
        """Motion under a force (3,) in N that acts at the centre of mass, without torque, in fluid at rest."""
        pull = _checks.real_array("force", force, (3,))
        motion = self.mobility[:, :3] @ pull
        velocity, angular_velocity = motion[:3], motion[3:]
        relative = -np.concatenate([velocity / self.scales.length, angular_velocity])
        loads = self._dimensional(self.elementary_loads[:, :, :6] @ relative)
        share = self.spheres.volumes / self.spheres.volumes.sum()
        rounding = ROUNDING * float(np.abs(pull).max())
        net_loads = SphereLoads(loads.force + share[:, None] * pull, loads.torque, rounding)
        return Settling(velocity, angular_velocity, self.center, loads, net_loads)

    @cached_property
    def strain_loads(self) -> SphereLoads:
        """Loads (5, N, 3) on the free aggregate's spheres in unit strain rates `STRAIN_BASIS`, in N s and N m s."""
        loads = free_body.free_loads(self._centers, self.elementary_loads)
        size = float(np.abs(self.elementary_loads[:, :3, 6:]).max())
        return self._dimensional(loads.transpose(2, 0, 1), ROUNDING * size)

    @property
    def table(self) -> FloatArray:
        """Force and torque on every sphere per strain component, (N, 6, 5), in N s and N m s."""
        return np.concatenate([self.strain_loads.force, self.strain_loads.torque], axis=-1).transpose(1, 2, 0)

    @cached_property
    def grand_resistance(self) -> FloatArray:
        """Force, torque and stresslet on the held aggregate in the elementary flows about `center`, (11, 11), SI.

        Symmetric and positive definite. Velocities in m/s, rotations and strains in 1/s.
        """
        units = np.outer(self._units, self._units) * self.viscosity * self.scales.length
        return _checks.frozen(self._total_resistance * units)

    @property
    def resistance(self) -> FloatArray:
        """Resistance (6, 6): force and torque that move the aggregate with unit velocity and angular velocity."""
        return self.grand_resistance[:6, :6]

    @cached_property
    def mobility(self) -> FloatArray:
        """Mobility (6, 6): velocity and angular velocity of `center` per unit force and torque there.

        At order 1 a sphere has no resistance to rotation; what then turns freely has zero mobility here.
        """
        units = np.outer(self._units[:6], self._units[:6]) * self.viscosity * self.scales.length
        return _checks.frozen(self._mobility / units)

    @cached_property
    def translation_coupling(self) -> FloatArray:
        """Tensor C (3, 3, 3) in m: velocity of `center` minus that of the flow there = C : E."""
        return _checks.frozen(self.scales.length * np.einsum("ik,kab->iab", self._strain_motion[:3], STRAIN_BASIS))

    @cached_property
    def rotation_coupling(self) -> FloatArray:
        """Tensor C (3, 3, 3): angular velocity minus that of the fluid = C : E.

        For a body of revolution about p this is Jeffery's B p × (E·p) with Bretherton's constant B.
        """
        return _checks.frozen(np.einsum("ik,kab->iab", self._strain_motion[3:], STRAIN_BASIS))

    @property
    def center_of_mobility(self) -> FloatArray:
        """Point (3,) in m where force does not turn the aggregate more one way than the other: M_ωU is symmetric there.

        The mean translational mobility is smallest at this point.
        """
        return self.center + self.scales.length * self._offset_to_center_of_mobility

    @property
    def hydrodynamic_radius(self) -> float:
        """Radius in m of the sphere with the same mean translational mobility, at the centre of mobility."""
        offset = cross_matrix(self._offset_to_center_of_mobility)
        at_center = self._mobility
        shift = np.hstack([np.eye(3), -offset])
        translation = shift @ at_center @ shift.T
        return self.scales.length * 3 / (6 * np.pi * float(np.trace(translation)))

    @property
    def intrinsic_viscosity(self) -> float:
        """Intrinsic viscosity per volume of the spheres, free of torque, averaged over orientations; 5/2 for one."""
        total = self._total_resistance
        free_stresslet = total[6:, 6:] - total[6:, :6] @ self._strain_motion
        volume = float(self.spheres.volumes.sum()) / self.scales.length**3
        return float(np.trace(free_stresslet)) / (10 * volume)

    @cached_property
    def _centers(self) -> FloatArray:
        """Centres (N, 3) of the spheres from `center`, in units of length."""
        return (self.spheres.centers - self.center) / self.scales.length

    @cached_property
    def _total_resistance(self) -> FloatArray:
        return free_body.total_resistance(self._centers, self.elementary_loads)

    @cached_property
    def _mobility(self) -> FloatArray:
        return free_body.mobility(self._total_resistance)

    @cached_property
    def _strain_motion(self) -> FloatArray:
        return free_body.strain_motion(self._total_resistance)

    @cached_property
    def _offset_to_center_of_mobility(self) -> FloatArray:
        """From `center`, (3,): solves (tr M_ωω 1 − M_ωω)·p = axial vector of the skew part of M_ωU."""
        turning, mixed = self._mobility[3:, 3:], self._mobility[3:, :3]
        axial = np.einsum("ijk,jk->i", LEVI_CIVITA, mixed)
        return np.linalg.pinv(np.trace(turning) * np.eye(3) - turning, rcond=free_body.SINGULAR, hermitian=True) @ axial

    @property
    def _units(self) -> FloatArray:
        """Length (11,) that each elementary flow's velocity on the aggregate is proportional to."""
        return np.array([1.0] * 3 + [self.scales.length] * 8)

    def _dimensional(self, loads: FloatArray, rounding: float = 0.0) -> SphereLoads:
        """SI loads from dimensionless force and torque (..., N, 6 or more)."""
        force, torque = self.scales.force * loads[..., :3], self.scales.torque * loads[..., 3:6]
        return SphereLoads(force, torque, self.scales.force * rounding)


def refuse_other_spheres(spheres: Spheres, response: RigidResponse) -> None:
    """Refuse a response that belongs to other spheres.

    Raises
    ------
    GeometryError
        With the number of spheres, and what to do.
    """
    theirs, tolerance = response.spheres, SAME_PLACE * response.scales.length
    if len(spheres) != len(theirs) or not all(
        np.allclose(a, b, rtol=0, atol=tolerance)
        for a, b in ((spheres.centers, theirs.centers), (spheres.radii, theirs.radii))
    ):
        raise GeometryError(
            f"the response was solved for other spheres ({len(theirs)}) than those of the aggregate "
            f"({len(spheres)}); solve rigid_response(aggregate.spheres, ...) first"
        )
