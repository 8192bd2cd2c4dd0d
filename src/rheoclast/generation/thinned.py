"""Thinned aggregates: the spheres of a given one with fewer of its contacts, still connected.

A spanning tree of the contacts is kept, drawn with equal probability from all of them by loop-erased random walks
(D. B. Wilson, Proc. 28th ACM Symp. Theory of Computing (1996) 296); of the other contacts, those kept are drawn
without replacement, all with equal probability.
"""

from __future__ import annotations

import numpy as np

from rheoclast import _checks
from rheoclast._checks import IntArray, seeded
from rheoclast.generation.lattices import lattice_ball
from rheoclast.particles.aggregate import Aggregate
from rheoclast.particles.morphology import mean_coordination


def thinned(aggregate: Aggregate, coordination: float, *, seed: int = 0) -> Aggregate:
    """The same spheres, connected, with contacts taken away at random down to a mean coordination number.

    Parameters
    ----------
    coordination
        Mean number of contacts of a sphere, met to the nearest contact: from 2 − 2/N, a tree, to that of `aggregate`.
    seed
        Equal seeds give equal contacts.

    Notes
    -----
    Spheres without their contact still touch: coordinates alone, in a file or through `Aggregate.touching`, bring all
    contacts back.

    Raises
    ------
    ValueError
        If the coordination is below that of a tree or above that of `aggregate`.
    """
    _checks.instance("aggregate", aggregate, Aggregate, "make one with Aggregate.touching(spheres)")
    kept = _contact_number(aggregate, _checks.not_negative("coordination", coordination))
    rng = seeded(seed)
    tree = _uniform_spanning_tree(len(aggregate), aggregate.pairs, rng)
    others = np.setdiff1d(np.arange(len(aggregate.pairs)), tree)
    chosen = np.concatenate([tree, rng.choice(others, kept - len(tree), replace=False)])
    return Aggregate(aggregate.spheres, aggregate.pairs[np.sort(chosen)])


def thinned_fcc_ball(count: int, coordination: float, radius: float = 1.0, *, seed: int = 0) -> Aggregate:
    """Ball of `count` spheres, `radius` in m, on the face-centred cubic lattice, thinned to a mean coordination."""
    return thinned(lattice_ball("fcc", count, radius), coordination, seed=seed)


def _contact_number(aggregate: Aggregate, coordination: float) -> int:
    count, most = len(aggregate), len(aggregate.pairs)
    number = round(coordination * count / 2)
    if not count - 1 <= number <= most:
        raise ValueError(
            f"coordination: expected from {2 - 2 / count:.4g} (a tree) to {mean_coordination(aggregate):.4g} "
            f"(all {most} contacts of the {count} spheres), got {coordination:.4g}"
        )
    return number


def _uniform_spanning_tree(count: int, pairs: IntArray, rng: np.random.Generator) -> IntArray:
    """Indices (N − 1,) of contacts that form a random spanning tree.

    From each sphere not yet in the tree a random walk runs into it. The contact by which the walk last left a sphere is
    the one that counts, which erases its loops.
    """
    around: list[list[tuple[int, int]]] = [[] for _ in range(count)]
    for contact, (i, j) in enumerate(pairs.tolist()):
        around[i].append((j, contact))
        around[j].append((i, contact))
    in_tree = [False] * count
    in_tree[int(rng.integers(count))] = True
    leave = [(0, 0)] * count
    tree = []
    for start in range(count):
        sphere = start
        while not in_tree[sphere]:
            leave[sphere] = around[sphere][int(rng.random() * len(around[sphere]))]
            sphere = leave[sphere][0]
        sphere = start
        while not in_tree[sphere]:
            in_tree[sphere] = True
            sphere, contact = leave[sphere]
            tree.append(contact)
    return np.array(tree, dtype=np.intp)
