"""Block conjugate gradients: all right-hand sides share one Krylov space.

The variant that keeps the block of residuals orthonormal does not break down when residuals become dependent:
A. A. Dubrulle, Electron. Trans. Numer. Anal. 12 (2001) 216.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rheoclast._checks import FloatArray

Operator = Callable[[FloatArray], FloatArray]


def conjugate_gradients(
    operator: Operator,
    right_side: FloatArray,
    tolerance: float,
    most_iterations: int = 200,
    progress: Callable[[float], None] | None = None,
) -> tuple[FloatArray, int, float]:
    """Solve A X = B for a symmetric positive definite operator.

    Parameters
    ----------
    operator
        X (n, K) ↦ A X (n, K).
    right_side
        B (n, K).
    tolerance
        Largest residual of any column, over the norm of its right-hand side.
    most_iterations
        After which the search is given up.
    progress
        Called with the residual after every iteration.

    Returns
    -------
    solution, iterations, residual
        X (n, K), the number of applications of the operator, and the largest residual over the norm of its right-hand
        side.

    Raises
    ------
    ArithmeticError
        If the tolerance is not reached.
    """
    norms = np.linalg.norm(right_side, axis=0)
    norms[norms == 0] = 1.0
    scaled = right_side / norms
    solution = np.zeros_like(scaled)
    residual, size = np.linalg.qr(scaled)
    direction = residual
    worst = 1.0
    for iteration in range(1, most_iterations + 1):
        image = operator(direction)
        step = np.linalg.inv(direction.T @ image)
        solution += direction @ (step @ size)
        residual, change = np.linalg.qr(residual - image @ step)
        direction = residual + direction @ change.T
        size = change @ size
        worst = float(np.linalg.norm(size, axis=0).max())
        if progress is not None:
            progress(worst)
        if worst <= tolerance:
            return solution * norms, iteration, worst
    raise ArithmeticError(
        f"conjugate gradients: residual {worst:.2g} after {most_iterations} iterations, expected {tolerance:.2g}; "
        "do the spheres overlap?"
    )
