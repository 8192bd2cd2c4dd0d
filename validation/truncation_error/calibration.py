"""The expected truncation error held against the true one, on clusters for which a much higher order is known.

Writes calibration.csv and calibration.png beside this file. Takes about two minutes on two cores.
"""

from __future__ import annotations

import csv
from pathlib import Path

import clusters
import matplotlib.pyplot as plt
import numpy as np

import rheoclast as rc
from rheoclast.stokes.dense import DenseCholesky

HERE = Path(__file__).parent
MATERIAL = rc.MATERIALS["polystyrene"]
RADIUS = 0.5e-6
ORDERS = (2, 3, 4, 5)
LOADS = ("tension", "shear", "bending", "twisting")
SIZES = (2, 3, 4, 6, 8, 12, 16, 24, 32)
FLOW = rc.simple_shear(1.0)


def calibration_clusters() -> dict[str, rc.Aggregate]:
    """At least forty clusters of 2 to 32 spheres."""
    found = {f"tree {n} {k}": clusters.tree(n, 100 * n + k) for n in SIZES for k in range(2 if n > 2 else 1)}
    found |= {f"polydisperse {n} {k}": clusters.tree(n, 5000 + 100 * n + k, 0.4) for n in SIZES for k in range(2)}
    found |= {f"chain {n}": clusters.chain(n) for n in SIZES[1:]}
    found |= {f"fcc {n}": clusters.fcc_ball(n) for n in (4, 6, 8, 13, 19, 24, 32)}
    return found | {f"dense {n}": clusters.dense(n, n) for n in (6, 9, 13, 20, 30)}


def reference_order(count: int) -> int:
    """The order that stands for the exact solution, at least three above those that are judged."""
    return 12 if count <= 4 else 10 if count <= 16 else 9 if count <= 24 else 8


def judged(name: str, aggregate: rc.Aggregate) -> list[dict[str, float | str]]:
    """One row per order, load and contact: true and expected error, both root mean squares over orientations.

    In units of the largest such load of the cluster.
    """
    aggregate = rc.Aggregate(aggregate.spheres.scaled(RADIUS), aggregate.pairs)
    bonds = rc.jkr_bonds(aggregate, MATERIAL)
    model = rc.StokesianDynamics(reference_order(len(aggregate)), solver=DenseCholesky())
    exact = rc.contact_response(aggregate, rc.rigid_response(aggregate.spheres, model, viscosity=1e-3), bonds)
    rows, table = [], exact
    while table is not None:
        if table.order in ORDERS:
            expected = rc.truncation_error(table, FLOW)
            for load in LOADS:
                truth = _strength(_part(exact, load))
                error = _strength(_part(table, load) - _part(exact, load))
                size = truth.max()
                carried = truth > 1e-9 * _strength(exact.moment if load in LOADS[2:] else exact.force).max()
                for true, bar in zip(error[carried] / size, getattr(expected, load)[carried] / size, strict=True):
                    rows.append({"cluster": name, "order": table.order, "load": load, "true": true, "expected": bar})
        table = table.coarser
    return rows


def _part(table, load):
    whole = table.force if load in LOADS[:2] else table.moment
    along = table.normals[:, :, None] * np.einsum("ci,cik->ck", table.normals, whole)[:, None]
    return along if load in ("tension", "twisting") else whole - along


def _strength(tensor):
    """Root mean square over all orientations of the flow."""
    return np.sqrt((tensor**2).sum(axis=(1, 2))) * np.linalg.norm(FLOW.strain_rate) / np.sqrt(5)


def summary(rows) -> list[dict[str, float | str]]:
    """For every order and load: share of contacts below twice the bar, and share within a factor five of it."""
    found = []
    for order in ORDERS:
        for load in LOADS:
            chosen = [row for row in rows if row["order"] == order and row["load"] == load]
            ratio = np.array([row["true"] / row["expected"] for row in chosen])
            found.append(
                {
                    "order": order,
                    "load": load,
                    "contacts": len(chosen),
                    "below twice the estimate": float((ratio < 2).mean()),
                    "within a factor five": float(((ratio > 0.2) & (ratio < 5)).mean()),
                    "median true / estimate": float(np.median(ratio)),
                }
            )
    return found


def draw(rows) -> plt.Figure:
    """True against expected error, one panel per load, one colour per order."""
    figure, panels = plt.subplots(2, 2, figsize=(8.5, 8), layout="constrained", sharex=True, sharey=True)
    colours = dict(zip(ORDERS, ["#e69f00", "#009e73", "#0072b2", "#cc79a7"], strict=True))
    for load, panel in zip(LOADS, panels.flat, strict=True):
        for order in ORDERS:
            points = [(row["expected"], row["true"]) for row in rows if row["load"] == load and row["order"] == order]
            panel.loglog(*zip(*points, strict=True), ".", ms=3, alpha=0.6, color=colours[order], label=f"order {order}")
        bar = np.array([1e-6, 1])
        panel.fill_between(bar, bar / 5, bar * 5, color="#000000", alpha=0.07, lw=0, label="within a factor 5")
        panel.loglog(bar, 2 * bar, "k-", lw=0.8, label="twice the estimate")
        panel.set(title=load, xlim=(2e-6, 1), ylim=(2e-7, 1))
        panel.grid(alpha=0.3, lw=0.5)
    for panel in panels[1]:
        panel.set_xlabel("expected error / largest load")
    for panel in panels[:, 0]:
        panel.set_ylabel("true error / largest load")
    panels[0, 0].legend(fontsize=8, loc="lower right", markerscale=3)
    return figure


def main() -> None:
    """Compute, write and draw."""
    rows = [row for name, aggregate in calibration_clusters().items() for row in judged(name, aggregate)]
    with (HERE / "calibration.csv").open("w", newline="") as file:
        table = summary(rows)
        writer = csv.DictWriter(file, list(table[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows({key: f"{v:.3f}" if isinstance(v, float) else v for key, v in row.items()} for row in table)
    draw(rows).savefig(HERE / "calibration.png", dpi=110)


if __name__ == "__main__":
    main()
