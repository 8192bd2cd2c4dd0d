"""Ways to solve mobility · traction = velocity."""

from __future__ import annotations

from abc import ABC, abstractmethod
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from typing import Any, final

from scipy.linalg import LinAlgError, cho_factor, cho_solve
from threadpoolctl import threadpool_limits

from rheoclast._checks import FloatArray
from rheoclast.errors import GeometryError
from rheoclast.stokes.mobility import Mobility, Progress


class Solver(ABC):
    """Solves for the tractions that give prescribed surface velocities."""

    @abstractmethod
    def solve(self, mobility: Mobility, velocities: FloatArray, progress: Progress | None = None) -> FloatArray:
        """Tractions (N, M, K) from velocities (N, M, K)."""


@final
@dataclass(frozen=True)
class DenseCholesky(Solver):
    """Factorizes the dense matrix: exact to rounding, time N³, memory 8 (N M)² bytes."""

    def solve(self, mobility: Mobility, velocities: FloatArray, progress: Progress | None = None) -> FloatArray:
        """Tractions (N, M, K) from velocities (N, M, K).

        Raises
        ------
        GeometryError
            If the mobility is not positive definite, which happens when spheres overlap.
        """
        size = mobility.shape[0]
        matrix = mobility.matrix(progress).reshape(size, size)
        if progress is not None:
            progress("factorization", 0.0)
        with _safe_threads(size):
            try:
                # The matrix is symmetric: its transpose is the same, and in the order that LAPACK overwrites.
                factor = cho_factor(matrix.T, lower=True, overwrite_a=True, check_finite=False)
            except LinAlgError:
                raise GeometryError(
                    "the mobility of these spheres is not positive definite, as happens when spheres overlap; "
                    "shrink the radii until they only touch"
                ) from None
            tractions = cho_solve(factor, velocities.reshape(size, -1), check_finite=False)
        if progress is not None:
            progress("factorization", 1.0)
        return tractions.reshape(velocities.shape)


LARGEST_THREADED_CHOLESKY = 15_000


def _safe_threads(size: int) -> AbstractContextManager[Any]:
    """One BLAS thread where the OpenBLAS of NumPy's and SciPy's wheels crashes in a threaded Cholesky (n ≥ 16 000)."""
    return threadpool_limits(1, "blas") if size > LARGEST_THREADED_CHOLESKY else nullcontext()
