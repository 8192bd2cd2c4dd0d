"""How the doublet's exact solution is approached with the multipole order, and what extrapolation gains.

Writes convergence.csv and convergence.png beside this file. Takes a few seconds.
"""

from __future__ import annotations

import csv
import json
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from scipy.special import zeta

import rheoclast as rc

HERE = Path(__file__).parent
REFERENCE = HERE.parents[1] / "tests" / "published" / "reference" / "doublet.json"
HIGHEST_ORDER = 16
DOUBLET = rc.Aggregate.touching(rc.Spheres([[0, 0, -1.0], [0, 0, 1.0]], 1.0))


def values_by_order() -> dict[int, dict[str, float]]:
    """Drags, axial rotation, tension and shear of the touching doublet at every order from 2."""
    response = rc.rigid_response(DOUBLET.spheres, rc.StokesianDynamics(HIGHEST_ORDER), viscosity=1.0)
    found = {}
    while response is not None and response.order > 1:
        resistance, table = response.resistance, rc.contact_response(DOUBLET, response)
        found[response.order] = {
            "axial drag": resistance[2, 2] / (12 * np.pi),
            "transverse drag": resistance[0, 0] / (12 * np.pi),
            "axial rotation": resistance[5, 5] / (16 * np.pi),
            "tension": table.loads(rc.uniaxial_extension(1.0)).tension[0],
            "shear": table.loads(rc.LinearFlow([[0, 0, 1], [0, 0, 0], [1, 0, 0]])).shear[0],
        }
        response = response.coarser
    return dict(sorted(found.items()))


def exact_values() -> dict[str, float]:
    """3ζ(3)/4 for the axial rotation, the converged reference for the rest (good to about 5e-8)."""
    converged = json.loads(REFERENCE.read_text())["converged"]
    names = {"axial drag": "X_drag", "transverse drag": "Y_drag", "tension": "c_n", "shear": "c_t"}
    return {**{ours: converged[theirs] for ours, theirs in names.items()}, "axial rotation": 0.75 * float(zeta(3))}


def exponent(errors: dict[int, float], first: int = 8, last: int = 14) -> float:
    """Fitted q in error ∝ order^−q."""
    orders = [order for order in errors if first <= order <= last]
    return -float(np.polyfit(np.log(orders), np.log([abs(errors[order]) for order in orders]), 1)[0])


def extrapolated(values: dict[int, float], order: int) -> float:
    """Limit from orders p − 4, p − 2 and p, for a sequence whose changes shrink by a constant factor (Aitken)."""
    first, second, third = (values[order + step] for step in (-4, -2, 0))
    return third - (third - second) ** 2 / (third - 2 * second + first)


def main() -> None:
    """Compute, write and draw."""
    values, exact = values_by_order(), exact_values()
    errors = {name: {p: value[name] / exact[name] - 1 for p, value in values.items()} for name in exact}
    rows = []
    for name in exact:
        series = {p: value[name] for p, value in values.items()}
        for p in values:
            limit = extrapolated(series, p) / exact[name] - 1 if p >= 6 else None
            rows.append({"quantity": name, "order": p, "relative error": errors[name][p], "extrapolated": limit})
    with (HERE / "convergence.csv").open("w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows({k: f"{v:.3e}" if isinstance(v, float) else v for k, v in row.items()} for row in rows)
    figure, panel = plt.subplots(figsize=(7, 5), layout="constrained")
    for name, colour in zip(exact, ["#0072b2", "#56b4e9", "#009e73", "#d55e00", "#e69f00"], strict=True):
        orders, sizes = list(errors[name]), np.abs(list(errors[name].values()))
        monotone = len(set(np.sign(list(errors[name].values())))) == 1
        note = f"falls like order^−{exponent(errors[name]):.1f}" if monotone else "changes sign"
        panel.loglog(orders, sizes, "o-", color=colour, ms=4, label=f"{name}: {note}")
    panel.set(xlabel="multipole order", ylabel="relative error of the touching doublet", xticks=[2, 3, 4, 6, 8, 12, 16])
    panel.set_xticklabels([2, 3, 4, 6, 8, 12, 16])
    panel.grid(alpha=0.3, lw=0.5)
    panel.legend(frameon=False)
    figure.savefig(HERE / "convergence.png", dpi=110)


if __name__ == "__main__":
    main()
