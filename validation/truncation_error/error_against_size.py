"""Error of contact loads against the number of spheres, for trees, chains and compact clusters.

Writes error_against_size.csv and error_against_size.png beside this file. Takes about five minutes on two cores.
"""

from __future__ import annotations

import csv
from pathlib import Path

import clusters
import matplotlib.pyplot as plt
import numpy as np
from scipy.spatial.transform import Rotation

import rheoclast as rc
from rheoclast.stokes.dense import DenseCholesky

HERE = Path(__file__).parent
MATERIAL = rc.MATERIALS["polystyrene"]
RADIUS = 0.5e-6
ORDERS = (1, 2, 3, 4)
MODELS = {"free draining": rc.FreeDraining(), "exposed area": rc.ExposedArea()}
ORIENTATIONS = Rotation.random(200, random_state=1)
LABELS = {"critical contact": "critical contact\nmistaken, share", "critical rate": "critical rate\nmedian error"}
QUANTITIES = ("tension", "shear", "bending", "critical contact", "critical rate")

FAMILIES = {
    "tree": {n: [clusters.tree(n, 10 * n + k) for k in range(6 if n < 64 else 3)] for n in (2, 4, 8, 16, 32, 64, 128)},
    "chain": {n: [clusters.chain(n)] for n in (2, 4, 8, 16, 32, 64)},
    "compact": {n: [clusters.fcc_ball(n)] for n in (4, 13, 19, 43, 55, 79)}
    | {n: [clusters.dense(n, k) for k in range(2)] for n in (8, 24)},
}


def reference_order(count: int) -> int:
    """The order that stands for the exact solution: as high as ten seconds allow."""
    return 8 if count <= 16 else 7 if count <= 32 else 6


def errors(aggregate: rc.Aggregate) -> list[dict[str, float | str]]:
    """One row per model and order: errors against the reference order."""
    spheres = aggregate.spheres.scaled(RADIUS)
    aggregate = rc.Aggregate(spheres, aggregate.pairs)
    bonds = rc.jkr_bonds(aggregate, MATERIAL)
    exact = _table(aggregate, rc.StokesianDynamics(reference_order(len(aggregate)), solver=DenseCholesky()), bonds)
    tables = {name: _table(aggregate, model, bonds) for name, model in MODELS.items()}
    tables |= {f"order {each.order}": each for each in exact.by_order if each.order in ORDERS}
    return [{"model": name, **_compared(table, exact, bonds)} for name, table in sorted(tables.items())]


def _table(aggregate, model, bonds):
    return rc.contact_response(aggregate, rc.rigid_response(aggregate.spheres, model, viscosity=1e-3), bonds)


def _compared(table, exact, bonds):
    row = {name: _relative(_part(table, name), _part(exact, name)) for name in ("tension", "shear", "bending")}
    same, rates = [], []
    for rotation in ORIENTATIONS:
        flow = rc.simple_shear(1.0).rotated(rotation)
        ours, truth = (rc.initiation(each, bonds, flow) for each in (table, exact))
        same.append(ours.contact == truth.contact)
        if ours.contact is not None and truth.contact is not None:
            rates.append(ours.rate / truth.rate - 1)
    row["critical contact"] = 1 - float(np.mean(same))
    row["critical rate"] = float(np.median(np.abs(rates)))
    return row


def _part(table, name):
    whole = table.moment if name == "bending" else table.force
    along = table.normals[:, :, None] * np.einsum("ci,cik->ck", table.normals, whole)[:, None]
    return along if name == "tension" else whole - along


def _relative(ours, truth):
    size = np.sqrt(np.mean(truth**2))
    scale = np.abs(truth).max()
    return float(np.sqrt(np.mean((ours - truth) ** 2)) / size) if scale > 1e-30 else 0.0


def all_errors(families=FAMILIES) -> list[dict[str, float | str]]:
    """Rows for every cluster."""
    return [
        {"family": family, "spheres": count, **row}
        for family, sizes in families.items()
        for count, members in sizes.items()
        for aggregate in members
        for row in errors(aggregate)
    ]


def draw(rows) -> plt.Figure:
    """One panel per quantity and family; lines join the root mean square over the clusters of a size."""
    models = ["free draining", "exposed area", *(f"order {p}" for p in ORDERS)]
    colours = ["#999999", "#666666", "#d55e00", "#e69f00", "#009e73", "#0072b2"]
    families = list(dict.fromkeys(row["family"] for row in rows))
    figure, panels = plt.subplots(
        len(QUANTITIES), len(families), figsize=(9, 12), sharex="col", sharey="row", layout="constrained"
    )
    for quantity, line in zip(QUANTITIES, panels, strict=True):
        for family, panel in zip(families, line, strict=True):
            for model, colour in zip(models, colours, strict=True):
                sizes, values = _mean_by_size(rows, family, model, quantity)
                panel.plot(sizes, values, "o-", color=colour, ms=4, lw=1.2, label=model)
            panel.set_xscale("log", base=2)
            panel.grid(alpha=0.3, lw=0.5)
            if quantity != "critical contact":
                panel.set_yscale("log")
                panel.set_ylim(2e-4, 2)
            if quantity == QUANTITIES[0]:
                panel.set_title({"tree": "open trees", "chain": "straight chains"}.get(family, "compact clusters"))
            if quantity == QUANTITIES[-1]:
                panel.set_xlabel("spheres")
        line[0].set_ylabel(LABELS.get(quantity, f"{quantity}\nerror"))
    handles, labels = panels[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=6, frameon=False)
    return figure


def _mean_by_size(rows, family, model, quantity):
    chosen = [row for row in rows if row["family"] == family and row["model"] == model]
    sizes = sorted({row["spheres"] for row in chosen})
    values = [np.sqrt(np.mean([row[quantity] ** 2 for row in chosen if row["spheres"] == size])) for size in sizes]
    kept = [
        (size, value) for size, value in zip(sizes, values, strict=True) if value > 0 or quantity == "critical contact"
    ]
    return [list(column) for column in zip(*kept, strict=True)] if kept else ([], [])


def main() -> None:
    """Compute, write and draw."""
    rows = all_errors()
    with (HERE / "error_against_size.csv").open("w", newline="") as file:
        writer = csv.DictWriter(file, ["family", "spheres", "model", *QUANTITIES], lineterminator="\n")
        writer.writeheader()
        writer.writerows(
            {key: f"{value:.4g}" if isinstance(value, float) else value for key, value in row.items()} for row in rows
        )
    draw(rows).savefig(HERE / "error_against_size.png", dpi=110)


if __name__ == "__main__":
    main()
