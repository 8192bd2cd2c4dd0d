"""Reaction-limited cluster–cluster aggregates: every contact of every two clusters is equally probable.

The limit of vanishing sticking probability: M. Kolb and R. Jullien, J. Physique Lett. 45 (1984) L977; R. Jullien and
M. Kolb, J. Phys. A 17 (1984) L639. With clusters of all sizes, which meet in proportion to the contacts they can make:
W. D. Brown and R. C. Ball, J. Phys. A 18 (1985) L517.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from rheoclast._checks import FloatArray
from rheoclast.generation import _growth
from rheoclast.particles.aggregate import Aggregate

if TYPE_CHECKING:
    from rheoclast.generation._clusters import Cluster


def reaction_limited_cluster_cluster(
    count: int, radius: float = 1.0, *, spread: float = 0.0, seed: int = 0
) -> Aggregate:
    """Aggregate of `count` spheres that stuck together with a vanishing probability per touch.

    A sphere of one cluster, a sphere of another, the orientation and the place of contact are drawn with the weight
    of the surface on which the clusters touch, and the two stick unless they overlap, until one cluster is left. Large
    clusters, which can touch in more ways, so meet more often. The aggregate is a tree of dimension about 2.1.

    Parameters
    ----------
    count
        Number of spheres.
    radius
        Median radius in m.
    spread
        Standard deviation of ln radius, from 0 to 1.
    seed
        Equal seeds give equal aggregates.

    Raises
    ------
    ValueError
        If a parameter is out of range.
    """
    radii, rng = _growth.begin(count, radius, spread, seed)
    grown = _last_cluster(radii, rng)
    return _growth.finished(grown.centers, grown.radii, radius)


def _last_cluster(radii: FloatArray, rng: np.random.Generator) -> Cluster:
    """What single spheres with radii (N,) become when any two clusters may stick at any contact."""
    from rheoclast.generation._bonding import random_contact
    from rheoclast.generation._clusters import cluster, union

    clusters = {k: cluster(np.zeros((1, 3)), radii[k : k + 1]) for k in range(len(radii))}
    member_of = np.arange(len(radii))
    while len(clusters) > 1:
        first, second = member_of[rng.integers(0, len(radii), 2)].tolist()
        if first == second:
            continue
        found, rotation, shift = random_contact(clusters[first], clusters[second], radii.max(), rng)
        if found:
            clusters[first] = union(clusters[first], clusters.pop(second), rotation, shift)
            member_of[member_of == second] = first
    return clusters.popitem()[1]
