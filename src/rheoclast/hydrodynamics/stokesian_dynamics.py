"""Stokesian dynamics of touching spheres at any multipole order, without lubrication.

Rigid motion has no lubrication singularity, so the far-field hierarchy alone converges to the exact solution. Order 2
is the force-torque-stresslet level of Durlofsky, Brady & Bossis, J. Fluid Mech. 180 (1987) 21.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal, final

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.hydrodynamics.free_body import free_loads
from rheoclast.hydrodynamics.model import Approximation, HydrodynamicModel
from rheoclast.hydrodynamics.truncation import expected_error
from rheoclast.progress import Progress
from rheoclast.stokes.automatic import Automatic
from rheoclast.stokes.basis import MultipoleBasis
from rheoclast.stokes.mobility import Mobility
from rheoclast.stokes.solver import Solver

LOWEST_AUTOMATIC_ORDER = 2
HIGHEST_AUTOMATIC_ORDER = 12


@final
@dataclass(frozen=True)
class StokesianDynamics(HydrodynamicModel):
    """Multipole hydrodynamics of rigid spheres.

    The hierarchy is exact for spheres that do not overlap. An overlap within the contact tolerance changes the loads by
    about its own size over the radius at low orders; at high orders, or for larger overlaps, the mobility may lose its
    positive definiteness, which is refused.

    Parameters
    ----------
    order
        Multipole order p ≥ 1: 1 keeps forces, 2 adds torques and stresslets, higher orders converge to the exact
        solution of the Stokes equations. "auto" takes the smallest, from 2 up, that reaches the accuracy.
    accuracy
        For order "auto": largest expected error of the forces on the spheres, as a share of their root mean square.
        Errors of contact tensions, as a share of the largest, mostly stay below it.
    solver
        How the linear system is solved.
    """

    order: int | Literal["auto"] = 2
    accuracy: float = 0.02
    solver: Solver = field(default_factory=Automatic)

    def __post_init__(self) -> None:
        if self.order != "auto":
            MultipoleBasis(self.order)
        _checks.positive("accuracy", self.accuracy)

    def elementary_loads(
        self, centers: FloatArray, radii: FloatArray, progress: Progress | None = None
    ) -> list[Approximation]:
        """See `HydrodynamicModel.elementary_loads`; all orders up to the one asked for.

        Raises
        ------
        MemoryError
            If the memory that is free does not suffice.
        GeometryError
            If the spheres overlap so much that the mobility is not positive definite.
        ArithmeticError
            If order "auto" does not reach its accuracy.
        """
        if self.order != "auto":
            return self._solve(self.order, centers, radii, progress)
        for order in range(LOWEST_AUTOMATIC_ORDER, HIGHEST_AUTOMATIC_ORDER + 1):
            found = self._solve(order, centers, radii, progress)
            forces = [free_loads(centers, each.loads)[:, :3] for each in found]
            error, size = float(expected_error(forces, order)), float((forces[-1] ** 2).sum() ** 0.5)
            if error <= self.accuracy * size:
                return found
        raise ArithmeticError(
            f"order='auto': accuracy {self.accuracy:g} is not met at order {order}, "
            f"which errs by {error / size:.2g}; give a larger number or the order"
        )

    def _solve(
        self, order: int, centers: FloatArray, radii: FloatArray, progress: Progress | None
    ) -> list[Approximation]:
        mobility = Mobility(centers, radii, MultipoleBasis(order))
        solutions = self.solver.solve(mobility, mobility.ambient_velocities(), progress)
        return [Approximation(mobility.moments(each.tractions), each.order, each.convergence) for each in solutions]

    def memory(self, count: int) -> float:
        """Memory in bytes that the solution for `count` spheres takes at most; for "auto" that of its first order."""
        order = LOWEST_AUTOMATIC_ORDER if self.order == "auto" else self.order
        return self.solver.memory(count, MultipoleBasis(order))
