"""Stokesian dynamics of touching spheres at any multipole order, without lubrication.

Rigid motion has no lubrication singularity, so the far-field hierarchy alone converges to the exact solution. Order 2
is the force-torque-stresslet level of Durlofsky, Brady & Bossis, J. Fluid Mech. 180 (1987) 21.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import final

from rheoclast._checks import FloatArray
from rheoclast.hydrodynamics.model import HydrodynamicModel
from rheoclast.stokes.basis import MultipoleBasis
from rheoclast.stokes.mobility import Mobility, Progress
from rheoclast.stokes.solvers import DenseCholesky, Solver


@final
@dataclass(frozen=True)
class StokesianDynamics(HydrodynamicModel):
    """Multipole hydrodynamics of rigid spheres.

    Parameters
    ----------
    order
        Multipole order p ≥ 1: 1 keeps forces, 2 adds torques and stresslets, higher orders converge to the exact
        solution of the Stokes equations.
    solver
        How the linear system is solved.
    """

    order: int = 2
    solver: Solver = field(default_factory=DenseCholesky)

    def __post_init__(self) -> None:
        MultipoleBasis(self.order)

    def elementary_loads(
        self, centers: FloatArray, radii: FloatArray, progress: Progress | None = None
    ) -> list[FloatArray]:
        """See `HydrodynamicModel.elementary_loads`."""
        mobility = Mobility(centers, radii, MultipoleBasis(self.order))
        tractions = self.solver.solve(mobility, mobility.ambient_velocities(), progress)
        return [mobility.moments(each) for each in tractions]

    def memory(self, count: int) -> float:
        """Memory in bytes that the solution for `count` spheres takes at most."""
        return self.solver.memory(count, MultipoleBasis(self.order))
