"""A factorized frame, and what changes in it when joints are removed: updates of low rank.

Let displacements u of the nodes stretch the springs of the joints by E u, each times the root of its stiffness. Then
the frame's stiffness is K = Eᵀ E = L Lᵀ, and under loads F the springs carry q = E K⁻¹ F, over those roots. Without the
joints R the stiffness is K − E_Rᵀ E_R. The formula of Sherman, Morrison and Woodbury (Hager, SIAM Review 31, 221, 1989)
gives, in the joints that remain,

    q' = q + E L⁻ᵀ Y x   with   L Y = E_Rᵀ   and   (1 − Yᵀ Y) x = q_R,

where x is how far the sides of the removed joints part. Y is soon known, because only the fronts between a joint and
the root of the dissection take part.

1 − Yᵀ Y is the block of R in the redundancy matrix (von Scheven, Ramm & Bischoff, International Journal of Solids and
Structures 213, 41, 2021). It has no unit, and its eigenvalues lie between 1, for a spring that the others make
superfluous, and 0, for one without which the frame falls apart or moves without resistance. So it tells beforehand how
many digits a removal costs, and a spring without stiffness is no special case.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import LinAlgError, cholesky, solve_triangular
from scipy.linalg.blas import dtrsm
from scipy.sparse import bsr_array

from rheoclast._checks import FloatArray, IntArray
from rheoclast.frames.cholesky import FrontalCholesky, frontal_cholesky
from rheoclast.frames.springs import SpringFrame

MOST_UPDATED = 64  # joints on one factorization; the updates of more cost as much as a new one
LEAST_REDUNDANCY = 1e-9
LEAST_PIVOT = 1e-14


@dataclass(frozen=True, eq=False)
class FactorizedFrame:
    """A frame ready for loads and for removals. Made by `factorized_frame`.

    Attributes
    ----------
    springs
        E and the factors of K with node 0 held: scaled joint loads q from loads F.
    factor
        Those factors.
    ends
        (C, 12, 6) entries of E in the rows of each joint, and
    places
        (C, 12) the unknowns that they belong to, in the order of elimination; that of a node held comes last.
    """

    springs: SpringFrame
    factor: FrontalCholesky
    ends: FloatArray
    places: IntArray

    def intact(self) -> Removal:
        """No joint removed yet."""
        return Removal(np.empty(0, dtype=np.intp), _Columns(0, len(self.factor.order)), np.empty((0, 0)))

    def extended(self, removal: Removal, joints: IntArray) -> Removal | None:
        """The removal of some joints more, or None if that is too many or would cost too many digits."""
        count, added = 6 * len(removal.joints), 6 * len(joints)
        if count + added > 6 * MOST_UPDATED:
            return None
        half, filled = self._half_solved(joints)
        side = np.zeros((count, added))
        for rows in filled:
            side -= removal.columns.values[:count, rows] @ half[rows]
        triangle = _bordered(removal.triangle, side.T, np.eye(added) - half.T @ half)
        if triangle is None:
            return None
        return Removal(np.concatenate([removal.joints, joints]), removal.columns.extended(count, half.T), triangle)

    def scaled_loads(self, carried: FloatArray, removal: Removal) -> FloatArray:
        """Scaled joint loads q' (6C, K) after a removal, from those before it."""
        rows = unknowns(removal.joints)
        parting = removal.parting(carried[rows])
        scaled = carried + self._stress(removal.columns.values[: len(rows)].T @ parting)
        scaled[rows] = 0.0
        return scaled

    def refined_loads(self, scaled: FloatArray, unbalanced: FloatArray, removal: Removal) -> FloatArray:
        """Scaled joint loads q' after a removal with those added that loads (6N, K) left unbalanced call for.

        The displacements of a frame that has become soft are large, and its joint loads small differences of them.
        """
        rows = unknowns(removal.joints)
        columns = removal.columns.values[: len(rows)]
        half = _forward(self.factor, unbalanced[6:][self.factor.order])[0]
        added = self._stress(half + columns.T @ removal.parting(columns @ half))
        added[rows] = 0.0
        return scaled + added

    def _stress(self, half: FloatArray) -> FloatArray:
        """Scaled joint loads E L⁻ᵀ y (6C, K) from y (6N − 6, K), used up."""
        moved = np.zeros((self.springs.stress.shape[1], half.shape[1]))
        moved[6 + self.factor.order] = _backward(self.factor, half)
        return self.springs.stress @ moved

    def _half_solved(self, joints: IntArray) -> tuple[FloatArray, list[slice]]:
        """Columns (6N − 6, 6R) of Y for some joints, and the rows where they are not zero."""
        size, count = len(self.factor.order), len(joints)
        loads = np.zeros((size + 6, count, 6))
        loads[self.places[joints], np.arange(count)[:, None]] = self.ends[joints]
        return _forward(self.factor, loads[:size].reshape(size, 6 * count))


@dataclass(frozen=True, eq=False)
class Removal:
    """Joints removed from a factorized frame. Made by `FactorizedFrame.intact` and `FactorizedFrame.extended`.

    Attributes
    ----------
    joints
        (M,) joints in the order of removal.
    columns
        Y, shared with removals that follow.
    triangle
        (6M, 6M) lower Cholesky factor of their block of the redundancy matrix.
    """

    joints: IntArray
    columns: _Columns
    triangle: FloatArray

    def parting(self, carried: FloatArray) -> FloatArray:
        """How far x (6M, K) the sides of the removed joints part, which carried q_R (6M, K)."""
        halfway = solve_triangular(self.triangle, carried, lower=True, check_finite=False)
        return solve_triangular(self.triangle, halfway, lower=True, trans="T", check_finite=False)


class _Columns:
    """Columns of Y, stored as rows of an array that a sequence of removals fills and shares."""

    def __init__(self, capacity: int, size: int) -> None:
        self.values: FloatArray = np.empty((capacity, size))
        self.used = 0

    def extended(self, count: int, added: FloatArray) -> _Columns:
        """The first columns and some more; in a copy if the array is full or another sequence has gone on from them."""
        total = count + len(added)
        columns = self
        if self.used != count or total > len(self.values):
            # At once for all that one factorization is used for: memory that is never touched costs nothing.
            columns = _Columns(max(total, 6 * MOST_UPDATED), self.values.shape[1])
            columns.values[:count] = self.values[:count]
        columns.values[count:total] = added
        columns.used = total
        return columns


def factorized_frame(elongation: bsr_array, part: IntArray, removed: IntArray) -> FactorizedFrame:
    """Assemble and factorize a connected frame without some of its joints.

    Parameters
    ----------
    elongation
        (6C, 6N) matrix E of all joints, two blocks in the row of each.
    part
        (N − 1,) parts of the nested dissection of all nodes but node 0.
    removed
        (R,) joints that are not there.

    Raises
    ------
    ArithmeticError
        If some of it moves without resistance: a pivot is zero to rounding.
    """
    blocks = elongation.data.reshape(-1, 2, 6, 6).copy()
    blocks[removed] = 0.0
    present = bsr_array((blocks.reshape(-1, 6, 6), elongation.indices, elongation.indptr), shape=elongation.shape)
    equilibrium = -present.T
    held = _without_first_block_row(equilibrium)
    stiffness = held @ held.T
    factor = frontal_cholesky(stiffness, part)
    _refuse_vanishing_pivots(factor, stiffness.diagonal())
    ends = blocks.swapaxes(2, 3).reshape(-1, 12, 6)
    place = np.argsort(np.concatenate([6 + factor.order, np.arange(6)]))
    places = place[unknowns(elongation.indices.astype(np.intp))].reshape(-1, 12)
    return FactorizedFrame(SpringFrame(equilibrium, present, factor), factor, ends, places)


def unknowns(blocks: IntArray) -> IntArray:
    """Indices (6B,) of the rows of some blocks (B,)."""
    return (6 * blocks[:, None] + np.arange(6)).ravel()


def _without_first_block_row(matrix: bsr_array) -> bsr_array:
    first = matrix.indptr[1]
    rest = (matrix.data[first:], matrix.indices[first:], matrix.indptr[1:] - first)
    return bsr_array(rest, shape=(matrix.shape[0] - matrix.blocksize[0], matrix.shape[1]))


def _forward(factor: FrontalCholesky, values: FloatArray) -> tuple[FloatArray, list[slice]]:
    """Solution of L y = x for columns x that are mostly zero, used up, and the rows where it is not."""
    filled = []
    for front in factor.fronts:
        if values[front.own].any():
            values[front.own] = own = dtrsm(1.0, front.triangle, values[front.own], lower=1)
            values[front.beyond] -= front.rectangle @ own
            filled.append(front.own)
    return values, filled


def _backward(factor: FrontalCholesky, values: FloatArray) -> FloatArray:
    """Solution of Lᵀ x = y for columns y, used up."""
    for front in reversed(factor.fronts):
        rest = values[front.own] - front.rectangle.T @ values[front.beyond]
        values[front.own] = dtrsm(1.0, front.triangle, rest, lower=1, trans_a=1)
    return values


def _refuse_vanishing_pivots(factor: FrontalCholesky, diagonal: FloatArray) -> None:
    pivots = np.concatenate([front.triangle.diagonal() for front in factor.fronts]) ** 2
    if (pivots <= LEAST_PIVOT * diagonal[factor.order]).any():
        raise ArithmeticError("the matrix is singular to rounding")


def _bordered(triangle: FloatArray, side: FloatArray, corner: FloatArray) -> FloatArray | None:
    """Lower Cholesky factor of a matrix of redundancies with rows and columns added, or None if it is near singular."""
    added, count = side.shape
    below = solve_triangular(triangle, side.T, lower=True, check_finite=False).T if count else side
    try:
        last = cholesky(corner - below @ below.T, lower=True, check_finite=False)
    except LinAlgError:
        return None
    if np.linalg.svd(last, compute_uv=False)[-1] ** 2 < LEAST_REDUNDANCY:
        return None
    return np.block([[triangle, np.zeros((count, added))], [below, last]])
