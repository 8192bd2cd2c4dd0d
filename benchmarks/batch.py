"""Aggregates per second from spheres to contact loads, and what is spent outside the solver.

python benchmarks/batch.py [--count 1000]
"""

from __future__ import annotations

import argparse
import time

import numpy as np
from rich.console import Console
from rich.progress import track
from rich.table import Table

import rheoclast as rc

SIZES = (50, 200)
BONDS = rc.Bonds(normal=1.0, tangential=0.8, bending=5.7e-3, twisting=7.7e-3)


def solver_seconds(response: rc.RigidResponse) -> float:
    """Time that the solver took; the lower orders of a dense solution come with it."""
    lower, total = response.coarser, response.convergence.seconds
    while lower is not None and lower.convergence.iterations:
        lower, total = lower.coarser, total + lower.convergence.seconds
    return total


def main() -> None:
    """Run and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=1000)
    count = parser.parse_args().count
    sizes = np.random.default_rng(0).integers(SIZES[0], SIZES[1], count, endpoint=True)
    flocs = [rc.generation.cluster_cluster(int(size), seed=seed) for seed, size in enumerate(sizes)]
    model = rc.StokesianDynamics()
    solving, seconds = np.empty(count), np.empty(count)
    rc.contact_response(flocs[0], rc.rigid_response(flocs[0].spheres, model, viscosity=1.0), BONDS)
    for k, floc in enumerate(track(flocs, "aggregates")):
        start = time.perf_counter()
        response = rc.rigid_response(floc.spheres, model, viscosity=1.0)
        rc.contact_response(floc, response, BONDS)
        seconds[k] = time.perf_counter() - start
        solving[k] = solver_seconds(response)
    table = Table("aggregates", "spheres", "aggregates per second", "median ms", "median ms outside the solver")
    outside = 1e3 * np.median(seconds - solving)
    speed = f"{count / seconds.sum():.0f}"
    table.add_row(str(count), f"{SIZES[0]}–{SIZES[1]}", speed, f"{1e3 * np.median(seconds):.1f}", f"{outside:.2f}")
    Console().print(table)


if __name__ == "__main__":
    main()
