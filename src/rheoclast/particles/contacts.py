"""Which spheres touch, and which overlap, from their surface gaps."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from rheoclast._checks import FloatArray, IntArray

CONTACT_TOLERANCE = 1e-3


def near_pairs(centers: FloatArray, radii: FloatArray, tolerance: float) -> tuple[IntArray, FloatArray]:
    """Pairs whose surface gap is at most `tolerance` mean radii of the pair.

    Returns
    -------
    pairs
        (P, 2) indices i < j in lexicographic order.
    gaps
        (P,) distance of centres minus sum of radii, over the mean radius of the pair; negative where they overlap.
    """
    reach = (2 + tolerance) * float(radii.max())
    pairs = cKDTree(centers).query_pairs(reach, output_type="ndarray").astype(np.intp)
    pairs.sort(axis=1)
    pairs = pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]
    gaps = surface_gaps(centers, radii, pairs)
    near = gaps <= tolerance
    return pairs[near], gaps[near]


def surface_gaps(centers: FloatArray, radii: FloatArray, pairs: IntArray) -> FloatArray:
    """Gap between the surfaces of pairs (P, 2) of spheres over the mean radius of each pair, (P,)."""
    first, second = pairs.T
    distance = np.linalg.norm(centers[second] - centers[first], axis=1)
    sum_of_radii = radii[first] + radii[second]
    return 2 * (distance - sum_of_radii) / sum_of_radii
