"""Aggregates for the agreement tests: spheres stuck to one another at random places, from a seed."""

import numpy as np


def sticking_cluster(count, seed, radii=1.0):
    """Centres (N, 3) and radii (N,) of a tree in which every new sphere touches a random earlier one.

    `radii` is one value for all or a pair (smallest, largest) between which they are drawn.
    """
    random = np.random.default_rng(seed)
    sizes = random.uniform(*radii, count) if np.ndim(radii) else np.full(count, radii)
    centers = [random.normal(size=3)]
    while len(centers) < count:
        new = len(centers)
        host = int(random.integers(new))
        direction = random.normal(size=3)
        place = centers[host] + (sizes[host] + sizes[new]) * direction / np.linalg.norm(direction)
        distances = np.linalg.norm(np.delete(centers, host, axis=0) - place, axis=1)
        if np.all(distances >= np.delete(sizes[:new], host) + sizes[new]):
            centers.append(place)
    return np.array(centers), sizes


def traceless_gradient(seed):
    """A random velocity gradient (3, 3) without trace."""
    gradient = np.random.default_rng(seed).normal(size=(3, 3))
    return gradient - np.trace(gradient) / 3 * np.eye(3)
