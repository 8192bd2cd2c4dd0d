"""Measures of an aggregate's size and structure."""

from __future__ import annotations

import numpy as np

from rheoclast._checks import FloatArray, IntArray
from rheoclast.particles.aggregate import Aggregate
from rheoclast.particles.spheres import Spheres


def radius_of_gyration(spheres: Spheres) -> float:
    """Radius of gyration in m, at uniform density, the spheres' own extent included.

    Rg² = Σ m (|x − x_c|² + 3/5 a²) / Σ m with m the volume of each sphere.
    """
    distance2 = np.sum((spheres.centers - spheres.center_of_mass) ** 2, axis=1)
    return float(np.sqrt(np.average(distance2 + 0.6 * spheres.radii**2, weights=spheres.volumes)))


def coordination_numbers(aggregate: Aggregate) -> IntArray:
    """Number of contacts of every sphere, (N,)."""
    return np.bincount(aggregate.pairs.ravel(), minlength=len(aggregate)).astype(np.intp)


def depth(aggregate: Aggregate, points: FloatArray) -> FloatArray:
    """Distance (P,) of points (P, 3) from the centre of mass over the radius of gyration."""
    offset = np.asarray(points) - aggregate.spheres.center_of_mass
    return np.linalg.norm(offset, axis=-1) / radius_of_gyration(aggregate.spheres)
