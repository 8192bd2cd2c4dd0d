"""How aggregates from tree to packing break: one row per event, kept in `results/` beside this file.

python validation/breakup_modes/events.py [--workers 2]

Eight families of 300 spheres, 50 clusters each, 50 orientations each, in uniaxial extension and in simple shear: 40 000
events, two to three hours on two cores. Killed at any moment, it goes on where it stopped: every cluster is a file that
is there as a whole or not at all.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import numba
import numpy as np
from rich.progress import track
from threadpoolctl import threadpool_limits

import rheoclast as rc
from rheoclast import generation

RESULTS = Path(__file__).parent / "results"
SPHERES, RADIUS, VISCOSITY = 300, 0.5e-6, 1e-3
CLUSTERS, ORIENTATIONS = 50, 50
CLUSTERS_OF_VARIANTS, ORIENTATIONS_OF_VARIANTS = 10, 10

Family = Callable[..., rc.Aggregate]
FAMILIES: Mapping[str, Family] = {
    "open tree": partial(generation.cluster_cluster, fractal_dimension=1.8),
    "dense tree": partial(generation.cluster_cluster, fractal_dimension=2.5),
    "compacted 3 %": partial(generation.compacted_cluster, amount=0.03),
    "compacted 10 %": partial(generation.compacted_cluster, amount=0.1),
    "compacted 40 %": partial(generation.compacted_cluster, amount=0.4),
    "compacted 100 %": partial(generation.compacted_cluster, amount=1.0),
    "packed ball": generation.random_packed_ball,
    "thinned fcc": partial(generation.thinned_fcc_ball, coordination=7.5),
}
FLOWS = {"extension": rc.uniaxial_extension(1.0), "shear": rc.simple_shear(1.0)}


@dataclass(frozen=True)
class Variant:
    """What an event is computed with.

    Attributes
    ----------
    order
        Multipole order.
    rule
        As in `break_up`.
    softer
        Divisors of the normal, tangential, bending and twisting stiffness.
    """

    order: int = 2
    rule: str = "weakest"
    softer: tuple[float, float, float, float] = (1.0, 1.0, 1.0, 1.0)

    def bonds(self, aggregate: rc.Aggregate) -> rc.Bonds:
        """JKR contacts of polystyrene with the stiffness changed."""
        bonds = rc.jkr_bonds(aggregate, rc.MATERIALS["polystyrene"])
        stiffness = bonds.stiffness(len(aggregate.pairs)) / np.array(self.softer)
        return replace(bonds, **dict(zip(("normal", "tangential", "bending", "twisting"), stiffness.T, strict=True)))


VARIANTS = {
    "standard": Variant(),
    "order 3": Variant(order=3),
    "all overloaded at once": Variant(rule="overloaded"),
    "bending and twisting 10 × softer": Variant(softer=(1, 1, 10, 10)),
    "bending and twisting 10 × stiffer": Variant(softer=(1, 1, 0.1, 0.1)),
    "tangential 10 × softer": Variant(softer=(1, 10, 1, 1)),
}
FAMILIES_OF_VARIANTS = ("dense tree", "compacted 10 %", "compacted 40 %", "packed ball")


def events(
    family: str, seed: int, variant: Variant, orientations: int, error_bar: bool, spheres: int
) -> Iterator[dict[str, float | str]]:
    """Rows of all events of one cluster."""
    aggregate = FAMILIES[family](spheres, radius=RADIUS, seed=seed)
    response = rc.rigid_response(aggregate.spheres, rc.StokesianDynamics(variant.order), VISCOSITY)
    if not error_bar:
        response = replace(response, coarser=None)  # halves the work
    cluster = {
        "family": family,
        "seed": seed,
        "coordination": rc.mean_coordination(aggregate),
        "porosity": rc.porosity(aggregate.spheres),
        "gyration": rc.radius_of_gyration(aggregate.spheres) / RADIUS,
    }
    bonds = variant.bonds(aggregate)
    for flow_name, flow in FLOWS.items():
        turned = (flow.rotated(each) for each in rc.random_orientations(orientations, seed))
        breakups = rc.break_up_each(aggregate, response, bonds, turned, rule=variant.rule)
        for orientation, breakup in enumerate(breakups):
            yield {**cluster, "flow": flow_name, "orientation": orientation, **measures(breakup)}


def measures(breakup: rc.Breakup) -> dict[str, float | str]:
    """What one event tells."""
    failures, sizes = breakup.failures, sorted(map(len, breakup.spheres))
    first = failures[0] if failures else None
    return {
        "outcome": breakup.outcome,
        "failures": len(failures),
        "surface": len(breakup.surface),
        "initiation_rate": breakup.initiation_rate,
        "breakup_rate": breakup.breakup_rate,
        "first_contact": first.contact if first else -1,
        "first_radial": first.radial_position if first else np.nan,
        "first_depth": first.depth if first else np.nan,
        "inwardness": breakup.inwardness,
        "fragments": len(sizes) if breakup.splits else 1,
        "smaller": 1 - sizes[-1] / sum(sizes),
        "second": sizes[-2] / sum(sizes) if breakup.splits else 0.0,
        "undetermined": _share_of_ties(breakup),
        **_thirds(breakup),
        "contacts": " ".join(str(failure.contact) for failure in failures),
    }


def _thirds(breakup: rc.Breakup) -> dict[str, float]:
    """Mean depth of the first, middle and last third of the crack's surface, for three failures or more."""
    depths = [failure.depth for failure in breakup.surface]
    thirds = np.array_split(depths, 3) if len(depths) >= 3 else [[np.nan]] * 3
    return {
        f"depth_{name}": float(np.mean(third)) for name, third in zip(("early", "middle", "late"), thirds, strict=True)
    }


def _share_of_ties(breakup: rc.Breakup) -> float:
    """Share of failures whose place in the sequence the error bar leaves open; not a number without error bar."""
    if not breakup.failures or breakup.failures[0].rivals is None:
        return np.nan
    return len(breakup.near_ties()) / len(breakup.failures)


@dataclass(frozen=True)
class Task:
    """One cluster in one variant: the unit that is done as a whole or not at all."""

    family: str
    seed: int
    variant: str | None

    @property
    def file(self) -> Path:
        """Where its rows are kept."""
        name = "_".join([self.variant or "all", self.family, f"{self.seed:03d}"])
        return RESULTS / f"{name.replace(' ', '-').replace('%', 'percent')}.csv"

    def run(self) -> None:
        """Compute and keep the rows."""
        variant = VARIANTS[self.variant or "standard"]
        orientations = ORIENTATIONS_OF_VARIANTS if self.variant else ORIENTATIONS
        rows = list(events(self.family, self.seed, variant, orientations, self.variant is not None, SPHERES))
        columns = {name: np.array([row[name] for row in rows]) for name in rows[0]}
        unfinished = self.file.with_suffix(".unfinished")
        rc.write_table(unfinished, {"variant": np.array([self.variant or "all"] * len(rows)), **columns})
        unfinished.replace(self.file)


def tasks() -> list[Task]:
    """All of them, every family in turn, so that what is there at any moment is balanced."""
    main = [Task(family, seed, None) for seed in range(CLUSTERS) for family in FAMILIES]
    variants = [
        Task(family, seed, variant)
        for seed in range(CLUSTERS_OF_VARIANTS)
        for family in FAMILIES_OF_VARIANTS
        for variant in VARIANTS
    ]
    return main[: len(main) // 5] + variants + main[len(main) // 5 :]


def waiting() -> list[Task]:
    """What is not there yet."""
    return [task for task in tasks() if not task.file.exists()]


def use_one_thread() -> None:
    """There is a worker for every core."""
    threadpool_limits(1)
    numba.set_num_threads(1)


def main() -> None:
    """Run what is not there yet."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--workers", type=int, default=os.cpu_count())
    workers = parser.parse_args().workers
    RESULTS.mkdir(exist_ok=True)
    with ProcessPoolExecutor(workers, initializer=use_one_thread) as pool:
        running = [pool.submit(task.run) for task in waiting()]
        for each in track(as_completed(running), total=len(running), description="clusters"):
            each.result()


if __name__ == "__main__":
    main()
