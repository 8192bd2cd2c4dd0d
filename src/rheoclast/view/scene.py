"""A breakup as it is seen: spheres, failed contacts and fragments in the coordinates of the picture."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rheoclast import _checks
from rheoclast._checks import FloatArray, IntArray
from rheoclast.breakup.event import Breakup
from rheoclast.view.fragments import fragment_colours
from rheoclast.view.layout import extent
from rheoclast.view.projection import view_axes
from rheoclast.view.separation import Separation, separation

ROUNDING = 1e-6


@dataclass(frozen=True, eq=False)
class Scene:
    """An aggregate and its crack in the coordinates of the picture, in the unit of the aggregate.

    Attributes
    ----------
    centers, radii, colours
        Of the spheres (N, 3), (N,), (N, 3).
    pairs, points, normals
        Of the K failed contacts in their order, (K, 2), (K, 3), (K, 3).
    parting
        How the fragments are pulled apart.
    axes
        To the right, upwards and towards the viewer (3, 3).
    """

    centers: FloatArray
    radii: FloatArray
    colours: FloatArray
    pairs: IntArray
    points: FloatArray
    normals: FloatArray
    parting: Separation
    axes: FloatArray

    @property
    def smaller_radii(self) -> FloatArray:
        """(K,) smaller radius of the two spheres of each failed contact."""
        return self.radii[self.pairs].min(axis=1)

    def corners(self, progress: float = 0.0) -> tuple[FloatArray, FloatArray]:
        """Lower left and upper right of what is seen after a share of the parting."""
        return extent(self.parting.moved(self.centers, np.arange(len(self.radii)), progress), self.radii)


def scene(breakup: Breakup, view_direction: ArrayLike | None) -> Scene:
    """What is drawn of a breakup.

    Raises
    ------
    TypeError
        If one of the arguments is something else.
    ValueError
        If the view direction is zero.
    """
    _checks.instance("breakup", breakup, Breakup, "make one with break_up(aggregate, response, bonds, flow)")
    aggregate = breakup.aggregate
    axes = crack_axes(breakup) if view_direction is None else view_axes(aggregate.spheres, view_direction)
    failed = np.array([failure.contact for failure in breakup.failures], dtype=np.intp)
    centers, radii = aggregate.spheres.centers @ axes.T, aggregate.spheres.radii
    return Scene(
        centers,
        radii,
        fragment_colours(breakup),
        aggregate.pairs[failed],
        aggregate.contact_points[failed] @ axes.T,
        aggregate.normals[failed] @ axes.T,
        separation(centers, radii, breakup.spheres, aggregate.pairs[failed]),
        axes,
    )


def crack_axes(breakup: Breakup) -> FloatArray:
    """View (3, 3) with the second fragment to the right of the largest; across that line as broad as can be."""
    spheres, broadest = breakup.aggregate.spheres, view_axes(breakup.aggregate.spheres)
    if not breakup.splits:
        return broadest
    line = breakup.fragments[1].spheres.center_of_mass - breakup.fragments[0].spheres.center_of_mass
    length = float(np.linalg.norm(line))
    if length < ROUNDING * spheres.mean_radius:
        return broadest
    right = line / length
    offset = spheres.centers - spheres.center_of_mass
    spread = np.einsum("n,ni,nj->ij", spheres.volumes, offset, offset)
    # Where all directions across the line are alike, as in a straight chain, those of the broadest view are kept.
    spread += ROUNDING * np.trace(spread) * (broadest.T @ np.diag([1.0, 2.0, 1.0]) @ broadest)
    across = np.eye(3) - np.outer(right, right)
    up = np.linalg.eigh(across @ spread @ across)[1][:, -1]
    up *= np.sign(up @ broadest[1]) or 1.0
    return np.stack([right, up, np.cross(right, up)])
