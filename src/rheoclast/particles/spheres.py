"""Spheres: centres and radii that do not overlap."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.errors import GeometryError
from rheoclast.particles.contacts import CONTACT_TOLERANCE, near_pairs

ROUNDING = 1e-12
LARGEST_OVERLAP = 2 * (1 - 1e-9)  # mean radii: beyond it two spheres of like size are at one place
EXTREME_LENGTH = 1e50


@dataclass(frozen=True, eq=False, init=False)
class Spheres:
    """Rigid spheres in space. Hydrodynamics sees these and nothing else.

    Parameters
    ----------
    centers
        (N, 3) in m.
    radii
        (N,) in m, or one value for all.
    overlap_tolerance
        Largest overlap of two spheres, in mean radii of the pair, that counts as touching.

    Raises
    ------
    ValueError
        If a shape is wrong, a number is not finite or a radius not positive.
    GeometryError
        If two spheres overlap by more than the tolerance, or one is there twice.
    """

    centers: FloatArray
    radii: FloatArray
    overlap_tolerance: float

    def __init__(self, centers: ArrayLike, radii: ArrayLike, overlap_tolerance: float = CONTACT_TOLERANCE) -> None:
        places = _checks.real_array("centers", centers, ("N", 3))
        if len(places) == 0:
            raise ValueError("centers: expected at least one sphere, got none")
        each = np.broadcast_to(radii, len(places)) if np.ndim(radii) == 0 else radii
        sizes = _checks.positive_array("radii", each, ("N",))
        if len(sizes) != len(places):
            raise ValueError(f"radii: expected one per sphere ({len(places)}) or a single value, got {len(sizes)}")
        tolerance = _checks.not_negative("overlap_tolerance", overlap_tolerance)
        _refuse_extreme("centers", places, smallest=0.0)
        _refuse_extreme("radii", sizes, smallest=1 / EXTREME_LENGTH)
        _refuse_overlap(places, sizes, tolerance)
        _checks.set_fields(self, centers=places, radii=sizes, overlap_tolerance=tolerance)

    def __len__(self) -> int:
        return len(self.radii)

    def scaled(self, factor: float) -> Spheres:
        """The same spheres with all lengths times a positive factor."""
        factor = _checks.positive("factor", factor)
        return Spheres(factor * self.centers, factor * self.radii, self.overlap_tolerance)

    def rotated(self, rotation: Any) -> Spheres:
        """The same spheres turned about the origin by a (3, 3) rotation matrix or a SciPy `Rotation`."""
        matrix = _checks.rotation_matrix("rotation", rotation)
        return Spheres(self.centers @ matrix.T, self.radii, self.overlap_tolerance)

    @cached_property
    def mean_radius(self) -> float:
        """Mean radius in m, the unit of length in which everything is computed."""
        return float(self.radii.mean())

    @property
    def volumes(self) -> FloatArray:
        """Volume of every sphere, (N,), in m³."""
        return 4 / 3 * np.pi * self.radii**3

    @cached_property
    def center_of_mass(self) -> FloatArray:
        """Centre of mass at uniform density, (3,), in m."""
        return _checks.frozen(np.average(self.centers, axis=0, weights=self.volumes))


def _refuse_extreme(name: str, lengths: FloatArray, smallest: float) -> None:
    """Refuse lengths whose powers overflow or vanish."""
    size = np.abs(lengths)
    extreme = np.argwhere((size > EXTREME_LENGTH) | (size < smallest))
    if len(extreme):
        item = tuple(int(k) for k in extreme[0])
        raise ValueError(
            f"{name}{list(item)}: expected a length between 1e-50 and 1e50, got {lengths[item]:.3g}; check the unit"
        )


def _rounded_up(value: float) -> str:
    """A positive number with two digits, not below it."""
    digit = 10.0 ** (math.floor(math.log10(value)) - 1)
    return f"{math.ceil(value / digit * (1 - 1e-9)) * digit:.2g}"


def _refuse_overlap(centers: FloatArray, radii: FloatArray, tolerance: float) -> None:
    pairs, gaps = near_pairs(centers, radii, 0.0)
    if not len(gaps) or gaps.min() >= -min(tolerance, LARGEST_OVERLAP) - ROUNDING:
        return
    worst = int(gaps.argmin())
    i, j = (int(k) for k in pairs[worst])
    distance, sum_of_radii = float(np.linalg.norm(centers[j] - centers[i])), radii[i] + radii[j]
    others = int(np.sum(gaps < -tolerance - ROUNDING)) - 1
    more = f" (and {others} more pair{'s' * (others > 1)})" if others else ""
    if distance <= 1e-9 * sum_of_radii:
        raise GeometryError(f"spheres {i} and {j} are at the same place {centers[i]}{more}; remove the duplicate")
    raise GeometryError(
        f"spheres {i} and {j} overlap: distance {distance:.6g} < {sum_of_radii:.6g} = sum of radii{more}; "
        f"shrink the radii or pass overlap_tolerance (here at least {_rounded_up(-gaps[worst])})"
    )
