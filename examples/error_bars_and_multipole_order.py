"""
Error bars and multipole order
==============================

How good is order 2? The change from one order to the next tells, at no extra cost: `rheoclast.truncation_error` is an
expected error of every contact's load. Here it is held against what it stands for, the difference from a much higher
order, for a compact cluster, where errors are large, and for a tree, where they are small. The bars err on the safe
side for most contacts, by a factor of a few.
"""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

import rheoclast as rc

CLUSTERS = {
    "compact: fcc ball of 13 spheres": rc.generation.lattice_ball("fcc", 13),
    "open: tree of 16 spheres": rc.generation.cluster_cluster(16, seed=1),
}
ORDERS = (2, 3, 4, 5)
REFERENCE = 7
FLOW = rc.uniaxial_extension(rate=1.0)


def contact_response(cluster: rc.Aggregate, order: int) -> rc.ContactResponse:
    """Contact loads of a cluster of bonded unit spheres at a multipole order."""
    bonds = rc.Bonds(normal=1.0, tangential=0.6, bending=6e-3, twisting=8e-3)
    response = rc.rigid_response(cluster.spheres, rc.StokesianDynamics(order), viscosity=1.0)
    return rc.contact_response(cluster, response, bonds)


def errors_by_order(cluster: rc.Aggregate) -> tuple[np.ndarray, np.ndarray]:
    """Expected and true error of the tension, root mean squares over contacts and orientations, over the tension's."""
    tables = [contact_response(cluster, order) for order in ORDERS]
    exact = contact_response(cluster, REFERENCE).tension
    expected = [np.linalg.norm(rc.truncation_error(table, FLOW).tension) for table in tables]
    true = [np.linalg.norm(table.tension - exact) for table in tables]
    strength = np.linalg.norm(FLOW.strain_rate) / np.sqrt(5)  # the mean of (A : E)² over orientations is |A|²|E|²/5
    return np.array(expected) / (strength * np.linalg.norm(exact)), np.array(true) / np.linalg.norm(exact)


def error_bars_and_multipole_order() -> Figure:
    """Expected and true errors of the tension against the order."""
    figure = Figure(figsize=(6.4, 3.8), layout="constrained", dpi=160)
    axes = figure.subplots()
    for colour, (name, cluster) in zip(("C0", "C1"), CLUSTERS.items(), strict=True):
        expected, true = errors_by_order(cluster)
        axes.semilogy(ORDERS, 100 * expected, "_", ms=22, mew=2, color=colour, label=f"{name}, expected")
        axes.semilogy(ORDERS, 100 * true, "o", ms=6, color=colour, label=f"{name}, true")
    axes.set(xlabel="multipole order", ylabel="error of the tensions, %", xticks=ORDERS)
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(frameon=False)
    return figure


if __name__ == "__main__":
    error_bars_and_multipole_order().savefig("error_bars_and_multipole_order.png")
