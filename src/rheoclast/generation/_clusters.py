"""Rigid clusters of spheres in a tree of bounding balls: distance, first touch and union, compiled by Numba.

Each ball encloses a run of spheres and is split in halves along the longest side of its box. Two clusters are compared
by descending both trees together, past every pair of balls that cannot hold the answer: S. Quinlan, Proc. IEEE Int.
Conf. Robotics and Automation (1994) 3324. The second cluster is placed by a rigid motion x ↦ R x + t.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numba import njit

from rheoclast._checks import FloatArray, IntArray

SPHERES_IN_A_LEAF = 6
ROUNDING = 1e-11
"""Overlap, in radii of a typical sphere, that counts as touching."""


class Cluster(NamedTuple):
    """Spheres (centre of mass at the origin, neighbours close in the list) and their tree of bounding balls.

    Ball m encloses the spheres `first[m]` to `last[m] − 1`; its halves are balls 2 m + 1 and 2 m + 2.
    """

    centers: FloatArray
    radii: FloatArray
    ball_centers: FloatArray
    ball_radii: FloatArray
    first: IntArray
    last: IntArray


@njit(cache=True)
def cluster(centers: FloatArray, radii: FloatArray) -> Cluster:
    """Cluster of spheres at (N, 3) with radii (N,), moved to its centre of mass."""
    count = radii.size
    volumes = radii**3
    centers = centers - volumes @ centers / volumes.sum()
    order = np.arange(count)
    levels = 1
    while count > SPHERES_IN_A_LEAF << (levels - 1):
        levels += 1
    balls = (1 << levels) - 1
    ball_centers, ball_radii = np.empty((balls, 3)), np.empty(balls)
    first, last = np.empty(balls, np.int64), np.empty(balls, np.int64)
    for m in range(balls):
        first[m], last[m] = _run(m, first, last, count)
        run = order[first[m] : last[m]]
        box = _box(centers, radii, run)
        run[:] = run[np.argsort(centers[run, np.argmax(box[1] - box[0])])]
        ball_centers[m] = 0.5 * (box[0] + box[1])
        ball_radii[m] = _enclosing_radius(ball_centers[m], centers, radii, run)
    return Cluster(centers[order], radii[order], ball_centers, ball_radii, first, last)


@njit(cache=True)
def _run(m: int, first: IntArray, last: IntArray, count: int) -> tuple[int, int]:
    """Spheres of ball m: all, or the lower or upper half of the ball above."""
    if m == 0:
        return 0, count
    above = (m - 1) // 2
    middle = (first[above] + last[above]) // 2
    return (first[above], middle) if m % 2 else (middle, last[above])


@njit(cache=True)
def _box(centers: FloatArray, radii: FloatArray, run: IntArray) -> FloatArray:
    box = np.empty((2, 3))
    box[0], box[1] = np.inf, -np.inf
    for i in run:
        for axis in range(3):
            box[0, axis] = min(box[0, axis], centers[i, axis] - radii[i])
            box[1, axis] = max(box[1, axis], centers[i, axis] + radii[i])
    return box


@njit(cache=True)
def _enclosing_radius(middle: FloatArray, centers: FloatArray, radii: FloatArray, run: IntArray) -> float:
    reach = 0.0
    for i in run:
        offset = centers[i] - middle
        reach = max(reach, np.sqrt(np.dot(offset, offset)) + radii[i])
    return reach


@njit(cache=True)
def union(fixed: Cluster, moved: Cluster, rotation: FloatArray, shift: FloatArray) -> Cluster:
    """Cluster of the spheres of both, the second placed by its rigid motion."""
    placed = moved.centers @ rotation.T + shift
    return cluster(np.concatenate((fixed.centers, placed)), np.concatenate((fixed.radii, moved.radii)))


@njit(cache=True)
def extent(one: Cluster) -> float:
    """Largest distance of a surface from the centre of mass."""
    return (np.sqrt((one.centers**2).sum(axis=1)) + one.radii).max()


@njit(cache=True, inline="always")
def _offset(
    fixed: FloatArray, i: int, moved: FloatArray, j: int, rotation: FloatArray, shift: FloatArray
) -> tuple[float, float, float]:
    """Vector from point i of the fixed cluster to the placed point j of the other."""
    x, y, z = moved[j]
    return (
        rotation[0, 0] * x + rotation[0, 1] * y + rotation[0, 2] * z + shift[0] - fixed[i, 0],
        rotation[1, 0] * x + rotation[1, 1] * y + rotation[1, 2] * z + shift[1] - fixed[i, 1],
        rotation[2, 0] * x + rotation[2, 1] * y + rotation[2, 2] * z + shift[2] - fixed[i, 2],
    )


@njit(cache=True)
def _descend(stack: IntArray, top: int, fixed: Cluster, m: int, moved: Cluster, k: int) -> int:
    """Put the halves of the larger of two balls on the stack, each with the other ball; its new height."""
    fixed_is_leaf, moved_is_leaf = 2 * m + 1 >= fixed.first.size, 2 * k + 1 >= moved.first.size
    split_fixed = moved_is_leaf or (not fixed_is_leaf and fixed.ball_radii[m] > moved.ball_radii[k])
    for half in (1, 2):
        stack[top, 0] = 2 * m + half if split_fixed else m
        stack[top, 1] = k if split_fixed else 2 * k + half
        top += 1
    return top


@njit(cache=True)
def smallest_gap(
    fixed: Cluster, moved: Cluster, rotation: FloatArray, shift: FloatArray, upper: float, lower: float
) -> float:
    """Smallest distance between surfaces of two clusters, negative where they overlap.

    The search looks for gaps below `upper`, which is returned if there is none, and ends at the first one that does
    not exceed `lower`.
    """
    best = upper
    stack = np.empty((64, 2), np.int64)
    stack[0] = 0
    top = 1
    while top > 0 and best > lower:
        top -= 1
        m, k = stack[top]
        x, y, z = _offset(fixed.ball_centers, m, moved.ball_centers, k, rotation, shift)
        reach = best + fixed.ball_radii[m] + moved.ball_radii[k]
        if reach <= 0 or x * x + y * y + z * z >= reach * reach:
            continue
        if 2 * m + 1 < fixed.first.size or 2 * k + 1 < moved.first.size:
            top = _descend(stack, top, fixed, m, moved, k)
            continue
        for j in range(moved.first[k], moved.last[k]):
            for i in range(fixed.first[m], fixed.last[m]):
                x, y, z = _offset(fixed.centers, i, moved.centers, j, rotation, shift)
                best = min(best, np.sqrt(x * x + y * y + z * z) - fixed.radii[i] - moved.radii[j])
    return best


@njit(cache=True)
def overlap(fixed: Cluster, moved: Cluster, rotation: FloatArray, shift: FloatArray) -> bool:
    """Whether two clusters overlap by more than rounding."""
    return smallest_gap(fixed, moved, rotation, shift, -ROUNDING, -2 * ROUNDING) < -ROUNDING


@njit(cache=True)
def travel_to_touch(
    fixed: Cluster, moved: Cluster, rotation: FloatArray, shift: FloatArray, direction: FloatArray
) -> float:
    """Distance that the second cluster goes along a unit vector until it first touches the first; inf if it passes.

    The clusters do not overlap at the start. The travel at which two balls touch bounds that of all they enclose.
    """
    best = np.inf
    stack = np.empty((64, 2), np.int64)
    stack[0] = 0
    top = 1
    while top > 0:
        top -= 1
        m, k = stack[top]
        offset = _offset(fixed.ball_centers, m, moved.ball_centers, k, rotation, shift)
        start, end = _passage(offset, direction, fixed.ball_radii[m] + moved.ball_radii[k])
        if end < 0 or start >= best:
            continue
        if 2 * m + 1 < fixed.first.size or 2 * k + 1 < moved.first.size:
            top = _descend(stack, top, fixed, m, moved, k)
            continue
        for j in range(moved.first[k], moved.last[k]):
            for i in range(fixed.first[m], fixed.last[m]):
                offset = _offset(fixed.centers, i, moved.centers, j, rotation, shift)
                start, end = _passage(offset, direction, fixed.radii[i] + moved.radii[j])
                # Touching spheres that part have start + end < 0, however their gap is rounded.
                if start + end >= 0:
                    best = min(best, start)
    return best


@njit(cache=True, inline="always")
def _passage(offset: tuple[float, float, float], direction: FloatArray, reach: float) -> tuple[float, float]:
    """Travels along a unit vector between which a point is nearer to the origin than `reach`; (inf, inf) if never."""
    x, y, z = offset
    ahead = -(x * direction[0] + y * direction[1] + z * direction[2])
    half2 = reach * reach - (x * x + y * y + z * z - ahead * ahead)
    if half2 <= 0:
        return np.inf, np.inf
    half = np.sqrt(half2)
    return ahead - half, ahead + half
