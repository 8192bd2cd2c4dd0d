"""Spheres of a growing cluster in a hash table of cubic cells of many sizes, compiled by Numba.

Cells of the finest level list the spheres whose centres they hold; those of level k, with edges 2^k times as long, only
tell that they are not empty, so that a walker far from the cluster sees at once how far it may go: R. C. Ball and
R. M. Brady, J. Phys. A 18 (1985) L809; S. Tolman and P. Meakin, Phys. Rev. A 40 (1989) 428.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numba import njit

from rheoclast._checks import FloatArray, IntArray

LEVELS = 16
BITS = 19
"""Of a coordinate in a key: 2¹⁹ of the finest cells along each axis, about the origin."""
EMPTY = -1


class Cells(NamedTuple):
    """Spheres 0 to `placed[0]` − 1 of those given, in a hash table with open addressing.

    Slot s holds the cell `keys[s]`; its spheres are `head[s]`, then each the `following` of the one before.
    """

    centers: FloatArray
    radii: FloatArray
    placed: IntArray
    edge: float
    largest: float
    keys: IntArray
    head: IntArray
    following: IntArray


@njit(cache=True)
def cells(radii: FloatArray) -> Cells:
    """Room for spheres with radii (N,), without any; no cell is smaller than three of the largest radii."""
    # The eight octants share no cell at any level; a connected cluster has half as many cells, or fewer, at the next.
    slots = 4 * 8 * LEVELS
    while slots < 8 * radii.size:
        slots *= 2
    return Cells(
        np.empty((radii.size, 3)),
        radii,
        np.zeros(1, np.int64),
        3 * radii.max(),
        radii.max(),
        np.full(slots, EMPTY),
        np.full(slots, EMPTY),
        np.full(radii.size, EMPTY),
    )


@njit(cache=True)
def add(grid: Cells, center: FloatArray) -> None:
    """Put the next sphere at (3,)."""
    sphere = grid.placed[0]
    grid.placed[0] += 1
    grid.centers[sphere] = center
    for level in range(LEVELS):
        x, y, z = _cell(grid, center, level)
        slot = _slot(grid, _key(level, x, y, z))
        if level == 0:
            grid.following[sphere] = grid.head[slot]
            grid.head[slot] = sphere
        elif grid.keys[slot] != EMPTY:
            break
        grid.keys[slot] = _key(level, x, y, z)


@njit(cache=True, inline="always")
def _cell(grid: Cells, point: FloatArray, level: int) -> tuple[int, int, int]:
    edge = grid.edge * (1 << level)
    return int(np.floor(point[0] / edge)), int(np.floor(point[1] / edge)), int(np.floor(point[2] / edge))


@njit(cache=True, inline="always")
def _key(level: int, x: int, y: int, z: int) -> int:
    middle = 1 << (BITS - 1)
    return (((level << BITS) + x + middle << BITS) + y + middle << BITS) + z + middle


@njit(cache=True, inline="always")
def _slot(grid: Cells, key: int) -> int:
    """Where a cell is in the table, or would be."""
    mask = grid.keys.size - 1
    mixed = key ^ (key >> 29)
    mixed = mixed * 0x1B873593 + (mixed >> 17)
    slot = (mixed ^ (mixed >> 15)) & mask
    while grid.keys[slot] != EMPTY and grid.keys[slot] != key:
        slot = (slot + 1) & mask
    return slot


@njit(cache=True)
def near(grid: Cells, point: FloatArray, distance: float, found: IntArray) -> int:
    """Number of spheres whose centres are within a distance of (3,); their indices are put into `found` (N,)."""
    count = 0
    x0, y0, z0 = _cell(grid, point - distance, 0)
    x1, y1, z1 = _cell(grid, point + distance, 0)
    for x in range(x0, x1 + 1):
        for y in range(y0, y1 + 1):
            for z in range(z0, z1 + 1):
                sphere = grid.head[_slot(grid, _key(0, x, y, z))]
                while sphere != EMPTY:
                    if _distance(grid, sphere, point) <= distance:
                        found[count] = sphere
                        count += 1
                    sphere = grid.following[sphere]
    return count


@njit(cache=True, inline="always")
def _distance(grid: Cells, sphere: int, point: FloatArray) -> float:
    x, y, z = grid.centers[sphere]
    return np.sqrt((x - point[0]) ** 2 + (y - point[1]) ** 2 + (z - point[2]) ** 2)


@njit(cache=True)
def clearance(grid: Cells, point: FloatArray) -> float:
    """Distance of (3,) from the nearest surface, exact where that is below one radius, else a lower bound."""
    level = 0
    while level < LEVELS and _alone(grid, point, level):
        level += 1
    if level > 0:
        return grid.edge * (1 << (level - 1)) - grid.largest
    nearest = grid.edge - grid.largest
    x, y, z = _cell(grid, point, 0)
    for cell in range(27):
        sphere = grid.head[_slot(grid, _key(0, x + cell // 9 - 1, y + cell // 3 % 3 - 1, z + cell % 3 - 1))]
        while sphere != EMPTY:
            nearest = min(nearest, _distance(grid, sphere, point) - grid.radii[sphere])
            sphere = grid.following[sphere]
    return nearest


@njit(cache=True)
def _alone(grid: Cells, point: FloatArray, level: int) -> bool:
    """Whether the cell of a point and the 26 around it are empty."""
    x, y, z = _cell(grid, point, level)
    for cell in range(27):
        key = _key(level, x + cell // 9 - 1, y + cell // 3 % 3 - 1, z + cell % 3 - 1)
        if grid.keys[_slot(grid, key)] != EMPTY:
            return False
    return True


@njit(cache=True)
def first_touch(
    grid: Cells, start: FloatArray, direction: FloatArray, radius: float, length: float, found: IntArray
) -> tuple[float, int]:
    """Travel at which a sphere on a straight line first touches another, and which; (inf, −1) if none within `length`.

    `found` (N,) is overwritten.
    """
    travel = 0.0
    stride = 2 * grid.largest
    while travel < length:
        point = start + travel * direction
        free = clearance(grid, point) - radius
        if free > stride:
            travel += free
            continue
        touch, sphere = _touch_within(grid, point, direction, radius, stride, found)
        if sphere != EMPTY:
            return (travel + touch, sphere) if travel + touch <= length else (np.inf, EMPTY)
        travel += stride
    return np.inf, EMPTY


@njit(cache=True)
def _touch_within(
    grid: Cells, point: FloatArray, direction: FloatArray, radius: float, stride: float, found: IntArray
) -> tuple[float, int]:
    """The first touch on the next stretch of a line, and the sphere touched; none is −1."""
    best, touched = stride, EMPTY
    for k in range(near(grid, point + 0.5 * stride * direction, 0.5 * stride + radius + grid.largest, found)):
        sphere = found[k]
        offset = grid.centers[sphere] - point
        ahead = np.dot(offset, direction)
        reach = radius + grid.radii[sphere]
        half2 = reach * reach - (np.dot(offset, offset) - ahead * ahead)
        # A sphere that is being left has its middle behind, however the gap is rounded.
        if ahead > 0 and half2 > 0 and ahead - np.sqrt(half2) < best:
            best, touched = ahead - np.sqrt(half2), sphere
    return best, touched
