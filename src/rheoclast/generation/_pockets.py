"""Pockets: places where a unit sphere touches three others, in closed form and clear of all others. Compiled by Numba.

Lengths are in sphere radii.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from rheoclast._checks import FloatArray, IntArray

CLEAR = (2 - 1e-12) ** 2
"""Squared distance of centres below which spheres overlap; rounding is far below it."""
REACH = 4.0
"""Farthest that two spheres can be while a third touches both."""
THINNEST = 1e-6
"""Squared, twice the area of the triangle of three centres; thinner ones leave the pocket undetermined."""


@njit(cache=True)
def distance2(a: FloatArray, b: FloatArray) -> float:
    """Squared distance of two points."""
    return (a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2 + (a[2] - b[2]) ** 2


@njit(cache=True)
def find_near(centers: FloatArray, count: int, point: FloatArray, near: IntArray) -> int:
    """Number of the first `count` centres within `REACH` of a point; `near` receives their indices."""
    found = 0
    for i in range(count):
        if distance2(centers[i], point) < REACH**2:
            near[found] = i
            found += 1
    return found


@njit(cache=True)
def is_clear(point: FloatArray, centers: FloatArray, near: IntArray, but: int) -> bool:
    """Whether a unit sphere at a point overlaps none of the spheres `near`, leaving out sphere `but`."""
    for i in near:  # noqa: SIM110 (Numba knows no generator expressions)
        if i != but and distance2(centers[i], point) < CLEAR:
            return False
    return True


@njit(cache=True)
def touching_places(a: FloatArray, b: FloatArray, c: FloatArray, places: FloatArray) -> bool:
    """Whether a unit sphere can touch three others; `places` (2, 3) receives where, on either side of their plane.

    They stand at the height sqrt(4 − R²) above and below the centre of the circle, of radius R, through a, b and c.
    """
    if distance2(b, c) >= REACH**2:
        return False
    ux, uy, uz = b[0] - a[0], b[1] - a[1], b[2] - a[2]
    vx, vy, vz = c[0] - a[0], c[1] - a[1], c[2] - a[2]
    nx, ny, nz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    normal2 = nx * nx + ny * ny + nz * nz
    if normal2 < THINNEST:
        return False
    uu, vv, uv = ux * ux + uy * uy + uz * uz, vx * vx + vy * vy + vz * vz, ux * vx + uy * vy + uz * vz
    along_u, along_v = vv * (uu - uv) / (2 * normal2), uu * (vv - uv) / (2 * normal2)
    x, y, z = along_u * ux + along_v * vx, along_u * uy + along_v * vy, along_u * uz + along_v * vz
    height2 = 4 - (x * x + y * y + z * z)
    if height2 < 0:
        return False
    step = math.sqrt(height2 / normal2)
    for side in range(2):
        sign = step * (1 - 2 * side)
        places[side, 0], places[side, 1], places[side, 2] = (
            a[0] + x + sign * nx,
            a[1] + y + sign * ny,
            a[2] + z + sign * nz,
        )
    return True


@njit(cache=True)
def deposit(centers: FloatArray, first: int, disorder: float, rng: np.random.Generator) -> None:
    """Fill `centers` (N, 3) from sphere `first` on with spheres in the pocket nearest to the origin, one by one.

    The distance of every pocket counts more by a random share of `disorder`, drawn once.
    """
    places, keys, known = np.empty((64, 3)), np.empty(64), 0
    found, origin, near = np.empty((2, 3)), np.zeros(3), np.empty(len(centers), np.intp)
    for new in range(len(centers)):
        if new >= first:
            centers[new] = places[np.argmin(keys[:known])]
        known = _forget_blocked(places, keys, known, centers[new])
        around = near[: find_near(centers, new, centers[new], near)]
        for m in range(len(around)):
            for n in range(m):
                if not touching_places(centers[new], centers[around[m]], centers[around[n]], found):
                    continue
                for side in range(2):
                    if is_clear(found[side], centers, around, -1):
                        if known == len(keys):
                            places, keys = np.concatenate((places, places)), np.concatenate((keys, keys))
                        places[known] = found[side]
                        keys[known] = math.sqrt(distance2(found[side], origin)) + disorder * rng.random()
                        known += 1


@njit(cache=True)
def _forget_blocked(places: FloatArray, keys: FloatArray, known: int, center: FloatArray) -> int:
    """Take away the places that a sphere at `center` overlaps; returns how many are left, at the front."""
    left = 0
    for m in range(known):
        if distance2(places[m], center) >= CLEAR:
            places[left], keys[left] = places[m], keys[m]
            left += 1
    return left
