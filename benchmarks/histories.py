"""Time of a long gradient history: the trajectory of one aggregate, and its largest load ratio at every instant.

python benchmarks/histories.py [--instants 1000000]
"""

from __future__ import annotations

import argparse
import time

from rich.console import Console
from rich.table import Table

import rheoclast as rc

SIZES = (30, 100, 300, 900)
STEP = 0.1  # Kolmogorov times


def row(count: int, history: rc.GradientHistory) -> tuple[str, ...]:
    """Seconds for one aggregate."""
    aggregate = rc.generation.cluster_cluster(count, seed=1)
    response = rc.rigid_response(aggregate.spheres, rc.StokesianDynamics(), viscosity=1.0)
    bonds = rc.Bonds(1.0, 0.8, 6e-3, 8e-3, tensile_strength=2.0)
    table = rc.contact_response(aggregate, response, bonds)
    start = time.perf_counter()
    orbit = rc.trajectory(response, history)
    turned = time.perf_counter()
    loads = rc.load_history(orbit, table, bonds, times=history.times)
    done = time.perf_counter()
    seconds = (turned - start, done - turned, done - start)
    return (str(count), str(len(loads.largest)), *(f"{each:.2f}" for each in seconds))


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--instants", type=int, default=1_000_000)
    instants = parser.parse_args().instants
    (history,) = rc.gaussian_histories(1, (instants - 1) * STEP, 1.0, 1.0, seed=1, step=STEP)
    row(SIZES[0], rc.gaussian_histories(1, 100 * STEP, 1.0, 1.0, seed=1, step=STEP)[0])  # compiles
    table = Table("spheres", "instants", "trajectory, s", "loads, s", "together, s")
    for count in SIZES:
        table.add_row(*row(count, history))
    Console(width=100).print(table)


if __name__ == "__main__":
    main()
