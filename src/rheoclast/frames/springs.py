"""Spring frames: rigid nodes whose joints yield by a normal, a tangential, a bending and a twisting spring.

Every joint has six springs in its own axes: for force a normal one and two across, for moment a twisting one and two
for bending. Displacements u of the nodes stretch them by E u, each times the root of its stiffness. The stiffness of
the frame is K = Eᵀ E, and under loads F the springs carry q = E K⁻¹ F, each over that root: the scaled loads. This is
the framework of Strang, SIAM Review 30, 283 (1988), with the springs' stiffness shared out to both sides.

Every spring has a row of its own in E. So the stiffness of a soft one is not rounded to that of a stiff one of the same
joint, and one without stiffness is no special case. A joint that is gone is six of these.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import bsr_array, csc_array
from scipy.sparse.linalg import splu

from rheoclast import _checks
from rheoclast._checks import FloatArray, IntArray
from rheoclast._threads import one_blas_thread
from rheoclast.frames.cholesky import frontal_cholesky, unknowns
from rheoclast.frames.dissection import dissection
from rheoclast.frames.kinematics import joint_axes, side_displacements

MOST_LOOPS_BY_SUPERLU = 2000  # joints that close a loop; they make fill, for which the fronts' BLAS pays
IN_BALANCE = 1e-13  # of the largest load, or joint load: the rounding of some hundred sums
STAGNATION = 0.5  # of the imbalance; a refinement that leaves more is the last


class Factor(Protocol):
    """Factors of a symmetric positive definite matrix, ready to solve with."""

    def solve(self, rhs: FloatArray, /) -> FloatArray:
        """Solution (n, K) for right-hand sides (n, K)."""


@dataclass(frozen=True, eq=False)
class SpringFrame:
    """A connected frame of springs. Made by `spring_frame`.

    Attributes
    ----------
    nodes, pairs
        (N, 3) places of the nodes, (C, 2) nodes of every joint.
    axes
        (C, 3, 3) axes of every joint as columns, the first along its normal.
    root
        (6C,) root of the stiffness of every spring, over that of the stiffest.
    sides
        (6C, 6N) matrix A: how far the sides of the joints part, in their axes, from displacements of the nodes.
    """

    nodes: FloatArray
    pairs: IntArray
    axes: FloatArray
    root: FloatArray
    sides: bsr_array

    @cached_property
    def elongation(self) -> bsr_array:
        """Matrix E (6C, 6N): displacements of the nodes to elongations of the springs times the root of stiffness."""
        blocks = self.root.reshape(-1, 1, 6, 1) * self.sides.data.reshape(-1, 2, 6, 6)
        return bsr_array((blocks.reshape(-1, 6, 6), self.sides.indices, self.sides.indptr), shape=self.sides.shape)

    @cached_property
    def equilibrium(self) -> bsr_array:
        """Matrix Eᵀ (6N, 6C): scaled loads of the springs to the loads on the nodes that they balance."""
        return self.elongation.T

    def stiffness(self) -> bsr_array:
        """Matrix K (6N − 6, 6N − 6) with node 0 held."""
        equilibrium = self.equilibrium
        first = equilibrium.indptr[1]
        blocks = (equilibrium.data[first:], equilibrium.indices[first:], equilibrium.indptr[1:] - first)
        held = bsr_array(blocks, shape=(equilibrium.shape[0] - 6, equilibrium.shape[1]))
        return held @ held.T

    def parts(self) -> IntArray:
        """Parts (N − 1,) of the nested dissection of all nodes but node 0."""
        return dissection(self.nodes[1:], self.pairs[(self.pairs > 0).all(axis=1)] - 1)

    def without(self, joints: IntArray) -> SpringFrame:
        """The frame without some joints, whose springs have no stiffness left."""
        root = self.root.copy()
        root[unknowns(joints, 6)] = 0.0
        return replace(self, root=root)

    def joint_loads(self, loads: FloatArray) -> FloatArray:
        """Joint loads (C, 6, K) under balanced loads (N, 6, K).

        Raises
        ------
        ArithmeticError
            If the frame cannot be solved, or balance is not reached, because the stiffnesses differ by too many
            decades.
        """
        return self.from_scaled(self.solution(self._quickest_factor(), loads.reshape(-1, loads.shape[-1]))[0])

    def from_scaled(self, scaled: FloatArray) -> FloatArray:
        """Joint loads (C, 6, K) from scaled loads (6C, K) of the springs."""
        return (self._turning @ (self.root[:, None] * scaled)).reshape(-1, 6, scaled.shape[1])

    def solution(self, factor: Factor, loads: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Scaled loads (6C, K) under balanced loads (6N, K) by factors of the stiffness, and their imbalance (K,).

        Raises
        ------
        ArithmeticError
            If balance is not reached because the stiffnesses differ by too many decades.
        """
        with one_blas_thread():
            first = self.stretched(factor.solve(loads[6:]))
            scaled, left = self.balanced(first, loads, lambda lacking: self.stretched(factor.solve(lacking)))
        size = _sizes(loads)
        largest = np.maximum(np.abs(self.root[:, None] * scaled).max(axis=0), size)
        if (left * size <= IN_BALANCE * largest).all():
            return scaled, left
        raise ArithmeticError(
            f"the frame of {len(self.nodes)} spheres does not balance: {(left * size).max():.2g} of a largest load "
            f"{size.max():.2g} is left after refinement; "
            "bring the stiffnesses closer together, or use statics if the contacts form a tree"
        )

    def balanced(
        self,
        scaled: FloatArray,
        loads: FloatArray,
        correction: Callable[[FloatArray], FloatArray],
        tolerance: float = IN_BALANCE,
    ) -> tuple[FloatArray, FloatArray]:
        """Scaled loads (6C, K) refined until they balance loads (6N, K), and their imbalance (K,) after all.

        The displacements of a slender frame are large and its joint loads small differences of them. So what the loads
        so far leave unbalanced (6N − 6, K) is solved for again by `correction`, and only scaled loads are added up.
        Imbalance is the largest on a node, over the largest load of the case. Node 0, which would show what the loads
        themselves lack, does not count.
        """
        size, before = _sizes(loads), np.inf
        while True:
            lacking = self.lacking(scaled, loads)[6:]
            left = np.abs(lacking).max(axis=0) / size
            worst = float(left.max(initial=0.0))
            # So put that it also ends with what is no number, as a singular frame may give.
            if not tolerance < worst <= STAGNATION * before:
                return scaled, left
            scaled, before = scaled + correction(lacking), worst

    def lacking(self, scaled: FloatArray, loads: FloatArray) -> FloatArray:
        """Force and torque (6N, K) on the nodes that scaled loads (6C, K) leave unbalanced."""
        return loads - self.equilibrium @ scaled

    def stretched(self, displacements: FloatArray) -> FloatArray:
        """Scaled loads E u (6C, K) that displacements u (6N − 6, K) cause, node 0 being held."""
        return self.elongation @ np.concatenate([np.zeros((6, displacements.shape[1])), displacements])

    def _quickest_factor(self) -> Factor:
        """Factors of the stiffness for a single solution, by SuperLU if the frame is small or open.

        There fronts take up to four times as long, by their bookkeeping. If some of the frame moves without resistance,
        there are no factors, or the loads that drive it stay unbalanced.
        """
        try:
            if len(self.pairs) - len(self.nodes) + 1 > MOST_LOOPS_BY_SUPERLU:
                return frontal_cholesky(self.stiffness(), self.parts())
            return _by_superlu(self.stiffness())
        except (RuntimeError, ArithmeticError):  # SuperLU met a pivot of zero, or Cholesky none above it
            raise ArithmeticError(
                "the frame is singular to rounding: the stiffnesses differ by too many decades; "
                "bring them closer together"
            ) from None

    @cached_property
    def _turning(self) -> bsr_array:
        """Forces and moments (6C, 6C) in fixed axes from those in the axes of the joints."""
        count = 2 * len(self.axes)
        blocks = (np.repeat(self.axes, 2, axis=0), np.arange(count), np.arange(count + 1))
        return bsr_array(blocks, shape=(3 * count, 3 * count))


def _by_superlu(stiffness: bsr_array) -> Factor:
    rows = stiffness.tocsr()
    columns = csc_array((rows.data, rows.indices, rows.indptr), shape=rows.shape)  # the same, as it is symmetric
    # Positive definite: pivots stay on the diagonal, and a symmetric ordering halves the fill.
    options = {"SymmetricMode": True}
    return splu(columns, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options)


def _sizes(loads: FloatArray) -> FloatArray:
    """Largest load (K,) of every case of loads (n, K), or one where there is none."""
    size = np.abs(loads).max(axis=0)
    return np.where(size > 0, size, 1.0)


def spring_frame(nodes: ArrayLike, pairs: ArrayLike, points: ArrayLike, stiffness: ArrayLike) -> SpringFrame:
    """Assemble a connected frame.

    Parameters
    ----------
    nodes, pairs, points
        (N, 3) places of the nodes, (C, 2) nodes of every joint, (C, 3) points of the joints. Lengths in units of about
        a node's size, so that forces and torques compare.
    stiffness
        (C, 4) normal, tangential, bending and twisting stiffness; zero is a spring that is not there. The normal of a
        joint lies along the line of its nodes.

    Raises
    ------
    ValueError
        If a shape does not fit, a joint does not join two nodes, or a stiffness is negative.
    """
    nodes = _checks.real_array("nodes", nodes, ("N", 3))
    pairs = _joined(pairs, nodes)
    points = _checks.real_array("points", points, (len(pairs), 3))
    root = np.sqrt(_relative(stiffness, len(pairs)))[:, [0, 1, 1, 3, 2, 2]].ravel()
    axes = joint_axes(nodes, pairs)
    return SpringFrame(nodes, pairs, axes, root, side_displacements(nodes, pairs, points, axes))


def _joined(pairs: ArrayLike, nodes: FloatArray) -> IntArray:
    """The nodes (C, 2) of every joint."""
    joined = np.asarray(pairs)
    if joined.ndim != 2 or joined.shape[1] != 2 or not len(joined) or joined.dtype.kind not in "iu":
        raise ValueError(f"pairs: expected at least one joint as indices of shape (C, 2), got {pairs!r:.60}")
    joined = joined.astype(np.intp)
    bad = np.flatnonzero(((joined < 0) | (joined >= len(nodes))).any(axis=1))
    if len(bad):
        raise ValueError(f"pairs[{bad[0]}]: expected indices from 0 to {len(nodes) - 1}, got {joined[bad[0]].tolist()}")
    bad = np.flatnonzero((nodes[joined[:, 0]] == nodes[joined[:, 1]]).all(axis=1))
    if len(bad):
        raise ValueError(f"pairs[{bad[0]}]: expected nodes at two places, got {joined[bad[0]].tolist()} at one")
    return _checks.frozen(joined)


def _relative(stiffness: ArrayLike, count: int) -> FloatArray:
    """Stiffness (C, 4) over the largest."""
    given = _checks.real_array("stiffness", stiffness, (count, 4))
    bad = np.argwhere(given < 0)
    if len(bad):
        joint, spring = bad[0]
        raise ValueError(
            f"stiffness[{joint}, {spring}]: expected zero or a positive number, got {given[joint, spring]:g}"
        )
    return given / (given.max() or 1.0)
