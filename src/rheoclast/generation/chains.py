"""Chains: straight ones, and arcs, zig-zags and helices from one bend and one torsion per link.

The chain is the discrete curve of constant curvature and torsion: each link follows from the last by the same bend and
torsion, one rotation of its frame (P. J. Flory, Statistical Mechanics of Chain Molecules (1969), chapter I).
"""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.errors import GeometryError
from rheoclast.generation._unit_spheres import unit_sphere_aggregate
from rheoclast.particles.aggregate import Aggregate

LARGEST_BEND = 2 * np.pi / 3


def straight_chain(count: int, radius: float = 1.0) -> Aggregate:
    """Straight chain along x of `count` equal spheres, `radius` in m."""
    return bent_chain(count, radius, bend=0.0)


def bent_chain(count: int, radius: float = 1.0, *, bend: float, torsion: float = 0.0) -> Aggregate:
    """Chain of `count` equal spheres, `radius` in m, that turns by the same angles from link to link.

    Parameters
    ----------
    bend
        Angle in rad between successive links, from 0 (straight) to 2π/3 (every second sphere touches too).
    torsion
        Angle in rad between the planes of successive pairs of links: 0 gives an arc, π a zig-zag, others a helix.

    Notes
    -----
    The first link lies along x, the second in the plane z = 0. Spheres that happen to touch are in contact, so that
    the bend 2π/N makes a ring of N.

    Raises
    ------
    GeometryError
        If the chain runs into itself.
    """
    count = _checks.whole_number("count", count, 1)
    bend = _checks.not_negative("bend", bend)
    torsion = float(_checks.real_array("torsion", torsion, ()))
    if bend > LARGEST_BEND * (1 + 1e-12):
        raise ValueError(
            f"bend: expected an angle from 0 to 2π/3 rad = {LARGEST_BEND:.4f}, beyond which every second sphere "
            f"overlaps, got {bend:.6g}"
        )
    try:
        return unit_sphere_aggregate(_chain_centers(count, bend, torsion), radius)
    except GeometryError as error:
        raise GeometryError(
            f"the chain runs into itself: {error}; take fewer spheres, a smaller bend or another torsion"
        ) from None


def _chain_centers(count: int, bend: float, torsion: float) -> FloatArray:
    """Centres (N, 3) in radii, each at the start of a link. The frame of link k is the k-th power of one rotation."""
    turn = Rotation.from_rotvec([0, 0, bend]) * Rotation.from_rotvec([torsion, 0, 0])
    frames = Rotation.from_rotvec(np.arange(count)[:, None] * turn.as_rotvec())
    links = 2 * frames.apply([1.0, 0, 0])
    return np.cumsum(links, axis=0) - links
