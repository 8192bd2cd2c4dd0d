"""Brownian walks around a cluster without a boundary far out, compiled by Numba.

A step as long as the free way, in a random direction, ends where a Brownian path first leaves the free ball: M. E.
Muller, Ann. Math. Stat. 27 (1956) 569. Of the paths that leave a sphere of radius R for the distance r the share R / r
comes back, and where is known from the Poisson kernel of the exterior, so that nothing is cut off.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from rheoclast._checks import FloatArray
from rheoclast.generation._orientations import random_direction, random_normal

NEAR = 1e-3
"""Gap, in radii, below which the last step goes straight."""
LAST_STEP = 4.0
"""Longest last step, in gaps."""


@njit(cache=True)
def walked(place: FloatArray, free: float, launch: float, rng: np.random.Generator) -> tuple[bool, FloatArray]:
    """Whether a walker came back to within `launch` of the origin after a step of length `free`, and its place (3,)."""
    place = place + free * random_direction(rng)
    distance = np.sqrt(np.dot(place, place))
    if distance <= launch:
        return True, place
    if rng.random() * distance > launch:
        return False, place
    return True, returned(place, distance, launch, rng)


@njit(cache=True)
def returned(place: FloatArray, distance: float, launch: float, rng: np.random.Generator) -> FloatArray:
    """Where a path from outside, at `distance`, that comes back first meets the sphere of radius `launch`.

    Its distance s from the start has a distribution that is linear in 1 / s.
    """
    chord = (distance * distance - launch * launch) / (distance - launch + 2 * launch * rng.random())
    cosine = (distance * distance + launch * launch - chord * chord) / (2 * distance * launch)
    cosine = min(max(cosine, -1.0), 1.0)
    axis = place / distance
    return launch * (cosine * axis + np.sqrt(1 - cosine * cosine) * random_normal(axis, rng))
