"""
Tumbling in shear
=================

An aggregate in simple shear does not stay where it is weakest: it tumbles, and its contacts are pulled and pressed in
turn. `rheoclast.trajectory` follows the orientation, `rheoclast.load_history` the largest load on the way, as a share
of what breaks the contact.

Above, the axis of least inertia of an open aggregate; it lingers along the flow and turns over quickly. Below, the
largest load of all contacts over its strength. Each colour is another critical contact. The dashed line is the worst of
all orientations, which the orbit comes near only now and then.
"""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

import rheoclast as rc

SHEAR = rc.simple_shear(rate=1e4)
STRAIN = 60.0


def tumbling() -> tuple[rc.LoadHistory, np.ndarray, float]:
    """Loads along the orbit, the axis of least inertia (T, 3) in lab axes, and the largest load of all orientations."""
    floc = rc.generation.cluster_cluster(80, radius=0.5e-6, seed=4)
    bonds = rc.jkr_bonds(floc, rc.MATERIALS["polystyrene"])
    response = rc.rigid_response(floc.spheres, rc.StokesianDynamics(), viscosity=1e-3)
    table = rc.contact_response(floc, response, bonds)
    orbit = rc.trajectory(response, SHEAR, duration=STRAIN / SHEAR.rate)
    history = rc.load_history(orbit, table, bonds)
    longest = np.linalg.eigh(rc.gyration_tensor(floc.spheres))[1][:, -1]
    return history, orbit.rotation(history.times) @ longest, SHEAR.rate / rc.worst_initiation(table, bonds, SHEAR).rate


def tumbling_in_shear() -> Figure:
    """Orientation and largest load against strain."""
    history, axis, worst = tumbling()
    strain = SHEAR.rate * history.times
    figure = Figure(figsize=(8.0, 4.6), layout="constrained", dpi=160)
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(2, 3))
    for component, name in zip(axis.T, ("along the flow", "along its gradient", "along the vorticity"), strict=True):
        above.plot(strain, component, label=name)
    above.set(ylabel="axis of the floc", ylim=(-1.05, 1.05))
    above.legend(frameon=False, ncols=3, loc="lower left", bbox_to_anchor=(0, 1))
    for place, contact in enumerate(np.unique(history.contact)):
        carried = np.where(history.contact == contact, history.largest, np.nan)
        below.plot(strain, carried, color=f"C{place % 10}", lw=2)
    below.axhline(worst, color="0.4", ls="--", lw=1)
    below.annotate("worst of all orientations", (0, worst), (0, 3), "data", "offset points",
                   va="bottom", color="0.4")  # fmt: skip
    below.set(xlabel="strain (shear rate × time)", ylabel="largest load / strength", ylim=(0, 1.15 * worst))
    for axes in (above, below):
        axes.spines[["top", "right"]].set_visible(False)
    return figure


if __name__ == "__main__":
    tumbling_in_shear().savefig("tumbling_in_shear.png")
