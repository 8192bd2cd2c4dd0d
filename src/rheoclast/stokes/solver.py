"""The interface of every way to solve mobility · traction = velocity."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

from rheoclast._checks import FloatArray
from rheoclast.progress import Progress
from rheoclast.stokes.basis import MultipoleBasis
from rheoclast.stokes.mobility import Mobility

NOT_DEFINITE = (
    "the mobility of these spheres is not positive definite, as happens when spheres overlap; "
    "shrink the radii until they only touch"
)


@dataclass(frozen=True)
class Convergence:
    """How a solution went.

    Attributes
    ----------
    iterations
        Applications of the operator; zero for a direct solution.
    residual
        Largest residual of a right-hand side, over its norm, as the solver measures it.
    seconds
        Time spent.
    """

    iterations: int
    residual: float
    seconds: float


@dataclass(frozen=True, eq=False)
class Solution:
    """Tractions (N, M, K) of one multipole order, and how they were found."""

    tractions: FloatArray
    order: int
    convergence: Convergence


class Solver(ABC):
    """Solves for the tractions that give prescribed surface velocities."""

    @abstractmethod
    def solve(self, mobility: Mobility, velocities: FloatArray, progress: Progress | None = None) -> list[Solution]:
        """Solutions for velocities (N, M, K), at increasing multipole order.

        The last is the one asked for. Those before it have fewer modes and show how it converges.
        """

    @abstractmethod
    def memory(self, count: int, basis: MultipoleBasis) -> float:
        """Memory in bytes that the solution for `count` spheres takes at most."""


def refuse_beyond_memory(needed: float, count: int, order: int) -> None:
    """Refuse a problem that does not fit into the memory that is free.

    Raises
    ------
    MemoryError
        With what is needed, what is free, and what to do.
    """
    import psutil

    available = psutil.virtual_memory().available
    if needed > available:
        raise MemoryError(
            f"order {order} of {count} spheres needs {needed / 1e9:.3g} GB of memory, "
            f"{available / 1e9:.3g} GB are free; use a lower order or fewer spheres"
        )
