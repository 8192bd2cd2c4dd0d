"""Graphs of things that are joined in pairs."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from rheoclast._checks import IntArray


def connected_parts(count: int, pairs: IntArray) -> IntArray:
    """Label (N,) of the connected part that each of `count` spheres or nodes belongs to, from pairs (C, 2)."""
    graph = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(count, count))
    return connected_components(graph, directed=False)[1].astype(np.intp)
