"""Time of all eleven problems against the number of spheres: iterative, dense, and other codes.

Everything runs side by side on one machine; ratios come first. Draws hydrodynamics.png beside this file.

python benchmarks/hydrodynamics.py [--largest 10000] [--dimension 1.8] [--peers]
"""

from __future__ import annotations

import argparse
import resource
import time
from collections.abc import Callable, Sequence
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from peers import PEERS
from rich.console import Console
from rich.table import Table

import rheoclast as rc
from rheoclast.stokes.dense import DenseCholesky
from rheoclast.stokes.direct_sum import pair_velocities
from rheoclast.stokes.iterative import BlockConjugateGradients
from rheoclast.stokes.solver import Solver

SIZES = (100, 300, 1000, 3000, 10_000, 30_000, 100_000)
LARGEST_DENSE = 1000
LARGEST_PEER = 1000
LARGEST_REPEATED = 10_000
FITTED_FROM = (300, 10_000)
ORDERS = (2, 3, 4)
SPHERES_OF_ORDERS = 1000
FLOPS_OF_A_PAIR = 225
BONDS = rc.Bonds(normal=1.0, tangential=0.8, bending=5.7e-3, twisting=7.7e-3)


def cluster(count: int, dimension: float) -> rc.Aggregate:
    """Cluster–cluster aggregate of unit spheres."""
    return rc.generation.cluster_cluster(count, fractal_dimension=dimension, seed=1)


def timed(task: Callable[[], object], least: float = 0.5) -> float:
    """Seconds of the fastest of several runs, after those already made to warm up."""
    best, spent = np.inf, 0.0
    while spent < least:
        start = time.perf_counter()
        task()
        best = min(best, time.perf_counter() - start)
        spent += time.perf_counter() - start
    return best


def solve(aggregate: rc.Aggregate, order: int, solver: Solver) -> rc.RigidResponse:
    """All eleven problems, and those of the order below for the error bar."""
    return rc.rigid_response(aggregate.spheres, rc.StokesianDynamics(order, solver=solver), viscosity=1.0)


def contact_error(aggregate: rc.Aggregate, ours: rc.RigidResponse, exact: rc.RigidResponse) -> float:
    """Largest difference of a contact force over the largest contact force."""
    tables = [rc.contact_response(aggregate, each, BONDS).force for each in (ours, exact)]
    return float(np.abs(tables[0] - tables[1]).max() / np.abs(tables[1]).max())


def exponent(times: dict[int, float], smallest: int) -> float:
    """Fitted power of time against number from a size on."""
    sizes = [size for size in times if size >= smallest]
    return float(np.polyfit(np.log(sizes), np.log([times[size] for size in sizes]), 1)[0])


def by_size(sizes: Sequence[int], dimension: float, peers: bool) -> tuple[Table, dict[int, float], dict[int, float]]:
    """The table, and seconds of the iterative and the dense solution by size."""
    names = list(PEERS) if peers else []
    columns = ("spheres", "dense / iterative", *(f"{name} / iterative" for name in names))
    table = Table(*columns, "iterative, s", "dense, s", "iterations", "loads differ", "memory, GB")
    iterative, dense, solver = {}, {}, BlockConjugateGradients()
    for count in sizes:
        aggregate = cluster(count, dimension)
        start = time.perf_counter()
        response = solve(aggregate, 2, solver)
        iterative[count] = time.perf_counter() - start
        if count <= LARGEST_REPEATED:
            iterative[count] = timed(lambda aggregate=aggregate: solve(aggregate, 2, solver))
        ratio = seconds = error = "–"
        if count <= LARGEST_DENSE:
            exact = solve(aggregate, 2, DenseCholesky())
            dense[count] = timed(lambda aggregate=aggregate: solve(aggregate, 2, DenseCholesky()))
            ratio, seconds = f"{dense[count] / iterative[count]:.1f}", f"{dense[count]:.3f}"
            error = f"{contact_error(aggregate, response, exact):.0e}"
        others = []
        for name in names:
            fits = count <= LARGEST_PEER
            taken = timed(lambda name=name, a=aggregate: PEERS[name](a.spheres.centers)) if fits else np.nan
            others.append(f"{taken / iterative[count]:.1f}" if fits else "–")
        memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6
        iterations = str(response.convergence.iterations)
        table.add_row(
            str(count), ratio, *others, f"{iterative[count]:.3g}", seconds, iterations, error, f"{memory:.1f}"
        )
    return table, iterative, dense


def by_order(dimension: float) -> Table:
    """Time against multipole order."""
    table = Table("order", f"time / order 2, {SPHERES_OF_ORDERS} spheres", "iterative, s", "iterations")
    aggregate, times, solver = cluster(SPHERES_OF_ORDERS, dimension), {}, BlockConjugateGradients()
    for order in ORDERS:
        response = solve(aggregate, order, solver)
        times[order] = timed(lambda order=order: solve(aggregate, order, solver), least=3.0)
        iterations = str(response.convergence.iterations)
        table.add_row(str(order), f"{times[order] / times[2]:.1f}", f"{times[order]:.2f}", iterations)
    return table


def kernel_speed(count: int = 3000) -> str:
    """How fast order 2 sums over pairs, against the machine's matrix product."""
    random = np.random.default_rng(0)
    centers, loads = 60 * random.normal(size=(3, count)), random.normal(size=(11, 11, count))
    everyone = np.zeros(count, np.intp), np.array([0, 1]), np.array([[0, count]])
    motion, matrix = np.zeros_like(loads), random.normal(size=(2500, 2500))
    pair_velocities(centers, np.ones(count), loads, *everyone, motion)
    pairs = 11 * count**2 / timed(lambda: pair_velocities(centers, np.ones(count), loads, *everyone, motion))
    peak = 2 * 2500**3 / timed(lambda: matrix @ matrix)
    return (
        f"{pairs / 1e6:.0f} million pairs and right-hand sides per second; at {FLOPS_OF_A_PAIR} operations as written "
        f"that is {FLOPS_OF_A_PAIR * pairs / peak:.2f} of the matrix product's {peak / 1e9:.0f} GFLOP/s"
    )


def main() -> None:
    """Run, print, draw."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--largest", type=int, default=3000)
    parser.add_argument("--dimension", type=float, default=1.8)
    parser.add_argument("--peers", action="store_true")
    options = parser.parse_args()
    console = Console(width=140)
    console.print(kernel_speed())
    sizes = [size for size in SIZES if size <= options.largest]
    table, iterative, dense = by_size(sizes, options.dimension, options.peers)
    console.print(table)
    for name, times in (("iterative", iterative), ("dense", dense)):
        for least in (least for least in FITTED_FROM if max(times) > least):
            console.print(f"{name}: N^{exponent(times, least):.2f} from {least} spheres on")
    console.print(by_order(options.dimension))
    draw(iterative, dense).savefig(Path(__file__).with_suffix(".png"), dpi=100)


def draw(iterative: dict[int, float], dense: dict[int, float]) -> plt.Figure:
    """Time against number of spheres."""
    figure, panel = plt.subplots(figsize=(6, 4.5), layout="constrained")
    for name, times, colour in (("iterative", iterative, "#0072b2"), ("dense Cholesky", dense, "#d55e00")):
        label = ", ".join(
            f"N^{exponent(times, least):.2f} from {least} on" for least in FITTED_FROM if max(times) > least
        )
        label = f"{name}: {label}"
        panel.loglog(list(times), list(times.values()), "o-", color=colour, label=label)
    panel.set(xlabel="spheres", ylabel="seconds, all eleven problems, order 2")
    panel.grid(alpha=0.3, lw=0.5)
    panel.legend(frameon=False)
    return figure


if __name__ == "__main__":
    main()
