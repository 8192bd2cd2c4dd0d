"""Joints chosen for removal: whether they are there, and what is left without them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rheoclast._checks import IntArray
from rheoclast.graphs import connected_parts


def chosen_joints(joints: int | Sequence[int] | IntArray, count: int, removed: IntArray) -> IntArray:
    """The joints (R,) that a caller wants to remove from a frame of `count`, if that is possible.

    Raises
    ------
    ValueError
        If a joint does not exist, was removed before, or is given twice.
    """
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


def parts_without(count: int, pairs: IntArray, removed: IntArray, chosen: IntArray) -> IntArray:
    """Part (N,) of each of `count` nodes joined in pairs (C, 2), but not by those removed, some of them chosen now."""
    left = np.delete(pairs, removed, axis=0)
    if len(chosen) == 1 and _have_common_neighbour(left, *pairs[chosen[0]]):
        return np.zeros(count, dtype=np.intp)  # as in most removals from a packing; it spares the search of the graph
    return connected_parts(count, left)


def named(joints: IntArray) -> str:
    """Joints as an error message calls them."""
    shown = ", ".join(map(str, joints[:5])) + (", …" if len(joints) > 5 else "")
    return f"joint{'s' if len(joints) > 1 else ''} {shown}"


def _have_common_neighbour(pairs: IntArray, first: int, second: int) -> bool:
    """Whether some node is joined with both of two nodes."""
    near_first, near_second = (pairs[(pairs == node).any(axis=1)].sum(axis=1) - node for node in (first, second))
    return bool(np.isin(near_first, near_second).any())
