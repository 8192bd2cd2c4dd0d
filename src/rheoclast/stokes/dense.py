"""Direct solution by the dense matrix."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import final

from scipy.linalg import LinAlgError, cho_factor, solve_triangular

from rheoclast._checks import FloatArray
from rheoclast._threads import one_blas_thread
from rheoclast.errors import GeometryError
from rheoclast.progress import Progress
from rheoclast.stokes.basis import MultipoleBasis
from rheoclast.stokes.mobility import Mobility
from rheoclast.stokes.solver import NOT_DEFINITE, Convergence, Solution, Solver, refuse_beyond_memory

FEWEST_FOR_THREADS = 2_000
LARGEST_THREADED_CHOLESKY = 15_000


@final
@dataclass(frozen=True)
class DenseCholesky(Solver):
    """Factorizes the dense matrix: exact to rounding, time N³, memory 8 (N M)² bytes.

    Orders are nested, so the leading part of the one factorization serves every lower order.
    """

    def solve(self, mobility: Mobility, velocities: FloatArray, progress: Progress | None = None) -> list[Solution]:
        """Solutions of orders 1 to p for velocities (N, M, K).

        Raises
        ------
        MemoryError
            If the matrix does not fit into the memory that is free.
        GeometryError
            If the mobility is not positive definite, which happens when spheres overlap.
        """
        start = time.perf_counter()
        count, modes, columns = velocities.shape
        refuse_beyond_memory(self.memory(count, mobility.basis), count, mobility.basis.order)
        matrix = mobility.matrix(progress).reshape(modes * count, modes * count)
        if progress is not None:
            progress("factorization", 0.0)
        with one_blas_thread(when=not threads_serve(len(matrix))):
            # The matrix is symmetric: its transpose is the same, and in the order that LAPACK overwrites.
            factor = _cholesky(matrix.T)
            right_side = velocities.transpose(1, 0, 2).reshape(modes * count, columns)
            forward = solve_triangular(factor, right_side, lower=True, check_finite=False)
            orders = range(1, mobility.basis.order + 1)
            found = [_backward(factor, forward, count * MultipoleBasis(order).size) for order in orders]
        if progress is not None:
            progress("factorization", 1.0)
        convergence = Convergence(0, 0.0, time.perf_counter() - start)
        return [
            Solution(each.reshape(-1, count, columns).transpose(1, 0, 2), order, convergence)
            for order, each in zip(orders, found, strict=True)
        ]

    def memory(self, count: int, basis: MultipoleBasis) -> float:
        """Bytes of the matrix, and of the copy of its leading part that the next lower order takes."""
        lower = MultipoleBasis(basis.order - 1).size if basis.order > 1 else 0
        return 8.0 * count**2 * (basis.size**2 + lower**2)


def threads_serve(size: int) -> bool:
    """Whether a Cholesky factorization of this size may use several threads.

    Small ones gain little, and lose much where a thread is late on a busy machine. In large ones, n ≥ 16 000, the
    OpenBLAS of NumPy's and SciPy's wheels crashes.
    """
    return FEWEST_FOR_THREADS <= size <= LARGEST_THREADED_CHOLESKY


def _cholesky(matrix: FloatArray) -> FloatArray:
    """Lower factor in place of a symmetric matrix in Fortran order."""
    try:
        return cho_factor(matrix, lower=True, overwrite_a=True, check_finite=False)[0]
    except LinAlgError:
        raise GeometryError(NOT_DEFINITE) from None


def _backward(factor: FloatArray, forward: FloatArray, size: int) -> FloatArray:
    """Solution (size, K) of the leading part of the system, from the forward substitution of the whole."""
    return solve_triangular(factor[:size, :size], forward[:size], lower=True, trans="T", check_finite=False)
