"""Families of clusters: open trees, straight chains, compact pieces, each from a seed. Radii near one."""

from __future__ import annotations

import itertools

import numpy as np
from scipy.spatial.transform import Rotation

import rheoclast as rc


def tree(count: int, seed: int, spread: float = 0.0) -> rc.Aggregate:
    """Open cluster without loops: clusters of like size are joined on straight paths, at random offset and orientation.

    `spread` is the standard deviation of the logarithm of the radii.
    """
    random = np.random.default_rng(seed)
    clusters = [(np.zeros((1, 3)), radius[None]) for radius in np.exp(spread * random.standard_normal(count))]
    while len(clusters) > 1:
        clusters.sort(key=lambda cluster: len(cluster[1]))
        first, second = clusters.pop(0), clusters.pop(0)
        clusters.append(_joined(first, second, random))
    return rc.Aggregate.touching(rc.Spheres(*clusters[0]), tolerance=1e-6)


def chain(count: int) -> rc.Aggregate:
    """Straight chain along x."""
    return rc.Aggregate.touching(rc.Spheres(np.outer(2.0 * np.arange(count), [1, 0, 0]), 1.0))


def fcc_ball(count: int) -> rc.Aggregate:
    """The `count` sites of a face-centred cubic lattice that are nearest to one of them."""
    sites = np.array([site for site in itertools.product(range(-5, 6), repeat=3) if sum(site) % 2 == 0])
    nearest = np.argsort((sites**2).sum(axis=1), kind="stable")[:count]
    return rc.Aggregate.touching(rc.Spheres(np.sqrt(2) * sites[nearest], 1.0))


def dense(count: int, seed: int) -> rc.Aggregate:
    """Compact irregular cluster: every sphere after the first four rests on three others, near the middle."""
    random = np.random.default_rng(seed)
    centers = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) / np.sqrt(2)
    while len(centers) < count:
        places = _resting_places(centers)
        nearest = np.argsort(np.linalg.norm(places - centers.mean(axis=0), axis=1))[: max(3, len(places) // 4)]
        centers = np.vstack([centers, places[random.choice(nearest)]])
    return rc.Aggregate.touching(rc.Spheres(centers, 1.0), tolerance=1e-6)


def _joined(first, second, random):
    (a, radii_a), (b, radii_b) = ((_turned(centers, random), radii) for centers, radii in (first, second))
    reach = np.linalg.norm(a, axis=1).max() + np.linalg.norm(b, axis=1).max() + radii_a.max() + radii_b.max()
    while True:
        offset = reach * np.sqrt(random.random()) * np.exp(2j * np.pi * random.random())
        apart = b[:, None] + np.array([offset.real, offset.imag, 0]) - a
        room = (radii_b[:, None] + radii_a) ** 2 - (apart[..., :2] ** 2).sum(axis=-1)
        if (room > 0).any():
            break
    rise = np.where(room > 0, np.sqrt(np.maximum(room, 0)) - apart[..., 2], -np.inf).max()
    return np.vstack([a, b + np.array([offset.real, offset.imag, rise])]), np.concatenate([radii_a, radii_b])


def _turned(centers, random):
    return (centers - centers.mean(axis=0)) @ Rotation.random(random_state=random).as_matrix().T


def _resting_places(centers):
    """Places of a sphere that touches three others and overlaps none."""
    places = []
    for p, q, r in itertools.combinations(centers, 3):
        edge = q - p
        d = np.linalg.norm(edge)
        x = edge / d
        along = x @ (r - p)
        across = r - p - along * x
        height = np.linalg.norm(across)
        if height < 1e-9:
            continue
        y = across / height
        v = ((along**2 + height**2) / 2 - along * d / 2) / height
        w2 = 4 - d**2 / 4 - v**2
        if w2 >= 0:
            places += [p + d / 2 * x + v * y + sign * np.sqrt(w2) * np.cross(x, y) for sign in (1, -1)]
    places = np.array(places)
    free = [np.linalg.norm(centers - place, axis=1).min() > 2 - 1e-9 for place in places]
    return places[free]
