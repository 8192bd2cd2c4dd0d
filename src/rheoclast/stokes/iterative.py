"""Iterative solution: block conjugate gradients, preconditioned by a sparse inverse Cholesky factor."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING, final

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast._threads import one_blas_thread
from rheoclast.stokes.basis import MultipoleBasis
from rheoclast.stokes.conjugate_gradients import conjugate_gradients
from rheoclast.stokes.mobility import Mobility, Progress
from rheoclast.stokes.solver import Convergence, Solution, Solver

if TYPE_CHECKING:
    from rheoclast.stokes.block_sparse import BlockSparse
    from rheoclast.stokes.fast_mobility import FastMobility

REACH = 2.0
"""Length scales within which a sphere is conditioned on coarser ones."""
TOLERANCE_OF_LOWER_ORDER = 3e-3
"""The order below only serves the error bar."""
FAR_FIELD_SHARE = 10.0
"""Accuracy of the far field over the tolerance: it errs a tenth of its accuracy for the smooth flows that matter."""
COEFFICIENTS_OF_A_BOX = 450
"""In single precision, at the accuracy that the default tolerance asks for."""
UNKNOWNS_FOR_THREADED_ALGEBRA = 100_000


@final
@dataclass(frozen=True)
class BlockConjugateGradients(Solver):
    """All right-hand sides at once, without the matrix.

    Parameters
    ----------
    tolerance
        Largest residual of any right-hand side over its norm, both measured in the preconditioned space, where the
        operator is near the identity. Contact loads are then good to about the tolerance, as a share of the
        largest; moments in long straight chains to some forty times it (see `tests/agreement/test_iterative.py`).
    """

    tolerance: float = 1e-6

    def __post_init__(self) -> None:
        _checks.positive("tolerance", self.tolerance)

    def solve(self, mobility: Mobility, velocities: FloatArray, progress: Progress | None = None) -> list[Solution]:
        """Solutions of the order asked for and, roughly, the one below.

        Raises
        ------
        MemoryError
            If the memory that is free does not suffice.
        ArithmeticError
            If the iteration does not converge.
        """
        # Numba takes a second to import: only those who solve pay for it.
        from rheoclast.stokes.fast_mobility import fast_mobility
        from rheoclast.stokes.preconditioner import inverse_factor

        self.refuse_beyond_memory(mobility)
        start = time.perf_counter()
        with one_blas_thread(when=velocities.shape[0] * velocities.shape[1] < UNKNOWNS_FOR_THREADED_ALGEBRA):
            factor = inverse_factor(mobility.centers, mobility.radii, mobility.basis, REACH)
            operator = fast_mobility(mobility, min(max(FAR_FIELD_SHARE * self.tolerance, 1e-7), 1e-2))
            found = [_solution(operator, factor, velocities, self.tolerance, start, progress)]
            if mobility.basis.order > 1:
                tolerance = max(self.tolerance, TOLERANCE_OF_LOWER_ORDER)
                found.insert(0, _solution(operator.lowered(), factor, velocities, tolerance, start, progress))
        return found

    def memory(self, count: int, basis: MultipoleBasis) -> float:
        """Bytes of sixteen blocks of vectors, of the factor for a compact cluster and of the octree's coefficients."""
        far_field = 4.0 * COEFFICIENTS_OF_A_BOX if count > 5000 else 0.0
        return count * basis.size * (8.0 * 16 * 11 + 4.0 * 25 * basis.size + far_field)


def _solution(
    operator: FastMobility,
    factor: BlockSparse,
    velocities: FloatArray,
    tolerance: float,
    start: float,
    progress: Progress | None,
) -> Solution:
    """Solution for velocities (N, M, K), preconditioned by a factor of the inverse of this order or a higher one.

    With P the choice of this order's modes among the factor's, conjugate gradients work on Uᵀ Pᵀ A P U y = Uᵀ Pᵀ v and
    the tractions are P U y.
    """
    basis = operator.mobility.basis
    count, all_modes, columns = velocities.shape
    name = f"conjugate gradients, order {basis.order}"

    def lower(vectors: FloatArray) -> FloatArray:
        if basis.size < all_modes:
            vectors = np.concatenate([vectors, np.zeros((count, all_modes - basis.size, columns))], axis=1)
        return factor.transposed(vectors).reshape(count * all_modes, columns)

    def upper(vectors: FloatArray) -> FloatArray:
        return np.ascontiguousarray((factor @ vectors.reshape(count, all_modes, columns))[:, : basis.size])

    def report(residual: float) -> None:
        if progress is not None:
            progress(f"{name}, residual {residual:.0e}", min(1.0, math.log(residual) / math.log(tolerance)))

    right_side = lower(np.ascontiguousarray(velocities[:, : basis.size]))
    solution, iterations, residual = conjugate_gradients(
        lambda vectors: lower(operator @ upper(vectors)), right_side, tolerance, progress=report
    )
    convergence = Convergence(iterations, residual, time.perf_counter() - start)
    return Solution(upper(solution), basis.order, convergence)
