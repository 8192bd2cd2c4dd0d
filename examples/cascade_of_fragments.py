"""
A cascade of fragments
======================

What remains of an aggregate in a flow several times as fast as the one that breaks it? The fragments are carried by the
same flow, each with its own hydrodynamics, and break in their turn, until all hold.

Each bar is a piece, as wide as its number of spheres, below the piece that it comes from. Dark ones hold.
"""

from __future__ import annotations

from matplotlib.figure import Figure

import rheoclast as rc

SPHERES = 150
EXCESS = 6.0


def cascade() -> rc.Cascade:
    """An open floc in uniaxial extension at several times the rate at which its first contact fails."""
    floc = rc.generation.cluster_cluster(SPHERES, radius=0.5e-6, seed=8)
    bonds = rc.jkr_bonds(floc, rc.MATERIALS["polystyrene"])
    response = rc.rigid_response(floc.spheres, rc.StokesianDynamics(), viscosity=1e-3)
    table = rc.contact_response(floc, response, bonds)
    weakest = rc.worst_initiation(table, bonds, rc.uniaxial_extension(rate=1.0))
    return rc.cascade(floc, response, bonds, weakest.flow.scaled(EXCESS), orientation="worst")


def places(pieces: tuple[rc.Piece, ...]) -> list[int]:
    """Left end of every piece's bar, in spheres: children side by side below their parent."""
    left: list[int] = []
    free: list[int] = []
    for piece in pieces:
        start = 0 if piece.parent is None else free[piece.parent]
        left.append(start)
        free.append(start)
        if piece.parent is not None:
            free[piece.parent] += len(piece.aggregate)
    return left


def cascade_of_fragments() -> Figure:
    """The pieces generation by generation, from the aggregate to what holds."""
    event = cascade()
    print(f"{len(event.remaining)} fragments hold, of {event.sizes.tolist()} spheres")
    figure = Figure(figsize=(8.4, 4.2), layout="constrained", dpi=160)
    axes = figure.subplots()
    for left, piece in zip(places(event.pieces), event.pieces, strict=True):
        size = len(piece.aggregate)
        colour = "#2a5b84" if piece.holds else "#c9d9e6"
        axes.broken_barh([(left, size)], (piece.generation - 0.42, 0.84), color=colour, ec="white", lw=1.0)
        if size >= 5:
            ink = "white" if piece.holds else "#2a5b84"
            axes.text(left + size / 2, piece.generation, str(size), ha="center", va="center", color=ink, fontsize=8)
    deepest = max(piece.generation for piece in event.pieces)
    axes.set(xlim=(0, SPHERES), ylim=(deepest + 0.6, -0.6), yticks=range(deepest + 1))
    axes.set(xlabel="spheres", ylabel="generation")
    axes.spines[["top", "right"]].set_visible(False)
    return figure


if __name__ == "__main__":
    cascade_of_fragments().savefig("cascade_of_fragments.png")
