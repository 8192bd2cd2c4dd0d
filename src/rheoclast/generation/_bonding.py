"""Joining two clusters in any contact with the same probability, compiled by Numba."""

from __future__ import annotations

import numpy as np
from numba import njit

from rheoclast._checks import FloatArray
from rheoclast.generation._clusters import Cluster, overlap
from rheoclast.generation._orientations import random_direction, random_rotation


@njit(cache=True)
def random_contact(
    first: Cluster, second: Cluster, largest: float, rng: np.random.Generator
) -> tuple[bool, FloatArray, FloatArray]:
    """Whether one random contact of two clusters is free of overlap, and the motion x ↦ R x + t of the second.

    At a given orientation the places of the second cluster within a small gap of the first form a shell over spheres
    of radius a + b about the pairs of spheres. A pair is drawn by the area of its sphere, then the place on it;
    `largest` is the largest radius of all clusters, so that larger pairs of clusters are drawn in proportion, too.
    """
    i, j = rng.integers(0, first.radii.size), rng.integers(0, second.radii.size)
    contact = first.radii[i] + second.radii[j]
    rotation = random_rotation(rng)
    shift = first.centers[i] + contact * random_direction(rng) - rotation @ second.centers[j]
    accepted = contact * contact >= 4 * largest * largest * rng.random()
    return accepted and not overlap(first, second, rotation, shift), rotation, shift
