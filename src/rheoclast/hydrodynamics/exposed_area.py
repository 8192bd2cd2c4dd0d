"""Exposed area: free draining, reduced by the shelter that spheres give each other."""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.hydrodynamics.free_draining import FreeDraining
from rheoclast.hydrodynamics.model import Approximation, HydrodynamicModel
from rheoclast.progress import Progress


@final
@dataclass(frozen=True)
class ExposedArea(HydrodynamicModel):
    """Free-draining loads of each sphere times the fraction of its surface that sees the fluid unobstructed.

    A surface element is exposed if the ray that leaves it along its normal meets no other sphere.

    Parameters
    ----------
    rays
        Number of rays from each sphere, spread evenly; the fraction is good to rays^(−3/4).
    """

    rays: int = 4096

    def __post_init__(self) -> None:
        if not isinstance(self.rays, int | np.integer) or self.rays < 1:
            raise ValueError(f"rays: expected an integer of at least 1, got {self.rays!r}")

    def elementary_loads(
        self, centers: FloatArray, radii: FloatArray, progress: Progress | None = None
    ) -> list[Approximation]:
        """See `HydrodynamicModel.elementary_loads`."""
        (alone,) = FreeDraining().elementary_loads(centers, radii, progress)
        exposed = exposed_fractions(centers, radii, self.rays)
        return [Approximation(exposed[:, None, None] * alone.loads)]


def exposed_fractions(centers: FloatArray, radii: FloatArray, rays: int) -> FloatArray:
    """Fraction (N,) of every sphere's surface from which a ray along the normal meets no other sphere.

    Sphere j shelters a cap of sphere i of half-angle arcsin(a_j / d_ij); the caps may overlap.
    """
    directions = _even_directions(rays)
    fractions = np.empty(len(radii))
    for i, center in enumerate(centers):
        others = np.arange(len(radii)) != i
        separation = centers[others] - center
        distance = np.linalg.norm(separation, axis=1)
        edge = np.sqrt(np.maximum(distance**2 - radii[others] ** 2, 0))
        fractions[i] = 1 - np.any(directions @ separation.T > edge, axis=1).mean()
    return _checks.frozen(fractions)


def _even_directions(count: int) -> FloatArray:
    """Unit vectors (Q, 3) on a Fibonacci spiral, each for an equal area."""
    step = np.arange(count)
    cosine = 1 - (2 * step + 1) / count
    azimuth = np.pi * (1 + np.sqrt(5)) * step
    sine = np.sqrt(1 - cosine**2)
    return np.stack([sine * np.cos(azimuth), sine * np.sin(azimuth), cosine], axis=1)
