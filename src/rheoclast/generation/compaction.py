"""Compaction: from an open aggregate to a close packing of the same spheres, in steps as small as one sphere's move.

Spheres that hang loosely roll over a neighbour into the pocket between three spheres that is nearest to the centre of
mass. The pockets are those of C. H. Bennett, J. Appl. Phys. 43 (1972) 2727, and rolling is that of W. M. Visscher &
M. Bolsterli, Nature 239 (1972) 504; their use for restructuring an aggregate is our own. It is a geometrical family,
not a model of the restructuring in a flow.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.linalg import lsmr

from rheoclast import _checks
from rheoclast._checks import FloatArray, IntArray, seeded
from rheoclast.errors import GeometryError
from rheoclast.generation._unit_spheres import unit_sphere_aggregate
from rheoclast.generation.cluster_cluster import cluster_cluster
from rheoclast.particles.aggregate import Aggregate

if TYPE_CHECKING:
    from rheoclast.generation._rolling import Assembly, Moves

IDLE_SHARE = 0.005
"""Share of spheres that roll in one round, at or below which the outermost are transferred."""
TRANSFERRED_SHARE = 0.02
EQUAL = 1e-9
CLOSED = 1e-10
NEWTON_STEPS = 8


def compacted(aggregate: Aggregate, amount: float, *, seed: int = 0) -> Aggregate:
    """The same equal spheres, compacted by a given amount: 0 leaves them in place, 1 packs them as closely as it goes.

    Along the way the mean coordination number rises and the radius of gyration falls to that of a random close packing,
    the branches thickening as they shorten. From cluster–cluster trees (dimension 1.8) the coordination ends at 5.2 for
    50 spheres and 5.8 for 1 000; from dense trees (2.5) it ends lower, at 4.7 and 5.0 for 50 and 300, as inner spheres
    are caged before they have closed their loops. Every amount is a stage of one and the same way for equal seeds.

    Parameters
    ----------
    aggregate
        Equal spheres. Contacts with a small gap are closed first; spheres that touch are taken to be in contact.
    amount
        Share of the whole way from 0 to 1, the mean of two shares: of the rise in the number of contacts and of the
        fall in the radius of gyration of the centres.
    seed
        Of the order in which spheres are tried, and of directions that symmetry leaves open.

    Raises
    ------
    ValueError
        If the spheres are unequal or the amount is not within 0 and 1.
    GeometryError
        If the contacts have gaps that cannot be closed all at once.
    """
    radius = _common_radius(aggregate)
    amount = _checks.not_negative("amount", amount)
    if amount > 1:
        raise ValueError(f"amount: expected a share from 0 to 1, got {amount:g}")
    rng = seeded(seed)
    centers = _closed(aggregate.spheres.centers / radius, aggregate.pairs)
    return unit_sphere_aggregate(_stage(centers, amount, rng), radius)


def compacted_cluster(
    count: int,
    radius: float = 1.0,
    *,
    amount: float,
    fractal_dimension: float = 1.8,
    prefactor: float = 1.3,
    seed: int = 0,
) -> Aggregate:
    """Tree from `cluster_cluster`, compacted by an amount: a family from tree (0) to packing (1) at a fixed number.

    Equal seeds give stages of one way, whatever the amount; the other parameters are those of `cluster_cluster` and
    `compacted`, which also say what is refused.
    """
    tree = cluster_cluster(count, radius, fractal_dimension=fractal_dimension, prefactor=prefactor, seed=seed)
    return compacted(tree, amount, seed=seed)


def _stage(centers: FloatArray, amount: float, rng: np.random.Generator) -> FloatArray:
    """Centres (N, 3) in radii after the first move that completes the share `amount` of the whole way."""
    from rheoclast.generation._rolling import assembled, extent

    assembly = assembled(centers.copy())
    start = extent(assembly)
    moves = _whole_way(assembly, rng)
    spheres, places, extents = (np.concatenate(parts) for parts in zip(*moves, strict=True))
    way = np.vstack([start, extents]) - start
    shares = (way / np.where(way[-1], way[-1], 1)).sum(axis=1)
    share = shares / max(1, shares[-1])
    last = len(spheres) if amount == 1 else int(np.argmax(share >= amount))
    # Where a sphere moved more than once, the last of its places counts.
    centers = centers.copy()
    centers[spheres[:last]] = places[:last]
    return centers


def _whole_way(assembly: Assembly, rng: np.random.Generator) -> list[Moves]:
    """All moves until none is left, in rounds: each sphere rolls; when few do, the outermost are transferred."""
    from rheoclast.generation._rolling import roll_all, transfer_outermost

    count = len(assembly.centers)
    rounds = []
    while True:
        rounds.append(roll_all(assembly, rng))
        if len(rounds[-1].spheres) <= IDLE_SHARE * count:
            rounds.append(transfer_outermost(assembly, math.ceil(TRANSFERRED_SHARE * count)))
            if len(rounds[-1].spheres) + len(rounds[-2].spheres) == 0:
                return rounds


def _common_radius(aggregate: Any) -> float:
    _checks.instance("aggregate", aggregate, Aggregate, "make one with Aggregate.touching(spheres)")
    radii = aggregate.spheres.radii
    unequal = np.flatnonzero(np.abs(radii - radii[0]) > EQUAL * radii[0])
    if len(unequal):
        i = int(unequal[0])
        raise ValueError(
            f"aggregate: expected equal spheres, got radii {radii[0]:g} of sphere 0 and {radii[i]:g} of sphere {i}"
        )
    return float(radii[0])


def _closed(centers: FloatArray, pairs: IntArray) -> FloatArray:
    """Centres (N, 3) in radii, moved as little as closes all contacts (C, 2) exactly, by Newton steps of least norm.

    Raises
    ------
    GeometryError
        If the contacts cannot be closed all at once.
    """
    contact, (first, second) = np.arange(len(pairs)), pairs.T
    for _ in range(NEWTON_STEPS):
        difference = centers[second] - centers[first]
        distance = np.linalg.norm(difference, axis=1)
        gaps = distance - 2
        if np.abs(gaps).max(initial=0) <= CLOSED:
            return centers
        normals = difference / distance[:, None]
        rows = np.repeat(np.concatenate([contact, contact]), 3)
        columns = (3 * np.concatenate([second, first])[:, None] + np.arange(3)).ravel()
        rates = coo_array((np.concatenate([normals, -normals]).ravel(), (rows, columns)), (len(pairs), centers.size))
        step = lsmr(rates.tocsr(), -gaps, atol=1e-14, btol=1e-14, maxiter=100 * len(centers))[0]
        centers = centers + step.reshape(-1, 3)
    raise GeometryError(
        f"aggregate: expected contacts that can be closed exactly, got a gap of {np.abs(gaps).max():.3g} radii that "
        "other contacts keep open; pass a tree, or an aggregate from rheoclast.generation"
    )
