"""Time and memory of contact loads against the number of spheres: statics of trees, springs at coordination 5.

python benchmarks/structure.py
"""

from __future__ import annotations

import multiprocessing
import resource
import time
from collections.abc import Callable

import numpy as np
from rich.console import Console
from rich.table import Table
from scipy.sparse import coo_array
from scipy.sparse.csgraph import breadth_first_order, connected_components
from scipy.spatial import cKDTree

import rheoclast as rc

COUNTS = (1_000, 10_000, 100_000)
CASES = 5
OCCUPANCY = 0.42  # of the sites of an fcc lattice: coordination 5
BONDS = rc.Bonds(
    normal=1.0, tangential=0.8, bending=5.7e-3, twisting=7.7e-3
)  # ratios of the JKR example in micrometres


def porous_ball(count: int) -> rc.Aggregate:
    """Connected spheres on random sites of an fcc lattice, those that the fewest contacts join to the middle one."""
    random = np.random.default_rng(count)
    side = int(np.ceil((2.6 * count / OCCUPANCY) ** (1 / 3))) + 2
    sites = np.indices((side, side, side)).reshape(3, -1).T
    sites = sites[(sites.sum(axis=1) % 2 == 0) & (random.random(len(sites)) < OCCUPANCY)]
    pairs = cKDTree(sites).query_pairs(1.5, output_type="ndarray")
    graph = coo_array((np.ones(len(pairs)), pairs.T), shape=(len(sites),) * 2).tocsr()
    part = connected_components(graph, directed=False)[1]
    inside = np.flatnonzero(part == np.bincount(part).argmax())
    middle = inside[np.argmin(((sites[inside] - side / 2) ** 2).sum(axis=1))]
    nearest = breadth_first_order(graph, middle, directed=False, return_predecessors=False)[:count]
    return rc.Aggregate.touching(rc.Spheres(np.sqrt(2.0) * sites[nearest], 1.0))


def balanced_loads(aggregate: rc.Aggregate) -> rc.SphereLoads:
    """Random loads of order one whose totals vanish; twice, and summed with care, for what rounding left."""
    centers = aggregate.spheres.centers - aggregate.spheres.center_of_mass
    force, torque = np.random.default_rng(0).normal(size=(2, CASES, len(aggregate), 3))
    for _ in range(2):
        force -= force.mean(axis=1, keepdims=True)
        total = (torque + np.cross(centers, force)).sum(axis=1, keepdims=True, dtype=np.longdouble)
        torque -= (total / len(aggregate)).astype(float)
    return rc.SphereLoads(force, torque)


def largest(loads: rc.SphereLoads | rc.ContactLoads, *names: str) -> float:
    """Largest component of several arrays."""
    return max(float(np.abs(getattr(loads, name)).max()) for name in names)


def left_over(aggregate: rc.Aggregate, loads: rc.SphereLoads, carried: rc.ContactLoads) -> rc.SphereLoads:
    """What is not in balance on every sphere."""
    force, torque = loads.force.copy(), loads.torque.copy()
    for end, sign in ((0, 1.0), (1, -1.0)):
        sphere = aggregate.pairs[:, end]
        arm = aggregate.contact_points - aggregate.spheres.centers[sphere]
        for case in range(CASES):
            np.add.at(force[case], sphere, sign * carried.force[case])
            np.add.at(torque[case], sphere, sign * (np.cross(arm, carried.force[case]) + carried.moment[case]))
    return rc.SphereLoads(force, torque)


def measured(build: Callable[[int], rc.Aggregate], count: int) -> dict[str, float]:
    """One solution: contacts of a sphere, seconds, gigabytes added at the peak, and loads over the largest load."""
    aggregate = build(count)
    loads = balanced_loads(aggregate)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    start = time.perf_counter()
    carried = rc.contact_loads(aggregate, loads, BONDS)
    seconds = time.perf_counter() - start
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    unit = largest(loads, "force", "torque")
    return {
        "contacts": 2 * len(aggregate.pairs) / count,
        "seconds": seconds,
        "GB": memory / 1e6,
        "moment": largest(carried, "moment") / unit,
        "left": largest(left_over(aggregate, loads, carried), "force", "torque") / unit,
    }


def main() -> None:
    """Print the table: the exponent of time is fitted to the sizes so far."""
    columns = ("contacts", "seconds", "GB", "moment", "left")
    table = Table(
        "",
        "spheres",
        *columns,
        "power",
        title="Contacts per sphere; largest moment and load left over, per largest load",
    )
    for name, build in (("tree", rc.generation.ballistic_cluster_cluster), ("loops", porous_ball)):
        times: list[float] = []
        for count in COUNTS:
            with multiprocessing.get_context("spawn").Pool(1) as fresh:  # the peak of memory is that of a process
                figures = fresh.apply(measured, (build, count))
            times.append(figures["seconds"])
            exponent = np.polyfit(np.log(COUNTS[: len(times)]), np.log(times), 1)[0] if len(times) > 1 else np.nan
            table.add_row(name, str(count), *(f"{figures[column]:.2g}" for column in columns), f"{exponent:.2f}")
    Console().print(table)


if __name__ == "__main__":
    main()
