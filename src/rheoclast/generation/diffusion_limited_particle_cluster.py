"""Diffusion-limited particle–cluster aggregates: single spheres diffuse from infinity and stick at first touch.

T. A. Witten and L. M. Sander, Phys. Rev. Lett. 47 (1981) 1400; off a lattice in three dimensions, where the dimension
is 2.5, S. Tolman and P. Meakin, Phys. Rev. A 40 (1989) 428.
"""

from __future__ import annotations

from rheoclast.generation import _growth
from rheoclast.particles.aggregate import Aggregate


def diffusion_limited_particle_cluster(
    count: int, radius: float = 1.0, *, spread: float = 0.0, seed: int = 0
) -> Aggregate:
    """Aggregate of `count` spheres that diffused one by one from infinity and stuck where they first touched.

    The walk is that of a Brownian path, with steps as long as the free way; paths that go far are brought back, or
    begun anew, with the exact probability. Only the last thousandth of a radius is a straight line. The aggregate is a
    tree of dimension about 2.5.

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
    from rheoclast.generation._diffusive_deposition import diffusively_deposited

    return _growth.finished(diffusively_deposited(radii, rng), radii, radius)
