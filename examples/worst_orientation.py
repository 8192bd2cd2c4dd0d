"""
The worst orientation
=====================

How many orientations must be tried to find the one in which an aggregate breaks most easily? None: the largest tension
of a contact over all orientations is a sum over three eigenvalues (von Neumann's trace inequality).

Left, the tension of the weakest contact in 20 000 random orientations of the aggregate, and the closed form as a line:
never exceeded, and approached by few. Right, how far a search at random falls short of it.
"""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

import rheoclast as rc

FLOW = rc.uniaxial_extension(rate=1e5)
ORIENTATIONS = 20_000


def tension_by_orientation() -> tuple[np.ndarray, float]:
    """Tension of the weakest contact in random orientations, (n,) in N, and its largest over all orientations."""
    floc = rc.generation.cluster_cluster(60, radius=0.5e-6, seed=3)
    response = rc.rigid_response(floc.spheres, rc.StokesianDynamics(), viscosity=1e-3)
    table = rc.contact_response(floc, response)
    worst = table.worst_tension(FLOW)
    weakest = int(worst.argmax())
    rotations = rc.random_orientations(ORIENTATIONS, seed=1)
    strain_rates = rotations @ FLOW.strain_rate @ rotations.transpose(0, 2, 1)
    return np.einsum("ij,nij->n", table.tension[weakest], strain_rates), float(worst[weakest])


def worst_orientation() -> Figure:
    """Distribution of the tension over orientations, and the best of ever more of them, against the closed form."""
    tension, largest = tension_by_orientation()
    figure = Figure(figsize=(8.4, 3.4), layout="constrained", dpi=160)
    left, right = figure.subplots(1, 2)
    left.hist(tension * 1e9, bins=80, density=True, color="0.75")
    left.axvline(largest * 1e9, color="C3")
    left.set(xlabel="tension of the contact, nN", ylabel="probability density, 1/nN")
    left.annotate("closed form", (largest * 1e9, left.get_ylim()[1] * 0.9), (-6, 0), "data", "offset points",
                  ha="right", color="C3")  # fmt: skip
    tried = np.arange(1, len(tension) + 1)
    right.loglog(tried, 1 - np.maximum.accumulate(tension) / largest, color="0.3")
    right.set(xlabel="orientations tried", ylabel="relative shortfall of the best", ylim=(1e-4, 2))
    for axes in (left, right):
        axes.spines[["top", "right"]].set_visible(False)
    return figure


if __name__ == "__main__":
    worst_orientation().savefig("worst_orientation.png")
