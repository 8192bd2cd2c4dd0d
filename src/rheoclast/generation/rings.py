"""Rings and crosses: the smallest shapes with a loop, and with a branch."""

from __future__ import annotations

import numpy as np

from rheoclast import _checks
from rheoclast.generation._unit_spheres import unit_sphere_aggregate
from rheoclast.particles.aggregate import Aggregate


def ring(count: int, radius: float = 1.0) -> Aggregate:
    """Ring of `count` ≥ 3 equal spheres, `radius` in m, in the plane z = 0, the first on the positive x axis.

    Raises
    ------
    ValueError
        If the count is below three.
    """
    count = _checks.whole_number("count", count, 3)
    angle = 2 * np.pi * np.arange(count) / count
    directions = np.stack([np.cos(angle), np.sin(angle), np.zeros(count)], axis=1)
    return unit_sphere_aggregate(directions / np.sin(np.pi / count), radius)


def cross(arm: int, radius: float = 1.0, *, arms: int = 4) -> Aggregate:
    """Cross of equal spheres, `radius` in m: one at the centre, and `arm` ≥ 1 more along each of its arms.

    Four `arms` lie along ± x and ± y, six along ± x, ± y and ± z. Sphere 0 is the centre; then follow the spheres of
    +x outwards, of −x, +y, …: 1 + arm · arms spheres.

    Raises
    ------
    ValueError
        If an arm has no sphere, or the number of arms is another.
    """
    arm = _checks.whole_number("arm", arm, 1)
    if arms not in (4, 6):
        raise ValueError(f"arms: expected 4 (in a plane) or 6 (in space), got {arms!r}")
    directions = np.stack([np.eye(3), -np.eye(3)], axis=1).reshape(6, 3)[:arms]
    places = 2.0 * np.arange(1, arm + 1)[:, None] * directions[:, None]
    return unit_sphere_aggregate(np.concatenate([np.zeros((1, 3)), places.reshape(-1, 3)]), radius)
