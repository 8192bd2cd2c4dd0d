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
many digits a removal costs.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import LinAlgError, cholesky, solve_triangular

from rheoclast._checks import FloatArray, IntArray
from rheoclast.frames.cholesky import FrontalCholesky, frontal_cholesky, unknowns
from rheoclast.frames.springs import SpringFrame

MOST_UPDATED = 64  # joints on one factorization; the updates of more cost as much as a new one
LEAST_REDUNDANCY = 1e-9  # an update divides by it; with less it has not seven digits right
LEAST_PIVOT = 1e-14  # of what stood there before elimination: its rounding is a hundredth of that


@dataclass(frozen=True, eq=False)
class FactorizedFrame:
    """A frame ready for removals. Made by `factorized_frame`.

    Attributes
    ----------
    springs
        The frame.
    factor
        Factors of its stiffness, node 0 being held.
    """

    springs: SpringFrame
    factor: FrontalCholesky

    def intact(self) -> Removal:
        """No joint removed yet."""
        return Removal(np.empty(0, dtype=np.intp), _Columns(0, len(self.factor.order)), np.empty((0, 0)))

    def extended(self, removal: Removal, joints: IntArray) -> Removal | None:
        """The removal of some joints more, or None if that is too many or would cost too many digits."""
        count, added = 6 * len(removal.joints), 6 * len(joints)
        if count + added > 6 * MOST_UPDATED:
            return None
        half, filled = self.factor.forward(self._elongations(joints))
        side = np.zeros((count, added))
        for rows in filled:
            side -= removal.rows[:, rows] @ half[rows]
        triangle = _bordered(removal.triangle, side.T, np.eye(added) - half.T @ half)
        if triangle is None:
            return None
        return Removal(np.concatenate([removal.joints, joints]), removal.columns.extended(count, half.T), triangle)

    def shared(self, scaled: FloatArray, removal: Removal) -> FloatArray:
        """Scaled loads q' (6C, K) after a removal, from those before it."""
        parting = removal.parting(scaled[removal.lost])
        return removal.cleared(scaled + self._stretched(removal.rows.T @ parting))

    def correction(self, lacking: FloatArray, removal: Removal) -> FloatArray:
        """Scaled loads (6C, K) after a removal under loads (6N − 6, K) on all nodes but the one held."""
        half = self.factor.forward(lacking)[0]
        return removal.cleared(self._stretched(half + removal.rows.T @ removal.parting(removal.rows @ half)))

    def _stretched(self, half: FloatArray) -> FloatArray:
        """Scaled loads E L⁻ᵀ y (6C, K) from y (6N − 6, K), used up."""
        return self.springs.stretched(self.factor.backward(half))

    def _elongations(self, joints: IntArray) -> FloatArray:
        """Columns (6N − 6, 6R) of Eᵀ for some joints."""
        elongation, count = self.springs.elongation, len(joints)
        columns = np.zeros((len(self.springs.nodes), 6, count, 6))
        ends = elongation.data.reshape(-1, 2, 6, 6)[joints]
        columns[self.springs.pairs[joints], :, np.arange(count)[:, None]] = ends.swapaxes(2, 3)
        return columns.reshape(-1, 6 * count)[6:]


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

    @property
    def lost(self) -> IntArray:
        """Springs (6M,) of the joints."""
        return unknowns(self.joints, 6)

    @property
    def rows(self) -> FloatArray:
        """Yᵀ (6M, 6N − 6), in the order of elimination."""
        return self.columns.values[: 6 * len(self.joints)]

    def parting(self, scaled: FloatArray) -> FloatArray:
        """How far x (6M, K) the sides of the removed joints part, which carried q_R (6M, K)."""
        halfway = solve_triangular(self.triangle, scaled, lower=True, check_finite=False)
        return solve_triangular(self.triangle, halfway, lower=True, trans="T", check_finite=False)

    def cleared(self, scaled: FloatArray) -> FloatArray:
        """Scaled loads (6C, K), used up, with nothing left in the removed joints."""
        scaled[self.lost] = 0.0
        return scaled


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


def factorized_frame(springs: SpringFrame, part: IntArray) -> FactorizedFrame:
    """Factorize a connected frame, from the parts (N − 1,) of its nested dissection.

    Raises
    ------
    ArithmeticError
        If some of it moves without resistance: a pivot is zero to rounding.
    """
    stiffness = springs.stiffness()
    factor = frontal_cholesky(stiffness, part)
    if (factor.pivots <= LEAST_PIVOT * stiffness.diagonal()).any():
        raise ArithmeticError("the frame is singular to rounding")
    return FactorizedFrame(springs, factor)


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
