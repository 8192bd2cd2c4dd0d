"""How far a multipole order is from the exact solution, judged from the orders below it.

With Δ_p the change from order p − 1 to p, the expected error at order p is

    s |Δ_2|                                at order 2,
    (p / 6) · sqrt(Δ_p² + (w Δ_{p−1})²)    at order 3 and above.

Convergence of contact loads is about algebraic because of the points of contact: for an error that falls like p^−q the
sum of all changes yet to come is about p/q times the last, whence the factor. The change before it is there because in
symmetric arrangements every second order may change nothing. Share s and weight w depend on the quantity and are
calibrated in `validation/truncation_error`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from rheoclast._checks import FloatArray

LOWEST_ORDER = 2


class ErrorRule(NamedTuple):
    """How changes between orders tell of the error of a quantity.

    Attributes
    ----------
    share
        Share s of the change from order 1 to 2 that is expected as error at order 2.
    weight
        Weight w of the change before the last, at order 3 and above.
    """

    share: float
    weight: float


FORCE = ErrorRule(share=1.0, weight=1 / 4)
"""The rule for forces on spheres, and tensions."""


def expected_error(
    values: Sequence[FloatArray], order: int, axis: int | tuple[int, ...] | None = None, rule: ErrorRule = FORCE
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
    rule
        Share s and weight w of the quantity.
    """
    last = np.sum((values[-1] - values[-2]) ** 2, axis=axis)
    if order == LOWEST_ORDER:
        return np.asarray(rule.share * np.sqrt(last))
    before = np.sum((values[-2] - values[-3]) ** 2, axis=axis)
    return np.asarray(order / 6 * np.sqrt(last + rule.weight**2 * before))
