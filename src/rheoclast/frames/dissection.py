"""Nested dissection: an order of elimination that keeps the factors of a large frame small.

A graph in space is cut in two by few nodes, a separator, each half again, and so on. Eliminating the halves before
their separator keeps them from ever meeting. George (1973) introduced it; in space n nodes then need O(n^4/3) memory
and O(n²) operations at most, and far less if the structure is open.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import breadth_first_order, maximum_bipartite_matching

from rheoclast._checks import FloatArray, IntArray

LEAF = 24  # nodes of a part that is cut no further: smaller fronts are slow to handle, larger ones fill
WINDOW = 0.1  # a plane leaves between 0.4 and 0.6 of a part on either side


def dissection(places: FloatArray, pairs: IntArray) -> IntArray:
    """Part (N,) of the nested dissection that every node belongs to, numbered as a binary heap.

    Part 1 is the separator of the whole, parts 2k and 2k + 1 lie in the two halves that part k separates. Neighbours
    belong to one part, or to one that descends from the other.

    Parameters
    ----------
    places, pairs
        (N, 3) places of the nodes, (C, 2) neighbours.
    """
    part = np.ones(len(places), dtype=np.intp)
    nodes = np.arange(len(places))
    while True:
        label, size = np.unique(part[nodes], return_inverse=True, return_counts=True)[1:]
        nodes = nodes[size[label] > LEAF]
        if not len(nodes):
            return part
        number = np.full(len(part), -1)
        number[nodes] = np.arange(len(nodes))
        edges = number[pairs]
        edges = edges[(edges >= 0).all(axis=1)]
        beyond = _halves(places[nodes], part[nodes], edges)
        cut = edges[beyond[edges[:, 0]] != beyond[edges[:, 1]]]
        inner = np.ones(len(nodes), dtype=bool)
        inner[_vertex_cover(np.where(beyond[cut[:, :1]], cut[:, ::-1], cut))] = False
        nodes = nodes[inner]
        part[nodes] = 2 * part[nodes] + beyond[inner]


def _halves(places: FloatArray, part: IntArray, edges: IntArray) -> NDArray[np.bool_]:
    """Whether a node (N,) lies beyond the plane, across x, y or z, that halves its part and cuts the fewest edges."""
    label, size = np.unique(part, return_inverse=True, return_counts=True)[1:]
    fewest = np.full(len(size), len(edges) + 1)
    beyond = np.zeros(len(part), dtype=bool)
    for height in places.T:
        order = np.lexsort((height, label))
        rank = np.empty_like(order)
        rank[order] = np.arange(len(order))
        cut, plane = _best_planes(rank[edges], size)
        better = (cut < fewest)[label]
        beyond[better] = (rank > plane[label])[better]
        fewest = np.minimum(fewest, cut)
    return beyond


def _best_planes(edges: IntArray, size: IntArray) -> tuple[IntArray, IntArray]:
    """Of nodes ranked part by part: fewest edges (P,) cut near the middle of each part, and the rank before the cut."""
    count, start = size.sum(), np.cumsum(size) - size
    first, last = (np.bincount(end, minlength=count) for end in (edges.min(axis=1), edges.max(axis=1)))
    crossing = np.cumsum(first - last)
    before = np.arange(1, count + 1) - np.repeat(start, size)
    crossing[np.abs(before / np.repeat(size, size) - 0.5) > WINDOW] = len(edges) + 1
    fewest = np.minimum.reduceat(crossing, start)
    found = np.flatnonzero(crossing == np.repeat(fewest, size))
    return fewest, found[np.searchsorted(found, start)]


def _vertex_cover(edges: IntArray) -> IntArray:
    """Fewest nodes that meet every edge (C, 2) of a bipartite graph.

    By König's theorem they follow from a largest matching: the nodes on the left that no alternating walk from a single
    node on the left reaches, and those on the right that one does.
    """
    if not len(edges):
        return np.empty(0, dtype=np.intp)
    (lefts, left), (rights, right) = (np.unique(end, return_inverse=True) for end in edges.T)
    shape = (len(lefts), len(rights))
    mate = maximum_bipartite_matching(csr_array((np.ones(len(edges)), (left, right)), shape=shape), perm_type="column")
    single, matched = np.flatnonzero(mate < 0), np.flatnonzero(mate >= 0)
    count = len(lefts) + len(rights)
    source = np.concatenate([left, len(lefts) + mate[matched], np.full(len(single), count)])
    target = np.concatenate([len(lefts) + right, matched, single])
    walks = csr_array((np.ones(len(source)), (source, target)), shape=(count + 1, count + 1))
    reached = np.zeros(count + 1, dtype=bool)
    reached[breadth_first_order(walks, count, return_predecessors=False)] = True
    return np.concatenate([lefts[~reached[: len(lefts)]], rights[reached[len(lefts) : count]]])
