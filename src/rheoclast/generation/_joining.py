"""Joining two clusters at first touch: on a straight line or by diffusion, compiled by Numba."""

from __future__ import annotations

import numpy as np
from numba import njit

from rheoclast.generation._clusters import Cluster, extent, smallest_gap, travel_to_touch, union
from rheoclast.generation._orientations import random_direction, random_normal, random_rotation
from rheoclast.generation._walks import LAST_STEP, NEAR, walked


@njit(cache=True)
def ballistic_join(first: Cluster, second: Cluster, rng: np.random.Generator) -> Cluster:
    """Union after a straight flight of random orientation, direction and offset that leads to a touch."""
    reach = extent(first) + extent(second)
    while True:
        rotation, direction = random_rotation(rng), random_direction(rng)
        start = reach * (np.sqrt(rng.random()) * random_normal(direction, rng) - direction)
        travel = travel_to_touch(first, second, rotation, start, direction)
        if travel < np.inf:
            return union(first, second, rotation, start + travel * direction)


@njit(cache=True)
def diffusive_join(first: Cluster, second: Cluster, rng: np.random.Generator) -> Cluster:
    """Union after a Brownian path from infinity, in a random orientation that the second cluster keeps."""
    launch = (extent(first) + extent(second)) * (1 + NEAR)
    small = NEAR * min(first.radii.min(), second.radii.min())
    back = False
    while True:
        if not back:
            rotation, place = random_rotation(rng), launch * random_direction(rng)
        free = smallest_gap(first, second, rotation, place, np.inf, -np.inf)
        if free < small:
            direction = random_direction(rng)
            travel = travel_to_touch(first, second, rotation, place, direction)
            if travel < LAST_STEP * free:
                return union(first, second, rotation, place + travel * direction)
        back, place = walked(place, free, launch, rng)
