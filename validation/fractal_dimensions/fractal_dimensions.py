"""Fractal dimensions of the families of open aggregates against published ones.

Writes fractal_dimensions.csv and fractal_dimensions.png beside this file. Takes about five minutes on one core.
"""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import NamedTuple

import matplotlib.pyplot as plt
import numpy as np

import rheoclast as rc
from rheoclast import generation

HERE = Path(__file__).parent
SIZES = (30, 60, 120, 250, 500, 1000, 2000)
SEEDS = 100


class Published(NamedTuple):
    """A dimension that the literature reports, how far from it ours may be, and where it stands."""

    dimension: float
    tolerance: float
    source: str


FAMILIES: Mapping[str, tuple[generation.families.Family, Published]] = {
    "diffusion-limited cluster–cluster": (
        generation.diffusion_limited_cluster_cluster,
        Published(1.78, 0.1, "Jullien, Kolb & Botet, J. Physique Lett. 45 (1984) L211"),
    ),
    "ballistic cluster–cluster": (
        generation.ballistic_cluster_cluster,
        Published(1.95, 0.1, "Meakin, Phys. Rev. A 29 (1984) 997; Jullien, J. Phys. A 17 (1984) L771"),
    ),
    "reaction-limited cluster–cluster": (
        generation.reaction_limited_cluster_cluster,
        Published(2.1, 0.1, "Brown & Ball, J. Phys. A 18 (1985) L517"),
    ),
    "diffusion-limited particle–cluster": (
        generation.diffusion_limited_particle_cluster,
        Published(2.5, 0.15, "Tolman & Meakin, Phys. Rev. A 40 (1989) 428"),
    ),
    "ballistic particle–cluster": (
        generation.ballistic_particle_cluster,
        Published(3.0, 0.15, "Ball & Witten, Phys. Rev. A 29 (1984) 2966: 3 in the limit of many spheres"),
    ),
    "tunable, 1.8": (
        partial(generation.cluster_cluster, fractal_dimension=1.8, prefactor=1.3),
        Published(1.8, 1e-6, "prescribed"),
    ),
    "tunable, 2.3": (
        partial(generation.cluster_cluster, fractal_dimension=2.3, prefactor=1.3),
        Published(2.3, 1e-6, "prescribed"),
    ),
}


def ensemble(family: generation.families.Family, sizes: Sequence[int], seeds: int) -> list[rc.Aggregate]:
    """Aggregates of several sizes, each from its own seed."""
    return [family(size, seed=1000 * size + seed) for size in sizes for seed in range(seeds)]


def rows(ensembles: Mapping[str, list[rc.Aggregate]]) -> list[dict[str, str | float]]:
    """Dimension and prefactor of each family by both measures, and what is published."""
    found = []
    for name, aggregates in ensembles.items():
        law, published = rc.fractal_law(aggregates), FAMILIES[name][1]
        largest = max(map(len, aggregates))
        pairs = [_by_pair_correlation(each) for each in aggregates if len(each) == largest]
        found.append(
            {
                "family": name,
                "dimension": law.dimension,
                "dimension_low": law.dimension_interval[0],
                "dimension_high": law.dimension_interval[1],
                "prefactor": law.prefactor,
                "prefactor_low": law.prefactor_interval[0],
                "prefactor_high": law.prefactor_interval[1],
                "pair_correlation_mean": float(np.nanmean(pairs)),
                "pair_correlation_scatter": float(np.nanstd(pairs, ddof=1)),
                "published": published.dimension,
                "source": published.source,
            }
        )
    return found


def _by_pair_correlation(aggregate: rc.Aggregate) -> float:
    """Dimension of one aggregate; none where its core holds too few spheres, as in some open clusters."""
    try:
        return rc.pair_correlation_dimension(aggregate).dimension
    except ValueError:
        return np.nan


def draw(ensembles: Mapping[str, list[rc.Aggregate]]) -> plt.Figure:
    """Number of spheres against radius of gyration, every aggregate a point, with the fitted laws."""
    figure, panel = plt.subplots(figsize=(6.4, 5.6), layout="constrained")
    for k, (name, aggregates) in enumerate(ensembles.items()):
        gyration = np.array([rc.radius_of_gyration(each.spheres) / each.spheres.radii.mean() for each in aggregates])
        shift = 2.0**k  # keeps the families apart
        law = rc.fractal_law(aggregates)
        line = np.array([gyration.min(), gyration.max()])
        published = FAMILIES[name][1].dimension
        label = f"{name}: {law.dimension:.2f} (published {published:g})"
        points = panel.loglog(gyration, shift * np.array([len(each) for each in aggregates]), ".", ms=3, alpha=0.5)
        panel.loglog(
            line, shift * law.prefactor * line**law.dimension, color=points[0].get_color(), lw=1.2, label=label
        )
    panel.set(xlabel="radius of gyration / sphere radius", ylabel="spheres (families shifted by factors of two)")
    panel.grid(alpha=0.3, lw=0.5)
    figure.legend(loc="outside lower center", ncols=2, frameon=False, fontsize=8)
    return figure


def main() -> None:
    """Grow, measure, write."""
    ensembles = {name: ensemble(family, SIZES, SEEDS) for name, (family, _) in FAMILIES.items()}
    table = rows(ensembles)
    with (HERE / "fractal_dimensions.csv").open("w", newline="") as stream:
        writer = csv.DictWriter(stream, fieldnames=list(table[0]))
        writer.writeheader()
        writer.writerows(table)
    for row in table:
        print(*row.values(), sep=", ")
    draw(ensembles).savefig(HERE / "fractal_dimensions.png", dpi=110)


if __name__ == "__main__":
    main()
