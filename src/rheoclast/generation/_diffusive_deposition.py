"""Single spheres that diffuse to a cluster from far away, compiled by Numba."""

from __future__ import annotations

import numpy as np
from numba import njit

from rheoclast._checks import FloatArray, IntArray
from rheoclast.generation._cells import EMPTY, Cells, add, cells, clearance, first_touch
from rheoclast.generation._orientations import random_direction
from rheoclast.generation._walks import LAST_STEP, NEAR, walked


@njit(cache=True)
def diffusively_deposited(radii: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Centres (N, 3) of spheres that arrive one after the other and stick at first touch."""
    grid, found = cells(radii), np.empty(radii.size, np.int64)
    add(grid, np.zeros(3))
    extent = radii[0]
    for sphere in range(1, radii.size):
        place = _arrival(grid, radii[sphere], extent, rng, found)
        add(grid, place)
        extent = max(extent, np.sqrt(np.dot(place, place)) + radii[sphere])
    return grid.centers


@njit(cache=True)
def _arrival(grid: Cells, radius: float, extent: float, rng: np.random.Generator, found: IntArray) -> FloatArray:
    """Place of first touch of a walker from infinity, which is uniform on the sphere around the cluster."""
    launch = (extent + radius) * (1 + NEAR)
    back = False
    while True:
        if not back:
            place = launch * random_direction(rng)
        free = clearance(grid, place) - radius
        if free < NEAR * radius:
            direction = random_direction(rng)
            travel, touched = first_touch(grid, place, direction, radius, LAST_STEP * free, found)
            if touched != EMPTY:
                return place + travel * direction
        back, place = walked(place, free, launch, rng)
