"""Doublets and trees along fluid paths in turbulence: every new record of the largest tension, kept in `results/`.

Everything is in units of the radius of the spheres, the viscosity and the Kolmogorov time (ν/ε)^½. A path in these
units serves every dissipation, since the motion depends on nothing else and the loads are proportional to (ε/ν)^½: the
first contact fails where the record of the tension first exceeds strength / (ε/ν)^½, at whatever ε. A path is cut into
blocks, each of which starts with a whole aggregate; the first block starts after the orientations have settled.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rich.progress import track

import rheoclast as rc
from rheoclast import generation
from rheoclast.generation._clusters import Cluster, cluster
from rheoclast.generation._growth import TOUCHING
from rheoclast.generation._joining import diffusive_join
from rheoclast.graphs import connected_parts

RESULTS = Path(__file__).parent / "results"
SEEDS, PATHS = 16, 40
SETTLING, BLOCK, BLOCKS = 20.0, 100.0, 5  # Kolmogorov times

MODELS = rc.turbulence.TURBULENCE_MODELS
FAMILIES: Mapping[str, Callable[[int, int], rc.Aggregate]] = {
    "doublet": lambda count, seed: generation.straight_chain(count),
    "open tree": lambda count, seed: generation.cluster_cluster(count, fractal_dimension=1.8, seed=seed),
    "dense tree": lambda count, seed: generation.cluster_cluster(count, fractal_dimension=2.3, seed=seed),
    "unequal tree": lambda count, seed: unequal_tree(count, seed),
}
SIZES = {family: (2,) if family == "doublet" else (16, 32, 64, 128, 256) for family in FAMILIES}
OF_CLUSTER = "of cluster: "
UNIT_BONDS = rc.Bonds(normal=1.0, tangential=1.0, bending=1.0, twisting=1.0, tensile_strength=1.0)
Columns = dict[str, NDArray[Any]]


@dataclass(frozen=True, eq=False)
class Body:
    """An aggregate with what its motion and loads follow from."""

    family: str
    aggregate: rc.Aggregate
    response: rc.RigidResponse
    table: rc.ContactResponse
    smaller: NDArray[np.intp]

    @classmethod
    def made(cls, family: str, count: int, seed: int) -> Body:
        """A member of a family."""
        aggregate = FAMILIES[family](count, seed)
        response = rc.rigid_response(aggregate.spheres, rc.StokesianDynamics(order=2), viscosity=1.0)
        return cls(family, aggregate, response, rc.contact_response(aggregate, response), smaller_parts(aggregate))

    def tension(self, path: rc.GradientHistory, start: NDArray[np.float64]) -> rc.LoadHistory:
        """The largest tension along a path."""
        return rc.load_history(rc.trajectory(self.response, path, start=start), self.table, UNIT_BONDS)

    def lengths(self) -> dict[str, float]:
        """Measures of its size."""
        return {
            "gyration": rc.radius_of_gyration(self.aggregate.spheres),
            "enclosing": rc.enclosing_radius(self.aggregate.spheres),
            "hydrodynamic": self.response.hydrodynamic_radius,
        }


def unequal_tree(count: int, seed: int) -> rc.Aggregate:
    """A diffusion-limited cluster–cluster aggregate of pieces that are alike in kind but not in size.

    All splits of the number of spheres into two pieces, and of theirs, are equally probable: so the sizes are
    distributed where all pairs of clusters aggregate at the same rate (J. F. C. Kingman, Stoch. Process. Appl. 13
    (1982) 235).
    """
    random = np.random.default_rng([seed, count])

    def grown(size: int) -> Cluster:
        if size == 1:
            return cluster(np.zeros((1, 3)), np.ones(1))
        first = int(random.integers(1, size))
        return diffusive_join(grown(first), grown(size - first), random)

    return rc.Aggregate.touching(rc.Spheres(*grown(count)[:2]), TOUCHING)


def smaller_parts(tree: rc.Aggregate) -> NDArray[np.intp]:
    """Number of spheres (C,) in the smaller part into which a tree falls if the contact fails."""
    parts = (connected_parts(len(tree), np.delete(tree.pairs, c, axis=0)) for c in range(len(tree.pairs)))
    return np.array([np.bincount(each).min() for each in parts])


def records(history: rc.LoadHistory) -> Iterator[tuple[NDArray[np.float64], NDArray[np.intp]]]:
    """Of every block: times since its start at which the largest tension exceeds all before, and their samples."""
    for start in history.times[0] + SETTLING + BLOCK * np.arange(BLOCKS):
        first, end = np.searchsorted(history.times, [start, start + BLOCK])
        highest = np.maximum.accumulate(history.largest[first:end])
        new = first + np.flatnonzero(np.diff(highest, prepend=-np.inf) > 0)
        yield np.where(new == first, 0.0, history.times[new] - start), new


def mean_tension(history: rc.LoadHistory) -> float:
    """Mean of the largest tension in the course of time, once settled."""
    settled = history.times >= history.times[0] + SETTLING
    return float(np.trapezoid(history.largest[settled], history.times[settled]) / (history.duration - SETTLING))


def run(seed: int, sizes: Mapping[str, tuple[int, ...]] = SIZES, paths: int = PATHS) -> tuple[Columns, Columns]:
    """Clusters, and all records, of one seed: every family and size on the same paths of both models."""
    bodies = [Body.made(family, count, seed) for family, counts in sizes.items() for count in counts]
    starts = rc.random_orientations(paths, seed)
    clusters: list[Columns] = []
    found: list[Columns] = []
    for model, histories in MODELS.items():
        flows = histories(paths, SETTLING + BLOCKS * BLOCK, dissipation=1.0, kinematic_viscosity=1.0, seed=seed)
        for body in bodies:
            tensions = [body.tension(*each) for each in zip(flows, starts, strict=True)]
            own = {"model": model, "family": body.family, "spheres": len(body.aggregate), "seed": seed}
            own |= body.lengths() | {"tension": float(np.mean([mean_tension(each) for each in tensions]))}
            found.append(_columns(len(clusters), body, tensions))
            clusters.append({name: np.array([value]) for name, value in own.items()})
    return stacked(clusters), stacked(found)


def _columns(cluster: int, body: Body, tensions: list[rc.LoadHistory]) -> Columns:
    """The records of one body: its row in the table of clusters, block, time, tension, size of the smaller part."""
    rows: list[Columns] = []
    for each in tensions:
        for times, samples in records(each):
            rows.append(
                {
                    "cluster": np.full(len(times), cluster, np.int16),
                    "block": np.full(len(times), len(rows), np.int16),
                    "time": times.astype(np.float32),
                    "tension": each.largest[samples].astype(np.float32),
                    "smaller": body.smaller[each.contact[samples]].astype(np.int16),
                }
            )
    return stacked(rows)


def stacked(tables: list[Columns]) -> Columns:
    """Tables with the same columns, one below the other."""
    return {name: np.concatenate([table[name] for table in tables]) for name in tables[0]}


def run_all() -> list[tuple[Columns, Columns]]:
    """Clusters and records of every seed; what is not there yet is run and kept, a seed at a time."""
    RESULTS.mkdir(exist_ok=True)
    missing = [seed for seed in range(SEEDS) if not _file(seed).exists()]
    for seed in track(missing, description="seeds", disable=not missing):
        clusters, found = run(seed)
        unfinished = _file(seed).with_suffix(".unfinished.npz")
        np.savez_compressed(unfinished, **{OF_CLUSTER + name: column for name, column in clusters.items()}, **found)
        unfinished.replace(_file(seed))
    return [_read(_file(seed)) for seed in range(SEEDS)]


def _read(path: Path) -> tuple[Columns, Columns]:
    with np.load(path) as kept:
        columns = dict(kept)
    clusters = {name.removeprefix(OF_CLUSTER): columns.pop(name) for name in list(columns) if OF_CLUSTER in name}
    return clusters, columns


def _file(seed: int) -> Path:
    return RESULTS / f"{seed:03d}.npz"
