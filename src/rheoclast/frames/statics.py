"""Statics of a tree: joint loads from balance alone, in linear time."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import breadth_first_order

from rheoclast._checks import FloatArray, IntArray


def tree_loads(nodes: FloatArray, pairs: IntArray, points: FloatArray, loads: FloatArray) -> FloatArray:
    """Joint loads (C, 6, K) of a tree under balanced loads (N, 6, K).

    Each joint carries everything that acts on the branch beyond it. Force and torque about one common point are added
    up from the leaves to the root, then moved to the point of the joint.

    Parameters
    ----------
    nodes, pairs, points
        (N, 3) places of the nodes, (C, 2) nodes of every joint with C = N − 1, (C, 3) points of the joints.
    """
    order, parent = _from_the_root(len(nodes), pairs)
    branch = loads.copy()
    branch[:, 3:] += np.cross(nodes[:, :, None], loads[:, :3], axis=1)
    for node in order[:0:-1]:
        branch[parent[node]] += branch[node]
    first, second = pairs.T
    second_is_beyond = parent[second] == first
    beyond = branch[np.where(second_is_beyond, second, first)]
    carried = np.where(second_is_beyond, 1.0, -1.0)[:, None, None] * beyond
    carried[:, 3:] -= np.cross(points[:, :, None], carried[:, :3], axis=1)
    return carried


def _from_the_root(count: int, pairs: IntArray) -> tuple[IntArray, IntArray]:
    """Nodes in breadth-first order from node 0, and the parent of every node (negative for the root)."""
    graph = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(count, count)).tocsr()
    order, parent = breadth_first_order(graph, 0, directed=False)
    return order.astype(np.intp), parent.astype(np.intp)
