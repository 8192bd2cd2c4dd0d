"""Placing one cluster in contact with another at a prescribed distance of the centres of mass, compiled by Numba."""

from __future__ import annotations

import numpy as np
from numba import njit

from rheoclast._checks import FloatArray
from rheoclast.generation._clusters import ROUNDING, Cluster, overlap
from rheoclast.generation._orientations import random_direction, random_normal, random_rotation, random_turn


@njit(cache=True)
def contact_at_distance(
    fixed: Cluster, moved: Cluster, distance: float, trials: int, rng: np.random.Generator
) -> tuple[bool, FloatArray, FloatArray]:
    """Random rigid motion of the second cluster that makes it touch the first, its centre at `distance`.

    Every trial draws a sphere of either cluster whose contact is possible at this distance, the place of the second
    centre, the place of the contact, and the angle about the line from the second centre to its sphere.

    Returns
    -------
    found, rotation, shift
        Whether one of the trials did not overlap, and the motion x ↦ R x + t.
    """
    reach, moved_reach = _reach(fixed), _reach(moved)
    # Near the largest distance only spheres at the rim can touch: the others need not be drawn.
    rim = np.flatnonzero(reach + moved_reach.max() >= distance - ROUNDING)
    moved_rim = np.flatnonzero(moved_reach + reach.max() >= distance - ROUNDING)
    rotation, shift = np.eye(3), np.zeros(3)
    if rim.size == 0 or moved_rim.size == 0:
        return False, rotation, shift
    for _ in range(trials):
        i, j = rim[rng.integers(0, rim.size)], moved_rim[rng.integers(0, moved_rim.size)]
        found, shift, arm = _linkage(fixed, i, moved, j, distance, rng)
        if not found:
            continue
        rotation = _turn_onto(moved.centers[j], arm, rng)
        shift = _in_contact(fixed, i, moved, j, rotation, shift)
        if not overlap(fixed, moved, rotation, shift):
            return True, rotation, shift
    return False, rotation, shift


@njit(cache=True)
def _reach(one: Cluster) -> FloatArray:
    """Distance of the far side of every sphere from the centre of mass."""
    return np.sqrt((one.centers**2).sum(axis=1)) + one.radii


@njit(cache=True)
def _linkage(
    fixed: Cluster, i: int, moved: Cluster, j: int, distance: float, rng: np.random.Generator
) -> tuple[bool, FloatArray, FloatArray]:
    """Whether spheres i and j can touch; then a random place of the second centre, and of sphere j from there."""
    first, contact = fixed.centers[i], fixed.radii[i] + moved.radii[j]
    first_arm, second_arm = np.sqrt(np.dot(first, first)), np.sqrt(np.dot(moved.centers[j], moved.centers[j]))
    near = max(abs(second_arm - contact), abs(distance - first_arm))
    far = min(second_arm + contact, distance + first_arm)
    if near > far + ROUNDING:
        return False, first, first
    chord2 = near * near + (far * far - near * near) * rng.random()
    center = _third_corner(first, distance, chord2, rng)
    return True, center, _third_corner(first - center, second_arm, contact * contact, rng)


@njit(cache=True)
def _third_corner(base: FloatArray, arm: float, chord2: float, rng: np.random.Generator) -> FloatArray:
    """Random point at distance `arm` from the origin and √`chord2` from the point `base`."""
    length = np.sqrt(np.dot(base, base))
    if length * arm == 0:
        return arm * random_direction(rng)
    axis = base / length
    cosine = min(max((length * length + arm * arm - chord2) / (2 * length * arm), -1.0), 1.0)
    return arm * (cosine * axis + np.sqrt(1 - cosine * cosine) * random_normal(axis, rng))


@njit(cache=True)
def _turn_onto(start: FloatArray, end: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Random rotation that takes the point `start` to `end`, as far from the origin."""
    length = np.sqrt(np.dot(start, start))
    return random_rotation(rng) if length == 0 else random_turn(start / length, end / length, rng)


@njit(cache=True)
def _in_contact(fixed: Cluster, i: int, moved: Cluster, j: int, rotation: FloatArray, shift: FloatArray) -> FloatArray:
    """The shift, corrected along the line of centres: between long arms, rounding would leave a gap."""
    line = rotation @ moved.centers[j] + shift - fixed.centers[i]
    length = np.sqrt(np.dot(line, line))
    return shift + ((fixed.radii[i] + moved.radii[j]) / length - 1) * line
