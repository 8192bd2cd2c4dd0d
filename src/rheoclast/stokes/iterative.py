"""Iterative solution: block conjugate gradients, preconditioned by a sparse inverse Cholesky factor."""

from __future__ import annotations

import math
import time
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from typing import Any, final

import numpy as np
from threadpoolctl import threadpool_limits

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.stokes.basis import MultipoleBasis
from rheoclast.stokes.mobility import Mobility, Progress
from rheoclast.stokes.solver import Convergence, Solution, Solver

HIGHEST_ORDER = 2
REACH = 2.0
"""Length scales within which a sphere is conditioned on coarser ones."""
TOLERANCE_OF_LOWER_ORDER = 3e-3
"""The order below only serves the error bar."""
LARGEST_DIRECT = 5_000
"""Spheres up to which all pairs are summed directly."""
FAR_FIELD_SHARE = 10.0
"""Accuracy of the far field over the tolerance: it errs a tenth of its accuracy for the smooth flows that matter."""
COEFFICIENTS_OF_A_BOX = 450
"""In single precision, at the accuracy that the default tolerance asks for."""
UNKNOWNS_FOR_THREADED_ALGEBRA = 100_000


@final
@dataclass(frozen=True)
class BlockConjugateGradients(Solver):
    """All right-hand sides at once, without the matrix; orders 1 and 2.

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
        ValueError
            For orders above 2.
        """
        order = mobility.basis.order
        if order > HIGHEST_ORDER:
            raise ValueError(f"BlockConjugateGradients: expected order 1 or 2, got {order}; use DenseCholesky")
        self.refuse_beyond_memory(mobility)
        found = []
        for each in range(max(1, order - 1), order + 1):
            basis = MultipoleBasis(each)
            tolerance = self.tolerance if each == order else max(self.tolerance, TOLERANCE_OF_LOWER_ORDER)
            operator = Mobility(mobility.centers, mobility.radii, basis)
            found.append(_solution(operator, velocities[:, : basis.size], tolerance, progress))
        return found

    def memory(self, count: int, basis: MultipoleBasis) -> float:
        """Bytes of sixteen blocks of vectors, of the factor for a compact cluster and of the octree's coefficients."""
        far_field = 4.0 * COEFFICIENTS_OF_A_BOX if count > LARGEST_DIRECT else 0.0
        return count * basis.size * (8.0 * 16 * 11 + 4.0 * 25 * basis.size + far_field)


def _solution(mobility: Mobility, velocities: FloatArray, tolerance: float, progress: Progress | None) -> Solution:
    # Numba takes a second to import: only those who solve pay for it.
    from rheoclast.stokes.conjugate_gradients import conjugate_gradients
    from rheoclast.stokes.far_field import far_field
    from rheoclast.stokes.fast_mobility import FastMobility
    from rheoclast.stokes.preconditioner import inverse_factor

    start = time.perf_counter()
    count, modes, columns = velocities.shape
    accuracy = min(max(FAR_FIELD_SHARE * tolerance, 1e-7), 1e-2)
    name = f"conjugate gradients, order {mobility.basis.order}"

    def report(residual: float) -> None:
        if progress is not None:
            progress(f"{name}, residual {residual:.0e}", min(1.0, math.log(residual) / math.log(tolerance)))

    with _calm_threads(count * modes):
        factor = inverse_factor(mobility.centers, mobility.radii, mobility.basis, REACH)
        far = far_field(mobility.centers, mobility.radii, mobility.basis, accuracy) if count > LARGEST_DIRECT else None
        apply = FastMobility(mobility, far)

        def preconditioned(vectors: FloatArray) -> FloatArray:
            image = factor.lower(apply(factor.upper(vectors.reshape(count, modes, columns))))
            return image.reshape(count * modes, columns)

        right_side = factor.lower(np.ascontiguousarray(velocities)).reshape(count * modes, columns)
        solution, iterations, residual = conjugate_gradients(preconditioned, right_side, tolerance, progress=report)
        tractions = factor.upper(solution.reshape(count, modes, columns))
    convergence = Convergence(iterations, residual, time.perf_counter() - start)
    return Solution(tractions, mobility.basis.order, convergence)


def _calm_threads(unknowns: int) -> AbstractContextManager[Any]:
    """One BLAS thread for small problems, where starting threads costs more than the algebra."""
    return threadpool_limits(1, "blas") if unknowns < UNKNOWNS_FOR_THREADED_ALGEBRA else nullcontext()
