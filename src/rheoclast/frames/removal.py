"""Removal of joints from a loaded spring frame: the joint loads after each, without solving anew.

Some dozens of removals in sequence share one factorization (`updates` has the algebra). It is renewed when they are
used up, when the frame hardly holds without a joint, or when the loads no longer balance.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import bsr_array

from rheoclast import _checks
from rheoclast._checks import FloatArray, IntArray
from rheoclast._threads import one_blas_thread
from rheoclast.frames.dissection import dissection
from rheoclast.frames.equilibrium import equilibrium_matrix
from rheoclast.frames.mechanisms import moving_parts
from rheoclast.frames.springs import joint_stiffness
from rheoclast.frames.updates import FactorizedFrame, Removal, factorized_frame
from rheoclast.graphs import connected_parts

UNBALANCED = 1e-10
MOST_REFINEMENTS = 3
BALANCED = 1e-6


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


@dataclass(frozen=True, eq=False)
class RemovableFrame:
    """A frame whose joints can be removed. Made by `removable_frame`.

    Attributes
    ----------
    pairs
        (C, 2) nodes of every joint.
    root
        (6C, 6C) root of the joints' stiffness.
    sides
        (6C, 6N) relative displacement of the joints' sides, with opposite sign, from the displacements of the nodes.
    elongation
        (6C, 6N) the relative displacement times that root.
    part
        (N − 1,) parts of the nested dissection of all nodes but node 0, which is held.
    factorized
        Factors of the frame with all joints.
    """

    pairs: IntArray
    root: bsr_array
    sides: bsr_array
    elongation: bsr_array
    part: IntArray
    factorized: FactorizedFrame

    def loaded(self, loads: ArrayLike) -> LoadedFrame:
        """The frame with all joints under balanced loads (N, 6, K).

        Raises
        ------
        ValueError
            If the loads have another shape, or do not balance.
        ArithmeticError
            If the joints do not balance the loads because the stiffnesses differ by too many decades.
        """
        cases = _checks.real_array("loads", loads, (self.elongation.shape[1] // 6, 6, "K"))
        state = _solved(self, self.factorized, cases, np.empty(0, dtype=np.intp))
        _refuse_resultant(state)
        return state


@dataclass(frozen=True, eq=False)
class LoadedFrame:
    """What the joints of a frame carry after some were removed. Made by `RemovableFrame.loaded` and `without`.

    Attributes
    ----------
    frame
        The frame with all joints.
    loads
        (N, 6, K) loads on the nodes.
    removed
        (R,) joints that were removed, in that order.
    joint_loads
        (C, 6, K) force and moment that the second node of each joint exerts on the first; zero where it was removed.
    residual
        Largest force or torque that is left unbalanced on a node, over the largest load of the case. Node 0, which
        would show what the loads themselves lack, does not count.
    """

    frame: RemovableFrame
    loads: FloatArray
    removed: IntArray
    joint_loads: FloatArray
    residual: float
    _factorized: FactorizedFrame
    _carried: FloatArray
    _removal: Removal

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
        chosen = chosen_joints(joints, len(self.frame.pairs), self.removed)
        removed = np.concatenate([self.removed, chosen])
        refuse_parts(len(self.loads), self.frame.pairs, removed, chosen)
        with one_blas_thread():
            removal = self._factorized.extended(self._removal, chosen)
            if removal is not None:
                state = self._updated(removal, removed)
                if state.residual <= UNBALANCED:
                    return state
        return _solved_anew(self.frame, self.loads, removed, chosen)

    def _updated(self, removal: Removal, removed: IntArray) -> LoadedFrame:
        """The state after a removal from the factorized frame; not in balance if the factors are used up."""
        factorized, carried = self._factorized, self._carried
        scaled = factorized.scaled_loads(carried, removal)
        state = _state(self.frame, factorized, self.loads, removed, carried, removal, scaled)
        for _ in range(MOST_REFINEMENTS):
            if state.residual <= UNBALANCED:
                break
            scaled = factorized.refined_loads(scaled, _left_over(factorized, self.loads, scaled), removal)
            state = _state(self.frame, factorized, self.loads, removed, carried, removal, scaled)
        return state


def removable_frame(nodes: ArrayLike, pairs: ArrayLike, points: ArrayLike, stiffness: ArrayLike) -> RemovableFrame:
    """Assemble and factorize a connected frame from which joints are to be removed.

    Parameters
    ----------
    nodes, pairs, points
        (N, 3) places of the nodes, (C, 2) nodes of every joint, (C, 3) points of the joints. Lengths in units of about
        a node's size, so that forces and torques compare.
    stiffness
        (C, 4) normal, tangential, bending and twisting stiffness; zero is a spring that is not there. The normal of a
        joint points from its first node to its second.

    Raises
    ------
    ValueError
        If a shape does not fit, a joint does not join two nodes, or a stiffness is negative.
    CollapseError
        If the frame is in parts, or moves without resistance.
    """
    nodes = _checks.real_array("nodes", nodes, ("N", 3))
    pairs, normals = _joined(pairs, nodes)
    points = _checks.real_array("points", points, (len(pairs), 3))
    root = joint_stiffness(normals, np.sqrt(_relative(stiffness, len(pairs))))
    parts = connected_parts(len(nodes), pairs)
    if parts.any():
        raise CollapseError(f"expected a connected frame, got {parts.max() + 1} parts; load each by itself", parts)
    sides = equilibrium_matrix(nodes, pairs, points).T
    blocks = -root.data[:, None] @ sides.data.reshape(-1, 2, 6, 6)
    elongation = bsr_array((blocks.reshape(-1, 6, 6), sides.indices, sides.indptr), shape=sides.shape)
    part, intact = dissection(nodes[1:], pairs[(pairs > 0).all(axis=1)] - 1), np.empty(0, dtype=np.intp)
    try:
        factorized = factorized_frame(elongation, part, intact)
    except ArithmeticError:
        raise CollapseError(
            "with all its joints the frame moves without resistance; give every node joints that hold it",
            moving_parts(pairs, sides, elongation, intact),
        ) from None
    return RemovableFrame(pairs, root, sides, elongation, part, factorized)


def _state(
    frame: RemovableFrame,
    factorized: FactorizedFrame,
    loads: FloatArray,
    removed: IntArray,
    carried: FloatArray,
    removal: Removal,
    scaled: FloatArray,
) -> LoadedFrame:
    """The state in which the springs of a frame carry known scaled loads."""
    joint_loads = _checks.frozen((frame.root @ scaled).reshape(-1, 6, loads.shape[-1]))
    residual = _residual(_left_over(factorized, loads, scaled), loads)
    return LoadedFrame(frame, loads, _checks.frozen(removed), joint_loads, residual, factorized, carried, removal)


def _solved(frame: RemovableFrame, factorized: FactorizedFrame, loads: FloatArray, removed: IntArray) -> LoadedFrame:
    carried = factorized.springs.joint_loads(loads).reshape(-1, loads.shape[-1])
    return _state(frame, factorized, loads, removed, carried, factorized.intact(), carried)


def _solved_anew(frame: RemovableFrame, loads: FloatArray, removed: IntArray, chosen: IntArray) -> LoadedFrame:
    """The state after a removal from new factors of the remaining joints, which are connected."""
    try:
        factorized = factorized_frame(frame.elongation, frame.part, removed)
    except ArithmeticError:
        raise CollapseError(
            f"without {named(chosen)} the frame holds together but moves without resistance",
            moving_parts(frame.pairs, frame.sides, frame.elongation, removed),
        ) from None
    return _solved(frame, factorized, loads, removed)


def _left_over(factorized: FactorizedFrame, loads: FloatArray, scaled: FloatArray) -> FloatArray:
    """Force and torque (6N, K) that the joints leave unbalanced."""
    return loads.reshape(-1, loads.shape[-1]) + factorized.springs.equilibrium @ scaled


def _residual(unbalanced: FloatArray, loads: FloatArray) -> float:
    """Largest component (6N, K) left unbalanced on any node but node 0, over the largest load of its case."""
    size = np.abs(loads).max(axis=(0, 1))
    return float(np.max(np.abs(unbalanced[6:]).max(axis=0) / np.where(size > 0, size, 1.0), initial=0.0))


def _refuse_resultant(state: LoadedFrame) -> None:
    """Refuse loads whose resultant would have to be taken by the node that is held."""
    lacking = np.abs(_left_over(state._factorized, state.loads, state._carried)[:6]).max(axis=0)
    largest = np.maximum(np.abs(state.loads).max(axis=(0, 1)), np.abs(state.joint_loads).max(axis=(0, 1)))
    bad = np.flatnonzero(lacking > BALANCED * largest)
    if len(bad):
        raise ValueError(
            f"loads of case {bad[0]}: expected totals of zero, got a force or torque of {lacking[bad[0]]:.3g} "
            f"where joints carry up to {largest[bad[0]]:.3g}; use the loads of a free body"
        )


def refuse_parts(count: int, pairs: IntArray, removed: IntArray, chosen: IntArray) -> None:
    """Refuse a removal of chosen joints that leaves `count` nodes, joined in pairs (C, 2) but those removed, in parts.

    Raises
    ------
    CollapseError
        With the parts.
    """
    left = np.delete(pairs, removed, axis=0)
    if len(chosen) == 1 and _have_common_neighbour(left, *pairs[chosen[0]]):
        return  # as in most removals from a packing; it spares the search of the graph
    parts = connected_parts(count, left)
    if parts.any():
        sizes = ", ".join(map(str, np.bincount(parts)))
        raise CollapseError(f"without {named(chosen)} the frame falls into parts of {sizes} nodes", parts)


def _have_common_neighbour(pairs: IntArray, first: int, second: int) -> bool:
    """Whether some node is joined with both of two nodes."""
    near_first, near_second = (pairs[(pairs == node).any(axis=1)].sum(axis=1) - node for node in (first, second))
    return bool(np.isin(near_first, near_second).any())


def named(joints: IntArray) -> str:
    """Joints as an error message calls them."""
    shown = ", ".join(map(str, joints[:5])) + (", …" if len(joints) > 5 else "")
    return f"joint{'s' if len(joints) > 1 else ''} {shown}"


def chosen_joints(joints: int | Sequence[int] | IntArray, count: int, removed: IntArray) -> IntArray:
    """The joints (R,) that a caller wants to remove, if that is possible."""
    chosen = np.atleast_1d(np.asarray(joints))
    if chosen.ndim != 1 or chosen.dtype.kind not in "iu" or not len(chosen):
        raise ValueError(f"joints: expected an index or a sequence of indices of joints, got {joints!r:.60}")
    chosen = chosen.astype(np.intp)
    outside = chosen[(chosen < 0) | (chosen >= count)]
    if len(outside):
        raise ValueError(f"joints: expected indices from 0 to {count - 1}, got {outside[0]}")
    gone = chosen[np.isin(chosen, removed)]
    if len(gone):
        raise ValueError(f"joints: joint {gone[0]} was removed before; choose among those that remain")
    found, times = np.unique(chosen, return_counts=True)
    if (times > 1).any():
        raise ValueError(f"joints: joint {found[times.argmax()]} is given {times.max()} times; give each once")
    return chosen


def _joined(pairs: ArrayLike, nodes: FloatArray) -> tuple[IntArray, FloatArray]:
    """The nodes (C, 2) of every joint and its normal (C, 3), from the first to the second."""
    joined = np.asarray(pairs)
    if joined.ndim != 2 or joined.shape[1] != 2 or not len(joined) or joined.dtype.kind not in "iu":
        raise ValueError(f"pairs: expected at least one joint as indices of shape (C, 2), got {pairs!r:.60}")
    joined = joined.astype(np.intp)
    bad = np.flatnonzero(((joined < 0) | (joined >= len(nodes))).any(axis=1))
    if len(bad):
        raise ValueError(f"pairs[{bad[0]}]: expected indices from 0 to {len(nodes) - 1}, got {joined[bad[0]].tolist()}")
    between = nodes[joined[:, 1]] - nodes[joined[:, 0]]
    length = np.linalg.norm(between, axis=1, keepdims=True)
    bad = np.flatnonzero(length == 0)
    if len(bad):
        raise ValueError(f"pairs[{bad[0]}]: expected nodes at two places, got {joined[bad[0]].tolist()} at one")
    return _checks.frozen(joined), between / length


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
