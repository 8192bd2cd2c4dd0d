"""Removal of joints from a loaded spring frame: the joint loads after each, without solving anew.

Some dozens of removals in sequence share one factorization (`updates` has the algebra). It is renewed when they are
used up, when the frame hardly holds without a joint, or when the loads no longer balance.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from rheoclast import _checks
from rheoclast._checks import FloatArray, IntArray
from rheoclast._threads import one_blas_thread
from rheoclast.frames.joints import chosen_joints, named, parts_without
from rheoclast.frames.mechanisms import moving_parts
from rheoclast.frames.springs import SpringFrame, spring_frame
from rheoclast.frames.updates import FactorizedFrame, Removal, factorized_frame
from rheoclast.graphs import connected_parts

NEAR_BALANCE = 1e-10  # of the largest load: what updates reach without refinement in most frames
LARGEST_RESULTANT = 1e-6  # of the largest load or joint load; less may come from loads that were rounded


class CollapseError(ArithmeticError):
    """A frame falls into parts, or holds together but moves without resistance.

    Attributes
    ----------
    parts
        (N,) part that each node belongs to: connected parts, or in the second case those that move against each other.
    """

    def __init__(self, message: str, parts: IntArray) -> None:
        super().__init__(message)
        self.parts = parts

    @classmethod
    def into_parts(cls, joints: IntArray, parts: IntArray) -> CollapseError:
        """The error that without some joints the frame falls into parts (N,)."""
        sizes = ", ".join(map(str, np.bincount(parts)))
        return cls(f"without {named(joints)} the frame falls into parts of {sizes} nodes", parts)


@dataclass(frozen=True, eq=False)
class RemovableFrame:
    """A frame whose joints can be removed. Made by `removable_frame`.

    Attributes
    ----------
    factorized
        The frame with all joints, and its factors.
    part
        (N − 1,) parts of the nested dissection of all nodes but node 0, which is held.
    """

    factorized: FactorizedFrame
    part: IntArray

    @property
    def springs(self) -> SpringFrame:
        """The frame with all joints."""
        return self.factorized.springs

    def loaded(self, loads: ArrayLike) -> LoadedFrame:
        """The frame with all joints under balanced loads (N, 6, K).

        Raises
        ------
        ValueError
            If the loads have another shape, or do not balance.
        ArithmeticError
            If the joints do not balance the loads because the stiffnesses differ by too many decades.
        """
        cases = _checks.real_array("loads", loads, (len(self.springs.nodes), 6, "K"))
        nothing = _checks.frozen(np.empty(0, dtype=np.intp))
        state = _solved(self, self.factorized, cases.reshape(-1, cases.shape[2]), nothing)
        _refuse_resultant(state)
        return state


@dataclass(frozen=True, eq=False)
class LoadedFrame:
    """What the joints of a frame carry after some were removed. Made by `RemovableFrame.loaded` and `without`.

    Attributes
    ----------
    frame
        The frame with all joints.
    removed
        (R,) joints that were removed, in that order.
    residual
        Largest force or torque that is left unbalanced on a node, over the largest load of the case. Node 0, which
        would show what the loads themselves lack, does not count.
    """

    frame: RemovableFrame
    removed: IntArray
    residual: float
    _solution: _Solution
    _removal: Removal
    _scaled: FloatArray

    @property
    def loads(self) -> FloatArray:
        """Loads (N, 6, K) on the nodes."""
        return self._solution.loads.reshape(-1, 6, self._scaled.shape[1])

    @cached_property
    def joint_loads(self) -> FloatArray:
        """Force and moment (C, 6, K) that the second node of each joint exerts on the first; zero where removed."""
        return _checks.frozen(self._solution.factorized.springs.from_scaled(self._scaled))

    def without(self, joints: int | Sequence[int] | IntArray) -> LoadedFrame:
        """The same loads after one joint more, or several at once, were removed.

        Parameters
        ----------
        joints
            Index or indices of joints that are still there.

        Raises
        ------
        CollapseError
            If the frame then falls into parts, or moves without resistance.
        ArithmeticError
            If it becomes so slender (thousands of nodes in line) that balance is not reached.
        ValueError
            If a joint does not exist, was removed before, or is given twice.
        """
        springs = self.frame.springs
        chosen = chosen_joints(joints, len(springs.pairs), self.removed)
        removed = _checks.frozen(np.concatenate([self.removed, chosen]))
        parts = parts_without(len(springs.nodes), springs.pairs, removed, chosen)
        if parts.any():
            raise CollapseError.into_parts(chosen, parts)
        return self._updated(chosen, removed) or _solved_anew(self.frame, self._solution.loads, removed, chosen)

    def _updated(self, chosen: IntArray, removed: IntArray) -> LoadedFrame | None:
        """The state after a removal from the factorized frame, or None if its factors are used up."""
        solution = self._solution
        with one_blas_thread():
            removal = solution.factorized.extended(self._removal, chosen)
            if removal is None:
                return None
            scaled, residual = solution.after(removal)
        if residual <= NEAR_BALANCE:
            return LoadedFrame(self.frame, removed, residual, solution, removal, scaled)
        return None


@dataclass(frozen=True, eq=False)
class _Solution:
    """A factorized frame, loads (6N, K) on it, and the scaled loads (6C, K) of its springs."""

    factorized: FactorizedFrame
    loads: FloatArray
    scaled: FloatArray

    def after(self, removal: Removal) -> tuple[FloatArray, float]:
        """Scaled loads (6C, K) after a removal, near balance if the factors serve, and the largest imbalance."""
        factorized = self.factorized
        scaled, left = factorized.springs.balanced(
            factorized.shared(self.scaled, removal),
            self.loads,
            lambda lacking: factorized.correction(lacking, removal),
            NEAR_BALANCE,
        )
        return scaled, float(left.max(initial=0.0))


def removable_frame(nodes: ArrayLike, pairs: ArrayLike, points: ArrayLike, stiffness: ArrayLike) -> RemovableFrame:
    """Assemble and factorize a connected frame from which joints are to be removed.

    Parameters are those of `spring_frame`.

    Raises
    ------
    ValueError
        As `spring_frame`.
    CollapseError
        If the frame is in parts, or moves without resistance.
    """
    springs = spring_frame(nodes, pairs, points, stiffness)
    parts = connected_parts(len(springs.nodes), springs.pairs)
    if parts.any():
        raise CollapseError(f"expected a connected frame, got {parts.max() + 1} parts; load each by itself", parts)
    part = springs.parts()
    try:
        return RemovableFrame(factorized_frame(springs, part), part)
    except ArithmeticError:
        message = "with all its joints the frame moves without resistance; give every node joints that hold it"
        raise CollapseError(message, moving_parts(springs)) from None


def _solved(frame: RemovableFrame, factorized: FactorizedFrame, loads: FloatArray, removed: IntArray) -> LoadedFrame:
    """The state in which the springs of a frame carry what its own factors give."""
    scaled, left = factorized.springs.solution(factorized.factor, loads)
    solution = _Solution(factorized, loads, scaled)
    return LoadedFrame(frame, removed, float(left.max(initial=0.0)), solution, factorized.intact(), scaled)


def _solved_anew(frame: RemovableFrame, loads: FloatArray, removed: IntArray, chosen: IntArray) -> LoadedFrame:
    """The state after a removal from new factors of the remaining joints, which are connected."""
    springs = frame.springs.without(removed)
    try:
        factorized = factorized_frame(springs, frame.part)
    except ArithmeticError:
        message = f"without {named(chosen)} the frame holds together but moves without resistance"
        raise CollapseError(message, moving_parts(springs)) from None
    return _solved(frame, factorized, loads, removed)


def _refuse_resultant(state: LoadedFrame) -> None:
    """Refuse loads whose resultant would have to be taken by the node that is held."""
    loads = state._solution.loads
    lacking = np.abs(state.frame.springs.lacking(state._scaled, loads)[:6]).max(axis=0)
    largest = np.maximum(np.abs(loads).max(axis=0), np.abs(state.joint_loads).max(axis=(0, 1)))
    bad = np.flatnonzero(lacking > LARGEST_RESULTANT * largest)
    if len(bad):
        raise ValueError(
            f"loads of case {bad[0]}: expected totals of zero, got a force or torque of {lacking[bad[0]]:.3g} "
            f"where joints carry up to {largest[bad[0]]:.3g}; use the loads of a free body"
        )
