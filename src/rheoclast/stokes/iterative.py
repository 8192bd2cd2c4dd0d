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
from rheoclast.progress import Progress
from rheoclast.stokes.basis import HIGHEST_CLOSED_ORDER, MultipoleBasis
from rheoclast.stokes.conjugate_gradients import conjugate_gradients
from rheoclast.stokes.mobility import Mobility
from rheoclast.stokes.solver import Convergence, Solution, Solver, refuse_beyond_memory

if TYPE_CHECKING:
    from rheoclast.stokes.block_rows import BlockRows
    from rheoclast.stokes.fast_mobility import FastMobility

MODES_OF_ORDER_ONE = 3
REACHES = (2.0, 3.0)
"""Length scales within which a sphere is conditioned on coarser ones, up to a thousand spheres and from 10⁵ on.

At a fixed reach the number of iterations grows slowly with that of the spheres, and each costs more.
"""
TOLERANCE_OF_ORDER_ONE = 3e-3
"""Tolerance of order 1, which only serves the error bar of order 2: a few per cent of the change between them.

For the bars of higher orders it is lower, as are the changes: about as the inverse fourth power of the order.
"""
FAR_FIELD_SHARE = 2.0
"""Accuracy of the far field over the tolerance: loads err a third of it."""
VECTORS = 20 * 11
"""Blocks of eleven vectors that are held at a time."""
CONDITIONING_SPHERES = 25
NEAR_SPHERES = 300
"""Spheres in neighbouring leaves, and fewest for which there may be an octree."""
COEFFICIENTS_OF_A_BOX = 450
"""In single precision, at the accuracy that the default tolerance asks for."""


@final
@dataclass(frozen=True)
class BlockConjugateGradients(Solver):
    """All right-hand sides at once, without the matrix.

    Parameters
    ----------
    tolerance
        Largest residual of any right-hand side over its norm, both measured in the preconditioned space, where the
        operator is near the identity. Contact loads are then good to about the tolerance, as a share of the
        largest; moments in long straight chains to two hundred times it (see `tests/agreement/test_iterative.py`).
    """

    tolerance: float = 1e-5

    def __post_init__(self) -> None:
        _checks.positive("tolerance", self.tolerance)
        if self.tolerance >= 1:
            raise ValueError(f"tolerance: expected a share below 1, got {self.tolerance:g}")

    def solve(self, mobility: Mobility, velocities: FloatArray, progress: Progress | None = None) -> list[Solution]:
        """Solutions of the order asked for and, roughly, of the one or two below that its error bar takes.

        Raises
        ------
        MemoryError
            If the memory that is free does not suffice.
        ArithmeticError
            If the iteration does not converge.
        GeometryError
            If the mobility is not positive definite, which happens when spheres overlap.
        ValueError
            For so few spheres that they have fewer modes than there are right-hand sides.
        """
        # Numba takes a second to import: only those who solve pay for it.
        from rheoclast.stokes.fast_mobility import fast_mobility
        from rheoclast.stokes.preconditioner import inverse_factor

        start = time.perf_counter()
        count, order = len(mobility.radii), mobility.basis.order
        if MODES_OF_ORDER_ONE * count < velocities.shape[2]:
            raise ValueError(
                f"BlockConjugateGradients: {velocities.shape[2]} right-hand sides need at least "
                f"{-(-velocities.shape[2] // MODES_OF_ORDER_ONE)} spheres, got {count}; use DenseCholesky"
            )
        refuse_beyond_memory(self.memory(count, mobility.basis), count, order)
        operator = fast_mobility(mobility, min(max(FAR_FIELD_SHARE * self.tolerance, 1e-7), 1e-2))
        with one_blas_thread():  # its threads would wait in the way of those of the compiled sums
            factors = inverse_factor(mobility.centers, mobility.radii, mobility.basis, _reach(count))
            found = [_solution(operator, factors, velocities, self.tolerance, start, progress)]
            rough = max(self.tolerance, TOLERANCE_OF_ORDER_ONE * (2 / max(order, 2)) ** 4)
            for _ in range(_lower_orders(order)):
                operator = operator.lowered()
                found.append(_solution(operator, factors, velocities, rough, time.perf_counter(), progress))
        return found[::-1]

    def memory(self, count: int, basis: MultipoleBasis) -> float:
        """Bytes of the vectors, of the factor and, where they are needed, of stored blocks and the octree.

        An estimate for a compact cluster; blocks that turn out not to fit are refused before they are stored.
        """
        near = min(count, NEAR_SPHERES) if basis.order > HIGHEST_CLOSED_ORDER else 0
        blocks = (2 * CONDITIONING_SPHERES + near) * basis.size
        far_field = COEFFICIENTS_OF_A_BOX if count > NEAR_SPHERES else 0
        return count * basis.size * (8.0 * VECTORS + 4.0 * blocks + 4.0 * far_field)


def _lower_orders(order: int) -> int:
    """How many orders below the error bar of an order compares."""
    return min(order - 1, 1 if order == 2 else 2)


def _reach(count: int) -> float:
    return float(np.interp(np.log10(count), (3, 5), REACHES))


def _solution(
    operator: FastMobility,
    factors: tuple[BlockRows, BlockRows],
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
    factor, transposed = factors
    count, all_modes, columns = velocities.shape
    name = f"conjugate gradients, order {basis.order}"

    def lower(vectors: FloatArray) -> FloatArray:
        if basis.size < all_modes:
            vectors = np.concatenate([vectors, np.zeros((count, all_modes - basis.size, columns))], axis=1)
        return (transposed @ vectors).reshape(count * all_modes, columns)

    def upper(vectors: FloatArray) -> FloatArray:
        return np.ascontiguousarray((factor @ vectors.reshape(count, all_modes, columns))[:, : basis.size])

    def report(residual: float) -> None:
        if progress is not None:
            reached = math.log(max(residual, tolerance)) / math.log(tolerance)
            progress(f"{name}, residual {residual:.0e}", max(0.0, reached))

    right_side = lower(np.ascontiguousarray(velocities[:, : basis.size]))
    solution, iterations, residual = conjugate_gradients(
        lambda vectors: lower(operator @ upper(vectors)), right_side, tolerance, progress=report
    )
    convergence = Convergence(iterations, residual, time.perf_counter() - start)
    return Solution(upper(solution), basis.order, convergence)
