"""Single spheres that arrive at a cluster on straight lines, compiled by Numba."""

from __future__ import annotations

import numpy as np
from numba import njit

from rheoclast._checks import FloatArray, IntArray
from rheoclast.generation._cells import EMPTY, Cells, add, cells, first_touch, near
from rheoclast.generation._orientations import random_direction, random_normal


@njit(cache=True)
def deposited(radii: FloatArray, migrations: int, rng: np.random.Generator) -> FloatArray:
    """Centres (N, 3) of spheres that arrive one after the other and migrate up to twice."""
    grid, found = cells(radii), np.empty(radii.size, np.int64)
    add(grid, np.zeros(3))
    extent = radii[0]
    for sphere in range(1, radii.size):
        place, touched = _arrival(grid, radii[sphere], extent, rng, found)
        if migrations > 0:
            place = _migrated(grid, place, radii[sphere], touched, migrations, found)
        add(grid, place)
        extent = max(extent, np.sqrt(np.dot(place, place)) + radii[sphere])
    return grid.centers


@njit(cache=True)
def _arrival(
    grid: Cells, radius: float, extent: float, rng: np.random.Generator, found: IntArray
) -> tuple[FloatArray, int]:
    """Place of first touch, and the sphere touched, on a line of random direction and offset that hits the cluster."""
    reach = extent + radius
    while True:
        direction = random_direction(rng)
        offset = reach * np.sqrt(rng.random()) * random_normal(direction, rng)
        start = offset - reach * direction
        travel, touched = first_touch(grid, start, direction, radius, 2 * reach, found)
        if touched != EMPTY:
            return start + travel * direction, touched


@njit(cache=True)
def _migrated(
    grid: Cells, place: FloatArray, radius: float, first: int, migrations: int, found: IntArray
) -> FloatArray:
    """Where a sphere that touches `first` comes to rest after one or two migrations, if there is a sphere to reach."""
    widest = 2 * (radius + grid.largest) + grid.radii[first]
    count = near(grid, grid.centers[first], widest, found)
    place, second = second_contact(grid, place, radius, first, found[:count])
    if migrations == 1 or second == EMPTY:
        return place
    return third_contact(grid, place, radius, first, second, found[:count])


@njit(cache=True)
def second_contact(
    grid: Cells, place: FloatArray, radius: float, first: int, neighbors: IntArray
) -> tuple[FloatArray, int]:
    """Where a sphere that rolls over `first` by the shortest arc touches one of the neighbours, and which.

    The places that touch `first` form a sphere; each neighbour forbids a cap of it. The nearest point of the nearest
    cap lies on the great circle to the axis of that cap. The place stays, and −1 is returned, if there is no cap.
    """
    middle, arm = grid.centers[first], radius + grid.radii[first]
    outward = (place - middle) / arm
    shortest, sine, cosine, touched = np.inf, 0.0, 1.0, EMPTY
    for other in neighbors:
        axis = grid.centers[other] - middle
        length = np.sqrt(np.dot(axis, axis))
        reach = radius + grid.radii[other]
        if other == first or length > arm + reach:
            continue
        rim = (length * length + arm * arm - reach * reach) / (2 * length * arm)
        height = np.dot(axis, outward) / length
        arc = np.arccos(min(max(height, -1.0), 1.0)) - np.arccos(min(max(rim, -1.0), 1.0))
        if arc < shortest:
            shortest, touched = arc, other
            cosine, sine = rim, np.sqrt(max(1 - rim * rim, 0.0))
    if touched == EMPTY:
        return place, touched
    axis = grid.centers[touched] - middle
    axis /= np.sqrt(np.dot(axis, axis))
    side = outward - np.dot(outward, axis) * axis
    side /= np.sqrt(np.dot(side, side))
    return middle + arm * (cosine * axis + sine * side), touched


@njit(cache=True)
def third_contact(
    grid: Cells, place: FloatArray, radius: float, first: int, second: int, neighbors: IntArray
) -> FloatArray:
    """Where a sphere that rolls over two others, either way round, first touches a neighbour; its place if nowhere."""
    axis = grid.centers[second] - grid.centers[first]
    axis /= np.sqrt(np.dot(axis, axis))
    arm = place - grid.centers[first]
    middle = grid.centers[first] + np.dot(arm, axis) * axis
    out = place - middle
    side = np.cross(axis, out)
    smallest = np.inf
    for other in neighbors:
        if other in (first, second):
            continue
        offset = grid.centers[other] - middle
        reach = radius + grid.radii[other]
        # |out cos ψ + side sin ψ − offset| = reach, where |out| = |side|
        along, across = np.dot(out, offset), np.dot(side, offset)
        level = 0.5 * (np.dot(out, out) + np.dot(offset, offset) - reach * reach)
        amplitude = np.hypot(along, across)
        if abs(level) > amplitude:
            continue
        toward, half = np.arctan2(across, along), np.arccos(level / amplitude)
        for angle in (toward - half, toward + half):
            turned = np.arctan2(np.sin(angle), np.cos(angle))
            smallest = turned if abs(turned) < abs(smallest) else smallest
    if np.isinf(smallest):
        return place
    return middle + np.cos(smallest) * out + np.sin(smallest) * side
