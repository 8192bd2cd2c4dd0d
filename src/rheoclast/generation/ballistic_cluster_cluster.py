"""Ballistic cluster–cluster aggregates: clusters of like size meet on straight lines and stick at first touch.

D. N. Sutherland and I. Goodarz-Nia, Chem. Eng. Sci. 26 (1971) 2071; P. Meakin, Phys. Rev. A 29 (1984) 997; the
hierarchical model with linear trajectories, R. Jullien, J. Phys. A 17 (1984) L771.
"""

from __future__ import annotations

from rheoclast.generation import _growth
from rheoclast.particles.aggregate import Aggregate


def ballistic_cluster_cluster(count: int, radius: float = 1.0, *, spread: float = 0.0, seed: int = 0) -> Aggregate:
    """Aggregate of `count` spheres, of two halves that met on a straight line, each grown in the same way.

    Orientation, direction and offset over the cross-section are uniform. The aggregate is a tree of dimension about
    1.9.

    Parameters
    ----------
    count
        Number of spheres; the halves differ by at most one.
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
    from rheoclast.generation._hierarchy import hierarchy
    from rheoclast.generation._joining import ballistic_join

    grown = hierarchy(radii, lambda first, second: ballistic_join(first, second, rng))
    return _growth.finished(grown.centers, grown.radii, radius)
