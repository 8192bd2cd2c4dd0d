"""The interface of every hydrodynamic model."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import NamedTuple

from rheoclast._checks import FloatArray
from rheoclast.progress import Progress
from rheoclast.stokes.solver import Convergence


class Approximation(NamedTuple):
    """Loads at one level of approximation.

    Attributes
    ----------
    loads
        (N, 11, 11). Row: three components of force, three of torque and five of stresslet (on `STRAIN_BASIS`), torque
        and stresslet about the centre of the sphere. Column: three unit streams, three unit rotations about the
        reference point and five unit strains in which the aggregate is held at rest.
    order
        Multipole order, if the model has one.
    convergence
        How the linear system was solved, if there is one.
    """

    loads: FloatArray
    order: int | None = None
    convergence: Convergence | None = None


class HydrodynamicModel(ABC):
    """Gives the loads on every sphere of a rigid aggregate, held fixed in each of the eleven elementary flows."""

    @abstractmethod
    def elementary_loads(
        self, centers: FloatArray, radii: FloatArray, progress: Progress | None = None
    ) -> list[Approximation]:
        """Force, torque and stresslet of the fluid on every sphere, dimensionless (viscosity one).

        Parameters
        ----------
        centers, radii
            (N, 3) and (N,), in mean radii, relative to the reference point of the aggregate.
        progress
            Called with the name of the step and the fraction done.

        Returns
        -------
        approximations
            One, or several of increasing multipole order, of which the last is the answer.
        """

    def memory(self, count: int) -> float:
        """Memory in bytes that the loads of `count` spheres take at most; zero where it does not matter."""
        return 0.0
