"""Time of a running crack: joints removed one after the other, against assembling and factorizing for each anew.

Always the joint of largest tension goes, in a uniaxial extension of free-draining spheres, until the frame falls apart
or `--joints` are gone. A second table has whole events of 300 spheres, from the known response to the fragments, in
random orientations at order 2, with and without the ties that the error bar of the hydrodynamics tells.

python benchmarks/removal.py [--joints 300] [--largest 3000]
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from rich.console import Console
from rich.table import Table

import rheoclast as rc
from rheoclast.frames.removal import CollapseError, LoadedFrame, removable_frame
from rheoclast.frames.springs import spring_frame

SIZES = (300, 1_000, 3_000)
EVENTS, SPHERES_OF_EVENTS = 5, 300
ANEW = 5  # solutions anew along a crack
STIFFNESS = (1.0, 0.8, 5.7e-3, 7.7e-3)

FAMILIES: dict[str, Callable[[int], rc.Aggregate]] = {
    "fcc ball": lambda count: rc.generation.lattice_ball("fcc", count),
    "packed ball": lambda count: rc.generation.random_packed_ball(count, seed=1),
    "compacted, half": lambda count: rc.generation.compacted_cluster(count, amount=0.5, seed=1),
}


def extension_loads(aggregate: rc.Aggregate) -> np.ndarray:
    """Loads (N, 6, 1) in units of the largest."""
    response = rc.rigid_response(aggregate.spheres, rc.FreeDraining(), viscosity=1.0)
    loads = response.loads(rc.uniaxial_extension(1.0))
    length = aggregate.spheres.radii.mean()
    both = np.concatenate([loads.force, loads.torque / length], axis=1)
    return both[:, :, None] / np.abs(both).max()


def crack(state: LoadedFrame, normals: np.ndarray, joints: int) -> tuple[list[LoadedFrame], float]:
    """States after each removal, and the seconds that all took."""
    states, seconds = [state], 0.0
    while len(states) <= joints:
        tension = (normals * states[-1].joint_loads[:, :3, 0]).sum(axis=1)
        start = time.perf_counter()
        try:
            states.append(states[-1].without(int(tension.argmax())))
        except CollapseError:
            break
        finally:
            seconds += time.perf_counter() - start
    return states, seconds


def solved_anew(
    geometry: tuple[np.ndarray, ...], stiffness: np.ndarray, states: list[LoadedFrame]
) -> tuple[float, float]:
    """Seconds of one solution of the joints that remain, and the largest difference over the largest joint load."""
    seconds, difference = [], 0.0
    nodes, pairs, points = geometry
    for state in states[-1 :: -max(len(states) // ANEW, 1)]:
        start = time.perf_counter()
        there = np.delete(np.arange(len(pairs)), state.removed)
        anew = spring_frame(nodes, pairs[there], points[there], stiffness[there]).joint_loads(state.loads)
        seconds.append(time.perf_counter() - start)
        difference = max(difference, np.abs(state.joint_loads[there] - anew).max() / np.abs(anew).max())
    return float(np.mean(seconds)), float(difference)


def row(name: str, count: int, joints: int) -> tuple[str, ...]:
    """One crack."""
    aggregate = FAMILIES[name](count)
    length, pairs = aggregate.spheres.radii.mean(), aggregate.pairs
    geometry = (aggregate.spheres.centers / length, pairs, aggregate.contact_points / length)
    stiffness, loads = np.tile(STIFFNESS, (len(pairs), 1)), extension_loads(aggregate)
    start = time.perf_counter()
    intact = removable_frame(*geometry, stiffness).loaded(loads)
    first = time.perf_counter() - start
    states, seconds = crack(intact, aggregate.normals, joints)
    removed = len(states) - 1
    each = (first + seconds) / removed
    anew, difference = solved_anew(geometry, stiffness, states)
    worst = max(state.residual for state in states)
    figures = (f"{1e3 * each:.2f}", f"{1e3 * anew:.1f}", f"{anew / each:.0f}", f"{worst:.1g}", f"{difference:.1g}")
    return (name, str(count), f"{2 * len(pairs) / count:.2f}", str(removed), *figures)


def event_row(name: str) -> tuple[str, ...]:
    """Seconds of a whole event."""
    aggregate = FAMILIES[name](SPHERES_OF_EVENTS)
    response = rc.rigid_response(aggregate.spheres, rc.StokesianDynamics(), viscosity=1.0)
    bonds = rc.Bonds(*STIFFNESS, tensile_strength=1.0)
    flows = [rc.uniaxial_extension(1.0).rotated(each) for each in rc.random_orientations(EVENTS, seed=1)]
    seconds, failures = [], []
    for each in (response, replace(response, coarser=None)):
        start = time.perf_counter()
        failures = [len(rc.break_up(aggregate, each, bonds, flow).failures) for flow in flows]
        seconds.append((time.perf_counter() - start) / EVENTS)
    return (name, f"{np.mean(failures):.0f}", *(f"{each:.2f}" for each in seconds))


def main() -> None:
    """Print the tables; the time of a removal includes its share of the first factorization."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--joints", type=int, default=300)
    parser.add_argument("--largest", type=int, default=SIZES[-1])
    arguments = parser.parse_args()
    table = Table(
        "", "spheres", "contacts", "removed", "each, ms", "anew, ms", "anew / each", "unbalanced", "loads differ"
    )
    for name in FAMILIES:
        for count in (size for size in SIZES if size <= arguments.largest):
            table.add_row(*row(name, count, arguments.joints))
    events = Table("", "failures", "event, s", "without error bar, s", title=f"{SPHERES_OF_EVENTS} spheres")
    for name in FAMILIES:
        events.add_row(*event_row(name))
    console = Console(width=120)
    console.print(table)
    console.print(events)


if __name__ == "__main__":
    main()
