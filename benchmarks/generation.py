"""Time to grow an aggregate of each family against its number of spheres.

python benchmarks/generation.py [--largest 100000]
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable

import numpy as np
from rich.console import Console
from rich.table import Table

import rheoclast as rc
from rheoclast import generation

SIZES = (1_000, 10_000, 100_000)

FAMILIES: dict[str, tuple[Callable[[int], rc.Aggregate], int]] = {
    "ballistic particle–cluster": (generation.ballistic_particle_cluster, SIZES[-1]),
    "ballistic cluster–cluster": (generation.ballistic_cluster_cluster, SIZES[-1]),
    "diffusion-limited particle–cluster": (generation.diffusion_limited_particle_cluster, SIZES[-1]),
    "diffusion-limited cluster–cluster": (generation.diffusion_limited_cluster_cluster, SIZES[-1]),
    "reaction-limited cluster–cluster": (generation.reaction_limited_cluster_cluster, 10_000),
    "tunable, dimension 1.8": (generation.cluster_cluster, SIZES[-1]),
    "tunable, dimension 2.3": (lambda n: generation.cluster_cluster(n, fractal_dimension=2.3), SIZES[-1]),
    "ballistic, one migration": (generation.ballistic_migration, SIZES[-1]),
    "ballistic, two migrations": (lambda n: generation.ballistic_migration(n, migrations=2), SIZES[-1]),
    "random close-packed ball": (generation.random_packed_ball, 10_000),
    "fcc ball": (lambda n: generation.lattice_ball("fcc", n), SIZES[-1]),
    "thinned fcc ball": (lambda n: generation.thinned_fcc_ball(n, 5.0), SIZES[-1]),
    "compacted cluster": (lambda n: generation.compacted_cluster(n, amount=0.5), 1_000),
}


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--largest", type=int, default=10_000)
    largest = parser.parse_args().largest
    sizes = [size for size in SIZES if size <= largest]
    table = Table("family", *(f"{size} spheres, s" for size in sizes), "exponent")
    for name, (grow, most) in FAMILIES.items():
        grow(100)  # compiles
        times = {}
        for size in (size for size in sizes if size <= most):
            start = time.perf_counter()
            grow(size)
            times[size] = time.perf_counter() - start
        slope = np.polyfit(np.log(list(times)), np.log(list(times.values())), 1)[0] if len(times) > 1 else np.nan
        shown = [f"{times[size]:.2f}" if size in times else "–" for size in sizes]
        table.add_row(name, *shown, f"{slope:.2f}" if len(times) > 1 else "–")
    Console(width=120).print(table)


if __name__ == "__main__":
    main()
