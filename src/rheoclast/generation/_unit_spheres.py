"""From the centres of touching unit spheres to an aggregate in metres."""

from __future__ import annotations

from typing import Any

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.errors import GeometryError
from rheoclast.particles.aggregate import Aggregate
from rheoclast.particles.contacts import near_pairs
from rheoclast.particles.spheres import Spheres

TOUCH = 1e-9
"""Largest gap, and overlap, of spheres in contact, in radii."""


def unit_sphere_aggregate(centers: FloatArray, radius: Any) -> Aggregate:
    """Aggregate about the origin of equal spheres, `radius` in m, whose centres (N, 3) are given in radii.

    Raises
    ------
    GeometryError
        If two spheres overlap, or the aggregate is in several parts.
    """
    radius = _checks.positive("radius", radius)
    centers = centers - centers.mean(axis=0)
    pairs, gaps = near_pairs(centers, np.ones(len(centers)), TOUCH)
    if len(gaps) and gaps.min() < -TOUCH:
        i, j = pairs[gaps.argmin()].tolist()
        raise GeometryError(f"spheres {i} and {j} overlap: distance {2 + gaps.min():.6g} < 2 sphere radii")
    return Aggregate(Spheres(radius * centers, radius), pairs)
