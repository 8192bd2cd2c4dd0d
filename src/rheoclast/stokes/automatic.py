"""The faster of the direct and the iterative solution."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import final

from rheoclast._checks import FloatArray
from rheoclast.progress import Progress
from rheoclast.stokes.basis import MultipoleBasis
from rheoclast.stokes.dense import DenseCholesky
from rheoclast.stokes.iterative import BlockConjugateGradients
from rheoclast.stokes.mobility import Mobility
from rheoclast.stokes.solver import Solution, Solver

FEWEST_UNKNOWNS = (1_000, 3_000)
"""From which on the iterative solution is faster, for order 2 and for high orders."""


@final
@dataclass(frozen=True)
class Automatic(Solver):
    """Dense Cholesky for few unknowns, else block conjugate gradients.

    Parameters
    ----------
    iterative
        The iterative solver, with its tolerance.
    """

    iterative: BlockConjugateGradients = field(default_factory=BlockConjugateGradients)

    def solve(self, mobility: Mobility, velocities: FloatArray, progress: Progress | None = None) -> list[Solution]:
        """See the solver that is chosen."""
        return self._chosen(len(mobility.radii), mobility.basis).solve(mobility, velocities, progress)

    def memory(self, count: int, basis: MultipoleBasis) -> float:
        """See the solver that is chosen."""
        return self._chosen(count, basis).memory(count, basis)

    def _chosen(self, count: int, basis: MultipoleBasis) -> Solver:
        few = count * basis.size < FEWEST_UNKNOWNS[basis.order > 2]
        return DenseCholesky() if few else self.iterative
