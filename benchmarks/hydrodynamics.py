"""Time of all eleven problems against the number of spheres: iterative, dense, and other codes.

Everything runs side by side on one machine; ratios come first. Draws hydrodynamics.png beside this file.

python benchmarks/hydrodynamics.py [--largest 10000] [--peers]
"""

from __future__ import annotations

import argparse
import resource
import time
from collections.abc import Callable
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from peers import PEERS
from rich.console import Console
from rich.table import Table

import rheoclast as rc
from rheoclast.stokes.dense import DenseCholesky
from rheoclast.stokes.iterative import BlockConjugateGradients

SIZES = (100, 300, 1000, 3000, 10_000, 30_000, 100_000)
LARGEST_DENSE = 1000
LARGEST_PEER = 1000
FLOW = rc.simple_shear(1.0)


def open_cluster(count: int, seed: int = 0) -> rc.Aggregate:
    """Tree of touching spheres: each sticks to a random one of the last few dozen, which keeps it open."""
    random = np.random.default_rng(seed)
    cells: dict[tuple[int, int, int], list[int]] = {}
    centers = np.zeros((count, 3))
    placed = 0
    while placed < count:
        place = np.zeros(3)
        if placed:
            direction = random.normal(size=3)
            host = random.integers(max(0, placed - 40), placed)
            place = centers[host] + 2 * direction / np.linalg.norm(direction)
        cell = tuple(np.floor(place / 2).astype(int))
        around = [
            other
            for x in range(cell[0] - 1, cell[0] + 2)
            for y in range(cell[1] - 1, cell[1] + 2)
            for z in range(cell[2] - 1, cell[2] + 2)
            for other in cells.get((x, y, z), [])
        ]
        if not around or ((centers[around] - place) ** 2).sum(axis=1).min() >= 4 - 1e-9:
            centers[placed] = place
            cells.setdefault(cell, []).append(placed)
            placed += 1
    return rc.Aggregate.touching(rc.Spheres(centers, 1.0), tolerance=1e-6)


def timed(task: Callable[[], object], least: float = 0.5) -> float:
    """Seconds of the fastest of several runs, after one to warm up where a run is short."""
    best, spent = np.inf, 0.0
    while spent < least:
        start = time.perf_counter()
        task()
        best = min(best, time.perf_counter() - start)
        spent += time.perf_counter() - start
    return best


def solve(aggregate: rc.Aggregate, order: int, solver: object) -> rc.RigidResponse:
    """All eleven problems."""
    return rc.rigid_response(aggregate.spheres, rc.StokesianDynamics(order, solver=solver), viscosity=1.0)


def contact_error(aggregate: rc.Aggregate, ours: rc.RigidResponse, exact: rc.RigidResponse) -> float:
    """Largest difference of a contact force over the largest contact force."""
    tables = [rc.contact_response(aggregate, each).force for each in (ours, exact)]
    return float(np.abs(tables[0] - tables[1]).max() / np.abs(tables[1]).max())


def exponent(times: dict[int, float], smallest: int) -> float:
    """Fitted power of time against number from a size on."""
    sizes = [size for size in times if size >= smallest]
    return float(np.polyfit(np.log(sizes), np.log([times[size] for size in sizes]), 1)[0])


def main() -> None:
    """Run, print, draw."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--largest", type=int, default=3000)
    parser.add_argument("--peers", action="store_true")
    options = parser.parse_args()
    table = Table(
        "spheres",
        "dense / iterative",
        "loads differ",
        "iterative, s",
        "iterations",
        "dense, s",
        *(PEERS if options.peers else ()),
    )
    iterative, dense = {}, {}
    solver = BlockConjugateGradients()
    for count in (size for size in SIZES if size <= options.largest):
        aggregate = open_cluster(count)
        response = solve(aggregate, 2, solver)
        iterative[count] = timed(lambda aggregate=aggregate: solve(aggregate, 2, solver))
        ratio = error = seconds = "–"
        if count <= LARGEST_DENSE:
            dense[count] = timed(lambda aggregate=aggregate: solve(aggregate, 2, DenseCholesky()))
            exact = solve(aggregate, 2, DenseCholesky())
            ratio, seconds = f"{dense[count] / iterative[count]:.1f}", f"{dense[count]:.3f}"
            error = f"{contact_error(aggregate, response, exact):.0e}"
        others = []
        if options.peers:
            for peer in PEERS.values():
                fits = count <= LARGEST_PEER
                others.append(f"{timed(lambda peer=peer, a=aggregate: peer(a.spheres.centers)):.2f}" if fits else "–")
        iterations = str(response.convergence.iterations)
        table.add_row(str(count), ratio, error, f"{iterative[count]:.3f}", iterations, seconds, *others)
    console = Console()
    console.print(table)
    for name, times in (("iterative", iterative), ("dense", dense)):
        console.print(f"{name}: time grows like N^{exponent(times, 300):.2f} from 300 spheres on")
    console.print(f"largest memory: {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6:.2f} GB")
    draw(iterative, dense).savefig(Path(__file__).with_suffix(".png"), dpi=110)


def draw(iterative: dict[int, float], dense: dict[int, float]) -> plt.Figure:
    """Time against number of spheres."""
    figure, panel = plt.subplots(figsize=(6, 4.5), layout="constrained")
    for name, times, colour in (("iterative", iterative, "#0072b2"), ("dense Cholesky", dense, "#d55e00")):
        label = f"{name}: N^{exponent(times, 300):.2f}"
        panel.loglog(list(times), list(times.values()), "o-", color=colour, label=label)
    panel.set(xlabel="spheres", ylabel="seconds, all eleven problems, order 2")
    panel.grid(alpha=0.3, lw=0.5)
    panel.legend(frameon=False)
    return figure


if __name__ == "__main__":
    main()
