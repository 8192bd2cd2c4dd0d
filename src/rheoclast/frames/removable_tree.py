"""Removal of joints from a loaded tree: every joint that goes parts it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NoReturn

import numpy as np
from numpy.typing import ArrayLike

from rheoclast import _checks
from rheoclast._checks import FloatArray, IntArray
from rheoclast.frames.joints import chosen_joints, parts_without
from rheoclast.frames.removal import CollapseError
from rheoclast.frames.statics import tree_loads


@dataclass(frozen=True, eq=False)
class RemovableTree:
    """A frame without loops, in the part of `RemovableFrame`. Balance alone tells what its joints carry.

    Attributes
    ----------
    nodes, pairs, points
        (N, 3) places of the nodes, (C, 2) nodes of every joint, (C, 3) points of the joints.
    """

    nodes: FloatArray
    pairs: IntArray
    points: FloatArray

    def loaded(self, loads: ArrayLike) -> LoadedTree:
        """The tree under balanced loads (N, 6, K)."""
        cases = _checks.real_array("loads", loads, (len(self.nodes), 6, "K"))
        return LoadedTree(self, _checks.frozen(tree_loads(self.nodes, self.pairs, self.points, cases)))


@dataclass(frozen=True, eq=False)
class LoadedTree:
    """What the joints of a tree carry, in the part of `LoadedFrame`. Made by `RemovableTree.loaded`.

    Attributes
    ----------
    tree
        Nodes and joints.
    joint_loads
        (C, 6, K) force and moment that the second node of each joint exerts on the first.
    """

    tree: RemovableTree
    joint_loads: FloatArray

    @property
    def removed(self) -> IntArray:
        """Joints that were removed: none."""
        return np.empty(0, dtype=np.intp)

    @property
    def residual(self) -> float:
        """What balance leaves unbalanced: nothing."""
        return 0.0

    def without(self, joints: int | Sequence[int] | IntArray) -> NoReturn:
        """Refused: without any joint a tree is in parts.

        Raises
        ------
        CollapseError
            With the parts into which the tree falls.
        ValueError
            If a joint does not exist or is given twice.
        """
        chosen = chosen_joints(joints, len(self.tree.pairs), self.removed)
        parts = parts_without(len(self.tree.nodes), self.tree.pairs, chosen, chosen)
        raise CollapseError.into_parts(chosen, parts)
