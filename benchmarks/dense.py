"""Time of the dense solution of all eleven problems, by order and size: pair mobilities, factorization, everything.

python benchmarks/dense.py
"""

from __future__ import annotations

import time

import numpy as np
from rich.console import Console
from rich.table import Table

import rheoclast as rc
from rheoclast.stokes.basis import MultipoleBasis
from rheoclast.stokes.mobility import Mobility

CASES = [(100, 2), (300, 2), (100, 3), (200, 3), (100, 4)]


def random_tree(count: int) -> rc.Spheres:
    """Spheres stuck to one another at random, without overlap."""
    random = np.random.default_rng(count)
    centers = np.zeros((1, 3))
    while len(centers) < count:
        direction = random.normal(size=3)
        place = centers[random.integers(len(centers))] + 2 * direction / np.linalg.norm(direction)
        if np.linalg.norm(centers - place, axis=1).min() >= 2 - 1e-12:
            centers = np.vstack([centers, place])
    return rc.Spheres(centers, 1.0)


def main() -> None:
    """Print the table."""
    table = Table("spheres", "order", "unknowns", "assembly, s", "everything, s", "memory, GB")
    for count, order in CASES:
        spheres, model = random_tree(count), rc.StokesianDynamics(order)
        start = time.perf_counter()
        Mobility(spheres.centers, spheres.radii, MultipoleBasis(order)).matrix()
        assembled = time.perf_counter()
        rc.rigid_response(spheres, model, viscosity=1.0)
        solved = time.perf_counter()
        unknowns = count * MultipoleBasis(order).size
        times = (f"{assembled - start:.2f}", f"{solved - assembled:.2f}")
        table.add_row(str(count), str(order), str(unknowns), *times, f"{model.memory(count) / 1e9:.2f}")
    Console().print(table)


if __name__ == "__main__":
    main()
