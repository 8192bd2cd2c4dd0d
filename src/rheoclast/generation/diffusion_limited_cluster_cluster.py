"""Diffusion-limited cluster–cluster aggregates: clusters of like size diffuse until they touch, and stick.

P. Meakin, Phys. Rev. Lett. 51 (1983) 1119; M. Kolb, R. Botet and R. Jullien, Phys. Rev. Lett. 51 (1983) 1123; the
hierarchical model in three dimensions, R. Jullien, M. Kolb and R. Botet, J. Physique Lett. 45 (1984) L211.
"""

from __future__ import annotations

from rheoclast.generation import _growth
from rheoclast.particles.aggregate import Aggregate


def diffusion_limited_cluster_cluster(
    count: int, radius: float = 1.0, *, spread: float = 0.0, seed: int = 0
) -> Aggregate:
    """Aggregate of `count` spheres, of two halves that met by diffusion, each grown in the same way.

    The centre of one half follows a Brownian path from infinity relative to the other, in a random orientation that
    it keeps: rotational diffusion is left out, and so are all third clusters (the dilute limit). Steps are as long as
    the free way, and only the last thousandth of a radius is a straight line. The aggregate is a tree of dimension
    about 1.8.

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
    from rheoclast.generation._joining import diffusive_join

    grown = hierarchy(radii, lambda first, second: diffusive_join(first, second, rng))
    return _growth.finished(grown.centers, grown.radii, radius)
