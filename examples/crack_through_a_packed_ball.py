"""
A crack through a packed ball
=============================

In a dense aggregate one failed contact splits nothing: its neighbours take over the load, and as the rate is raised
they fail in their turn. Every failure changes the frame alone, never the flow, so that a crack of a hundred contacts
costs one solution of the fluid and a hundred small updates of one factorization.

The ball meets an extension along its weakest direction. Discs and spots are failed contacts, coloured by their order;
below are the rates at which they fail. Where the rate falls, contacts fail in an avalanche.
"""

from __future__ import annotations

from matplotlib.figure import Figure

import rheoclast as rc
from rheoclast import view


def broken_ball() -> tuple[rc.Breakup, rc.LinearFlow]:
    """A packed ball of 120 spheres, broken by uniaxial extension in the orientation that is worst for tension."""
    ball = rc.generation.random_packed_ball(120, radius=0.5e-6, seed=5)
    bonds = rc.jkr_bonds(ball, rc.MATERIALS["polystyrene"])
    response = rc.rigid_response(ball.spheres, rc.StokesianDynamics(), viscosity=1e-3)
    table = rc.contact_response(ball, response, bonds)
    flow = rc.worst_initiation(table, bonds, rc.uniaxial_extension(rate=1.0)).flow
    return rc.break_up(ball, response, bonds, flow), flow


def crack_through_a_packed_ball() -> Figure:
    """The failed contacts in their order, and the fragments pulled apart."""
    breakup, flow = broken_ball()
    print(f"{len(breakup.failures)} failures; fragments of {[len(part) for part in breakup.spheres]} spheres")
    print(f"begins at {breakup.initiation_rate:.3g} 1/s, splits at {breakup.breakup_rate:.3g} 1/s")
    return view.draw_crack(breakup, flow=flow)


if __name__ == "__main__":
    crack_through_a_packed_ball().savefig("crack_through_a_packed_ball.png")
