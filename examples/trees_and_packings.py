"""
Trees and packings break in two ways
====================================

A tree falls in two with its first failure. A packing holds on: many contacts fail before a part leaves it. Between the
two lies a family of aggregates that goes from tree to packing in small steps, here fcc balls from which contacts are
taken away at random down to a chosen mean coordination number.

Left, the number of failures up to the split; right, how much of the mass leaves the largest fragment. Every point is
one of twenty random orientations in uniaxial extension; lines are medians.
"""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

import rheoclast as rc

SPHERES = 43
COORDINATIONS = (2 - 2 / SPHERES, 2.5, 3.0, 4.0, 5.0, 6.0)
ORIENTATIONS = 20


def breakups(coordination: float) -> list[rc.Breakup]:
    """One thinned ball of the given mean coordination number, broken in many orientations."""
    ball = rc.generation.thinned_fcc_ball(SPHERES, coordination, radius=0.5e-6, seed=2)
    bonds = rc.jkr_bonds(ball, rc.MATERIALS["polystyrene"])
    response = rc.rigid_response(ball.spheres, rc.StokesianDynamics(), viscosity=1e-3)
    flow = rc.uniaxial_extension(rate=1.0)
    turned = (flow.rotated(each) for each in rc.random_orientations(ORIENTATIONS, seed=1))
    return list(rc.break_up_each(ball, response, bonds, turned))


def trees_and_packings() -> Figure:
    """Number of failures, and share of mass that leaves the largest fragment, against mean coordination number."""
    figure = Figure(figsize=(8.4, 3.4), layout="constrained", dpi=160)
    panels = figure.subplots(1, 2, sharex=True)
    rng = np.random.default_rng(0)
    medians = []
    for coordination in COORDINATIONS:
        events = breakups(coordination)
        values = np.array([(len(each.failures), 1 - len(each.spheres[0]) / SPHERES) for each in events])
        medians.append(np.median(values, axis=0))
        beside = coordination + rng.uniform(-0.08, 0.08, len(events))
        for axes, column in zip(panels, values.T, strict=True):
            axes.plot(beside, column, "o", ms=3.5, mew=0, color="C0", alpha=0.35)
    for axes, median in zip(panels, np.transpose(medians), strict=True):
        axes.plot(COORDINATIONS, median, color="0.25")
        axes.set(xlabel="mean coordination number")
        axes.spines[["top", "right"]].set_visible(False)
    panels[0].set(ylabel="failures up to the split", yscale="log")
    panels[1].set(ylabel="mass outside the largest fragment", ylim=(0, 0.62))
    return figure


if __name__ == "__main__":
    trees_and_packings().savefig("trees_and_packings.png")
