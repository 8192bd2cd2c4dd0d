"""Fragments pulled apart before the eye: opened like a book, so that matching fracture faces are seen.

Coordinates as in `rendering`: x to the right, y upwards, z towards the viewer, in any unit of length.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from rheoclast._checks import FloatArray, IntArray

TURN = np.radians(40)
FACE = 3  # contacts that make a face
GAP = 1.5  # mean radii between fragments
COINCIDENT = 1e-6  # mean radii


@dataclass(frozen=True, eq=False)
class Separation:
    """Motion of F rigid fragments away from each other. Made by `separation`.

    Attributes
    ----------
    fragment
        (N,) number of the fragment of every sphere.
    pivots
        (F, 3) centres of mass, about which the fragments turn.
    turns
        (F, 3) rotation vectors at the end of the motion, in radians.
    shifts
        (F, 3) displacements at the end, in the plane of the picture.
    """

    fragment: IntArray
    pivots: FloatArray
    turns: FloatArray
    shifts: FloatArray

    def moved(self, points: FloatArray, spheres: IntArray, progress: float = 1.0) -> FloatArray:
        """Places (P, 3) of points that are fixed to given spheres (P,), after a share of the motion.

        The fragments first part and then turn, lest they run into each other.
        """
        part = self.fragment[spheres]
        apart = self.shifts * np.sin(np.pi / 2 * progress)
        turned = Rotation.from_rotvec(self.turns * progress**2).as_matrix()
        arms = points - self.pivots[part]
        return np.einsum("pij,pj->pi", turned[part], arms) + (self.pivots + apart)[part]


def separation(centers: FloatArray, radii: FloatArray, members: tuple[IntArray, ...], failed: IntArray) -> Separation:
    """How fragments, the largest first, part until none hides another.

    Each slides away from the largest, along the line between their centres of mass as it is seen. Its face towards
    the largest turns to the viewer by `TURN`; the largest turns that towards the second. Where fewer than `FACE` of
    the failed contacts (K, 2) joined fragments there is no face to show, and none turns.
    """
    fragment = np.zeros(len(radii), dtype=np.intp)
    for part, spheres in enumerate(members):
        fragment[spheres] = part
    weights = [radii[spheres] ** 3 for spheres in members]
    pivots = np.stack([w @ centers[spheres] / w.sum() for w, spheres in zip(weights, members, strict=True)])
    directions = _directions(pivots, float(radii.mean()))
    has_face = np.count_nonzero(np.diff(fragment[failed], axis=1)) >= FACE
    turns = TURN * has_face * np.cross(-directions, [0.0, 0.0, 1.0])
    still = Separation(fragment, pivots, turns, np.zeros_like(pivots))
    turned = still.moved(centers, np.arange(len(radii)))
    shifts = _clearing_shifts(turned, radii + GAP / 2 * radii.mean(), members, directions)
    return Separation(fragment, pivots, turns, shifts)


def _directions(pivots: FloatArray, radius: float) -> FloatArray:
    """Unit vectors (F, 3) in the plane of the picture along which fragments leave the first, which recoils."""
    away = np.column_stack([(pivots - pivots[0])[:, :2], np.zeros(len(pivots))])
    length = np.linalg.norm(away, axis=1, keepdims=True)
    away = np.where(length > COINCIDENT * radius, away / np.maximum(length, COINCIDENT * radius), [1.0, 0.0, 0.0])
    if len(away) > 1:
        away[0] = -away[1]
    return away


def _clearing_shifts(
    centers: FloatArray, radii: FloatArray, members: tuple[IntArray, ...], directions: FloatArray
) -> FloatArray:
    """Smallest displacements (F, 3) with which each fragment stands free of those before it."""
    shifts = np.zeros_like(directions)
    placed = centers.copy()
    for part in range(1, len(members)):
        before, own = np.concatenate(members[:part]), members[part]
        shifts[part] = directions[part] * _clearance(
            (placed[before], radii[before]), (placed[own], radii[own]), directions[part], float(radii.mean()) / 4
        )
        placed[own] += shifts[part]
    return shifts


def _clearance(
    standing: tuple[FloatArray, FloatArray], leaving: tuple[FloatArray, FloatArray], direction: FloatArray, width: float
) -> float:
    """How far spheres must go in a direction until no standing ones are before or beside them.

    Both silhouettes are cut into strips of a width along the direction.
    """
    across = np.array([-direction[1], direction[0], 0.0])
    origin = min(float((points @ across - radii).min()) for points, radii in (standing, leaving))
    end = max(float((points @ across + radii).max()) for points, radii in (standing, leaving))
    count = int((end - origin) / width) + 1
    front = _reach(*standing, direction, across, origin, width, count)
    back = _reach(*leaving, -direction, across, origin, width, count)
    return max(0.0, float((front + back).max()))


def _reach(
    points: FloatArray,
    radii: FloatArray,
    direction: FloatArray,
    across: FloatArray,
    origin: float,
    width: float,
    count: int,
) -> FloatArray:
    """Farthest that discs reach in a direction in each strip (count,), −∞ where there are none."""
    steps = int(np.ceil(radii.max() / width))
    share = np.linspace(-1, 1, 2 * steps + 1)
    place = (points @ across)[:, None] + radii[:, None] * share
    reach = (points @ direction)[:, None] + radii[:, None] * np.sqrt(1 - share**2)
    strip = np.clip(((place - origin) / width).astype(int), 0, count - 1)
    farthest = np.full(count, -np.inf)
    np.maximum.at(farthest, strip, reach)
    return farthest
