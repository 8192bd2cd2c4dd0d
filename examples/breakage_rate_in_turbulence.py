"""
Breakage rate in turbulence
===========================

How often does an aggregate break in a stirred tank? Aggregates are carried along fluid paths of isotropic turbulence,
each with its own history of the velocity gradient, until a contact fails. Failures over the time in which they might
have happened are a rate, with an interval for what chance leaves open.

The line is Kusters' exponential law, which population balances often use, fitted by its critical dissipation. It is
meant for rare events: at higher dissipations most aggregates break within some Kolmogorov times, and faster than the
law allows.
"""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

import rheoclast as rc

KINEMATIC_VISCOSITY = 1e-6
DISSIPATIONS = (0.06, 0.075, 0.095, 0.12)
PATHS, KOLMOGOROV_TIMES = 60, 60


def breakage_rates() -> list[rc.EventRate]:
    """Rate of first failures of a weakly adhering floc at each dissipation."""
    floc = rc.generation.cluster_cluster(100, radius=0.5e-6, seed=6)
    bonds = rc.MeasuredPullOff(force=1e-10, stiffness=rc.JKR(rc.MATERIALS["polystyrene"])).bonds(floc)
    response = rc.rigid_response(floc.spheres, rc.StokesianDynamics(), viscosity=1e-3)
    table = rc.contact_response(floc, response, bonds)
    starts = rc.random_orientations(PATHS, seed=2)
    rates = []
    for dissipation in DISSIPATIONS:
        duration = KOLMOGOROV_TIMES * rc.kolmogorov_time(dissipation, KINEMATIC_VISCOSITY)
        paths = rc.gaussian_histories(PATHS, duration, dissipation, KINEMATIC_VISCOSITY, seed=1)
        orbits = (rc.trajectory(response, path, start=start) for path, start in zip(paths, starts, strict=True))
        waiting = rc.first_failure_times(rc.load_history(orbit, table, bonds) for orbit in orbits)
        rates.append(rc.breakage_rate(waiting))
    return rates


def breakage_rate_in_turbulence() -> Figure:
    """Breakage rate against dissipation, with intervals and the fitted exponential law."""
    rates = breakage_rates()
    rate = np.array([each.rate for each in rates])
    interval = np.array([each.interval for each in rates])
    critical = rc.fitted_critical_dissipation(DISSIPATIONS, rate, KINEMATIC_VISCOSITY)
    print(f"critical dissipation {critical.value:.2g} m²/s³, {critical.interval[0]:.2g} to {critical.interval[1]:.2g}")
    figure = Figure(figsize=(5.8, 3.8), layout="constrained", dpi=160)
    axes = figure.subplots()
    reach = np.abs(interval - rate[:, None]).T
    axes.errorbar(DISSIPATIONS, rate, reach, fmt="o", capsize=3, label="first failures, with 95 % interval")
    smooth = np.geomspace(0.9 * DISSIPATIONS[0], 1.1 * DISSIPATIONS[-1], 200)
    law = rc.turbulent_breakage_rate(smooth, KINEMATIC_VISCOSITY, critical.value)
    axes.plot(smooth, law, color="0.4", label="Kusters' law, fitted")
    axes.set(xscale="log", yscale="log", xlabel="mean dissipation, m²/s³", ylabel="breakage rate, 1/s")
    axes.set_xticks(DISSIPATIONS, [f"{each:g}" for each in DISSIPATIONS])
    axes.set_xticks([], minor=True)
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(frameon=False)
    return figure


if __name__ == "__main__":
    breakage_rate_in_turbulence().savefig("breakage_rate_in_turbulence.png")
