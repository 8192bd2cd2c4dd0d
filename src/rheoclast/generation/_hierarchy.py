"""Clusters of clusters: two pieces of like size are grown in the same way, then joined.

The hierarchical model of R. Botet, R. Jullien and M. Kolb, J. Phys. A 17 (1984) L75, where the number of spheres is a
power of two; here any number is halved, the halves differing by at most one sphere, or split in another share.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np

from rheoclast._checks import FloatArray
from rheoclast.generation._clusters import Cluster, cluster

Join = Callable[[Cluster, Cluster], Cluster]


def hierarchy(radii: FloatArray, join: Join, share: int = 2) -> Cluster:
    """Cluster of spheres with the given radii (N,), the second piece of every join being one `share`-th of the union.

    Two makes the pieces alike; with a share of N or more, single spheres are added one by one.
    """
    sizes = [len(radii)]
    while sizes[-1] > 1:
        sizes.append(sizes[-1] - max(sizes[-1] // share, 1))
    grown = cluster(np.zeros((1, 3)), radii[:1])
    for start, end in pairwise(reversed(sizes)):
        grown = join(grown, hierarchy(radii[start:end], join, share))
    return grown
