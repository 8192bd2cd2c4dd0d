"""A factorized frame and what changes in it when joints are removed, by updates of low rank.

Let T be the balance of the nodes, S the square roots of the joints' stiffness and G = T S, so that the stiffness of the
frame is K = G Gᵀ. Under loads F the joints carry S q with q = −Gᵀ K⁻¹ F. Taking away the joints R leaves K − G_R G_Rᵀ, and
by the formula of Sherman, Morrison and Woodbury (Woodbury 1950; Hager, SIAM Review 31, 221, 1989)

    q' = q + (E_R − Gᵀ V) x   with   V = K⁻¹ G_R   and   (1 − G_Rᵀ V) x = −q_R.

E_R are unit loads of the joints R, and E_R − Gᵀ V is the self-stress that a misfit of each causes. The matrix in brackets
is the block of R in the redundancy matrix (von Scheven, Ramm & Bischoff, International Journal of Solids and Structures
213, 41, 2021). It is free of units, and its eigenvalues lie between 1, for a spring that the others make superfluous, and
0, for one without which the frame falls apart or moves without resistance. So it tells beforehand how many digits a
removal costs, and a spring without stiffness is no special case.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import LinAlgError, cholesky, solve_triangular
from scipy.sparse import bsr_array

from rheoclast._checks import FloatArray, IntArray
from rheoclast.frames.cholesky import FrontalCholesky, frontal_cholesky
from rheoclast.frames.springs import SpringFrame

MOST_UPDATED = 48  # joints on one factorization: beyond, their updates cost as much as a new one
LEAST_REDUNDANCY = 1e-5
LEAST_PIVOT = 1e-14


@dataclass(frozen=True, eq=False)
class FactorizedFrame:
    """A frame ready for loads and for removals. Made by `factorized_frame`.

    Attributes
    ----------
    springs
        Gᵀ and the factors of K with node 0 held: it gives scaled joint loads q for loads F.
    rows
        (C, 12, 6) entries of G in the columns of each joint, and
    places
        (C, 12) the rows that they stand in.
    """

    springs: SpringFrame
    rows: FloatArray
    places: IntArray

    @property
    def unchanged(self) -> Removal:
        """No joint removed."""
        return Removal(np.empty(0, dtype=np.intp), _Columns(self.springs.stress.shape[1]), np.empty((0, 0)))

    def without(self, removal: Removal, joints: IntArray) -> Removal | None:
        """The removal of some joints (R,) more, or None if that would cost too many digits or is one too many."""
        before, added = 6 * len(removal.joints), 6 * len(joints)
        if before + added > 6 * MOST_UPDATED:
            return None
        columns = removal.columns.extended(before, self._displacements(joints))
        places = self.places[joints]
        # (12, 6 (M + R)) displacements at the ends of each new joint by all removed ones, new ones included.
        ends = columns.rows[: before + added, places].transpose(1, 2, 0)
        coupling = (self.rows[joints].swapaxes(1, 2) @ ends).reshape(added, before + added)
        triangle = _bordered(removal.triangle, -coupling[:, :before], np.eye(added) - coupling[:, before:])
        return None if triangle is None else Removal(np.concatenate([removal.joints, joints]), columns, triangle)

    def scaled_loads(self, intact: FloatArray, removal: Removal) -> FloatArray:
        """Scaled joint loads q' (6C, K) without the joints of a removal, from those with all of them."""
        rows = _unknowns(removal.joints)
        forward = solve_triangular(removal.triangle, -intact[rows], lower=True, check_finite=False)
        misfit = solve_triangular(removal.triangle, forward, lower=True, trans="T", check_finite=False)
        scaled = intact + self.springs.stress @ (removal.columns.rows[: len(rows)].T @ misfit)
        scaled[rows] = 0.0
        return scaled

    def _displacements(self, joints: IntArray) -> FloatArray:
        """Columns of V, displacements of the nodes by a unit misfit of each spring of some joints, as rows (6R, 6N)."""
        loads = np.zeros((self.springs.stress.shape[1], 6 * len(joints)))
        for k, joint in enumerate(joints):
            loads[self.places[joint], 6 * k : 6 * k + 6] = self.rows[joint]
        loads[6:] = self.springs.factor.solve(loads[6:])
        loads[:6] = 0.0
        return loads.T


@dataclass(frozen=True, eq=False)
class Removal:
    """Joints removed from a factorized frame.

    Attributes
    ----------
    joints
        (M,) joints in the order of removal.
    columns
        V, shared with what follows.
    triangle
        (6M, 6M) lower Cholesky factor of their block of the redundancy matrix.
    """

    joints: IntArray
    columns: _Columns
    triangle: FloatArray


class _Columns:
    """Columns of V, row by row, in an array that a sequence of removals fills and shares."""

    def __init__(self, size: int) -> None:
        self.rows: FloatArray = np.empty((6 * MOST_UPDATED, size))
        self.used = 0

    def extended(self, count: int, added: FloatArray) -> _Columns:
        """The first `count` columns and some more: a copy if another sequence has gone on from there before."""
        columns = self
        if self.used != count:
            columns = _Columns(self.rows.shape[1])
            columns.rows[:count] = self.rows[:count]
        columns.used = count + len(added)
        columns.rows[count : columns.used] = added
        return columns


def factorized_frame(rooted: bsr_array, pairs: IntArray, part: IntArray, removed: IntArray) -> FactorizedFrame | int:
    """Factorize a frame without some of its joints, or find a node that moves without resistance.

    Parameters
    ----------
    rooted
        (6N, 6C) balance of the nodes times the root of the joints' stiffness, G, of all joints.
    pairs, part
        (C, 2) nodes of every joint, (N − 1,) parts of the nested dissection of all nodes but the first.
    removed
        (R,) joints that are not there.
    """
    there = np.ones(len(pairs))
    there[removed] = 0.0
    data = rooted.data * there[rooted.indices][:, None, None]
    rooted = bsr_array((data, rooted.indices, rooted.indptr), shape=rooted.shape)
    first = rooted.indptr[1]
    held = bsr_array((data[first:], rooted.indices[first:], rooted.indptr[1:] - first), shape=(len(part) * 6, rooted.shape[1]))
    stiffness = (held @ held.T).tobsr((6, 6))
    try:
        factor = frontal_cholesky(stiffness, part)
    except ArithmeticError:
        ...
    loose = _loose(factor, stiffness.diagonal())
