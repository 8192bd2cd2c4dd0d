"""How far a multipole order is from the exact solution, judged from the orders below it.

With Δ_p the change from order p − 1 to p, the expected error at order p is

    s |Δ_2|                                  at order 2, with a share s that depends on the quantity,
    (p / 6) · sqrt(Δ_p² + (Δ_{p−1} / 4)²)    at order 3 and above.

Convergence is algebraic because of the points of contact: for an error that falls like p^−q the sum of all changes yet
to come is about p/q times the last, whence the factor. The change before it is there because in symmetric arrangements
every second order may change nothing. Shares and factors are calibrated in `validation/truncation_error`.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rheoclast._checks import FloatArray

LOWEST_ORDER = 2


def expected_error(
    values: Sequence[FloatArray], order: int, axis: int | tuple[int, ...] | None = None, share: float = 1.0
) -> FloatArray:
    """Expected error of a quantity at multipole order p, as a root of a sum of squares over some axes.

    Parameters
    ----------
    values
        The quantity at increasing orders, of which the last is p; at least two, and from order 3 up at least three.
    order
        The order p ≥ 2.
    axis
        Axes over which the squares of the changes are added up; None for all.
    share
        The share s of the change that is expected as error at order 2.
    """
    last = np.sum((values[-1] - values[-2]) ** 2, axis=axis)
    if order == LOWEST_ORDER:
        return np.asarray(share * np.sqrt(last))
    before = np.sum((values[-2] - values[-3]) ** 2, axis=axis)
    return np.asarray(order / 6 * np.sqrt(last + before / 16))
