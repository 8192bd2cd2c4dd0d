"""Random directions and rotations, compiled by Numba.

Uniform rotations from four normal deviates, as a unit quaternion: K. Shoemake, in Graphics Gems III (1992) 124.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from rheoclast._checks import FloatArray


@njit(cache=True)
def random_direction(rng: np.random.Generator) -> FloatArray:
    """Unit vector (3,), uniform over the sphere."""
    height = 2 * rng.random() - 1
    angle = 2 * np.pi * rng.random()
    width = np.sqrt(1 - height * height)
    return np.array([width * np.cos(angle), width * np.sin(angle), height])


@njit(cache=True)
def random_normal(direction: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Unit vector (3,), uniform over the circle normal to a unit vector."""
    while True:
        vector = random_direction(rng)
        vector -= np.dot(vector, direction) * direction
        length = np.sqrt(np.dot(vector, vector))
        # A vector nearly parallel to the direction would lose its digits in the difference.
        if length > 1e-2:
            vector /= length
            return vector - np.dot(vector, direction) * direction


@njit(cache=True)
def random_rotation(rng: np.random.Generator) -> FloatArray:
    """Rotation matrix (3, 3), uniform over all orientations."""
    q = np.array([rng.standard_normal(), rng.standard_normal(), rng.standard_normal(), rng.standard_normal()])
    w, x, y, z = q / np.sqrt(np.dot(q, q))
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


@njit(cache=True)
def random_turn(start: FloatArray, end: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Rotation matrix (3, 3) that takes one unit vector to another, with a uniform angle about it."""
    before, after = random_normal(start, rng), random_normal(end, rng)
    source = np.stack((start, before, np.cross(start, before)))
    target = np.stack((end, after, np.cross(end, after)))
    return target.T @ source
