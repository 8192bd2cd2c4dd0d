"""Statics of a tree: joint loads from balance alone, in linear time."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.sparse import csc_array, csr_array
from scipy.sparse.csgraph import breadth_first_order
from scipy.sparse.linalg import splu

from rheoclast._checks import FloatArray, IntArray
from rheoclast.vectors import cross_matrix


def tree_loads(nodes: FloatArray, pairs: IntArray, points: FloatArray, loads: FloatArray) -> FloatArray:
    """Joint loads (C, 6, K) of a tree under balanced loads (N, 6, K).

    Each joint carries everything that acts on the branch beyond it. A node hands its force, and its torque with the
    moment of that force, on to its parent; only arms between neighbours enter, so nothing is lost to rounding in a
    large aggregate.

    Parameters
    ----------
    nodes, pairs, points
        (N, 3) places of the nodes, (C, 2) nodes of every joint with C = N − 1, (C, 3) points of the joints.
    """
    parent = _parents(len(nodes), pairs)
    sums = _branch_sums(parent)
    force = sums(loads[:, :3])
    moment = sums(loads[:, 3:] + cross_matrix(nodes - nodes[parent]) @ force)  # about the centre of the parent
    first, second = pairs.T
    second_is_beyond = parent[second] == first
    child = np.where(second_is_beyond, second, first)
    sign = np.where(second_is_beyond, 1.0, -1.0)[:, None, None]
    carried = np.empty((len(pairs), *loads.shape[1:]))
    carried[:, :3] = sign * force[child]
    carried[:, 3:] = sign * moment[child] - cross_matrix(points - nodes[parent[child]]) @ carried[:, :3]
    return carried


def _parents(count: int, pairs: IntArray) -> IntArray:
    """Parent (N,) of every node on the way to node 0, which is its own."""
    both_ways = np.concatenate([pairs, pairs[:, ::-1]])
    both_ways = both_ways[np.argsort(both_ways[:, 0], kind="stable")].astype(np.int32)
    start = np.searchsorted(both_ways[:, 0], np.arange(count + 1)).astype(np.int32)
    graph = csr_array((np.ones(len(both_ways)), both_ways[:, 1].copy(), start), shape=(count, count))
    parent = breadth_first_order(graph, 0)[1].astype(np.intp)
    parent[0] = 0
    return parent


def _branch_sums(parent: IntArray) -> Callable[[FloatArray], FloatArray]:
    """Sum (N, 3, K) of values over every node and all beyond it: s = x + Σ s(children).

    As linear equations with ±1 for every node and its parent: eliminated from the leaves they have no fill.
    """
    count = len(parent)
    rows = np.stack([parent, np.arange(count)], axis=1)[1:].ravel()
    rows = np.concatenate([[0], rows]).astype(np.int32)
    values = np.tile([1.0, -1.0], count)[:-1]
    start = np.maximum(2 * np.arange(count + 1) - 1, 0).astype(np.int32)
    equations = csc_array((values, rows, start), shape=(count, count))
    factor = splu(equations, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    return lambda values: factor.solve(values.reshape(count, -1)).reshape(values.shape)
