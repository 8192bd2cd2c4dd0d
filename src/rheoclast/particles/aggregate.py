"""Aggregate: spheres and the contacts that hold them together."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial import cKDTree

from rheoclast import _checks
from rheoclast._checks import FloatArray, IntArray
from rheoclast.errors import GeometryError
from rheoclast.graphs import connected_parts
from rheoclast.particles.contacts import CONTACT_TOLERANCE, near_pairs, surface_gaps
from rheoclast.particles.spheres import Spheres

WIDE_GAP = 0.5  # mean radii: wider than any lubricated or badly resolved contact


@dataclass(frozen=True, eq=False, init=False)
class Aggregate:
    """One connected aggregate of touching spheres. Contact c joins spheres `pairs[c]` = (i, j), i < j.

    Parameters
    ----------
    spheres
        The N spheres.
    pairs
        (C, 2) indices of the spheres in contact. `Aggregate.touching` finds them from the surface gaps.

    Raises
    ------
    ValueError
        If an index is out of range, a sphere touches itself or a contact is there twice.
    GeometryError
        If the contacts leave the aggregate in several parts.
    """

    spheres: Spheres
    pairs: IntArray

    def __init__(self, spheres: Spheres, pairs: ArrayLike) -> None:
        _checks.instance("spheres", spheres, Spheres)
        ordered = _contact_pairs(pairs, len(spheres))
        _refuse_parts(spheres, ordered)
        _checks.set_fields(self, spheres=spheres, pairs=_checks.frozen(ordered))

    @classmethod
    def touching(cls, spheres: Spheres, tolerance: float = CONTACT_TOLERANCE) -> Aggregate:
        """The aggregate in which every two spheres touch whose gap is at most `tolerance` mean radii of the pair."""
        _checks.instance("spheres", spheres, Spheres)
        tolerance = _checks.not_negative("tolerance", tolerance)
        return cls(spheres, near_pairs(spheres.centers, spheres.radii, tolerance)[0])

    def __len__(self) -> int:
        """Number of spheres, N."""
        return len(self.spheres)

    def scaled(self, factor: float) -> Aggregate:
        """The same aggregate with all lengths times a positive factor."""
        return Aggregate(self.spheres.scaled(factor), self.pairs)

    def rotated(self, rotation: Any) -> Aggregate:
        """The same aggregate turned about the origin by a (3, 3) rotation matrix or a SciPy `Rotation`."""
        return Aggregate(self.spheres.rotated(rotation), self.pairs)

    @cached_property
    def normals(self) -> FloatArray:
        """Unit vectors (C, 3) from sphere i to sphere j of every contact."""
        first, second = self.pairs.T
        difference = self.spheres.centers[second] - self.spheres.centers[first]
        return _checks.frozen(difference / np.linalg.norm(difference, axis=1, keepdims=True))

    @cached_property
    def contact_points(self) -> FloatArray:
        """Points of contact (C, 3) in m: where the surfaces meet, or midway in a small gap or overlap."""
        first, second = self.pairs.T
        centers, radii = self.spheres.centers, self.spheres.radii
        distance = np.linalg.norm(centers[second] - centers[first], axis=1)
        arm = 0.5 * (distance + radii[first] - radii[second])
        return _checks.frozen(centers[first] + arm[:, None] * self.normals)

    @cached_property
    def gaps(self) -> FloatArray:
        """Gaps (C,) between the surfaces in contact, in mean radii of the two spheres; negative where they overlap."""
        return _checks.frozen(surface_gaps(self.spheres.centers, self.spheres.radii, self.pairs))

    @property
    def hyperstaticity(self) -> int:
        """Degree of hyperstaticity 6 (C − N + 1): zero for a tree, whose contact loads follow from balance alone."""
        return 6 * (len(self.pairs) - len(self) + 1)

    @property
    def is_tree(self) -> bool:
        """Whether no contact closes a loop (isostatic)."""
        return self.hyperstaticity == 0


def _contact_pairs(pairs: ArrayLike, count: int) -> IntArray:
    """Checked copy of contact pairs (C, 2) with i < j in each."""
    given = np.asarray(pairs)
    if given.size == 0:
        given = np.empty((0, 2), dtype=np.intp)
    if given.ndim != 2 or given.shape[1] != 2 or not np.issubdtype(given.dtype, np.integer):
        raise ValueError(f"pairs: expected integers of shape (C, 2), got {given.dtype} of shape {given.shape}")
    ordered = np.sort(given, axis=1).astype(np.intp)
    outside = np.flatnonzero((ordered < 0).any(axis=1) | (ordered >= count).any(axis=1))
    if len(outside):
        c = int(outside[0])
        raise ValueError(f"pairs[{c}] = {given[c].tolist()}: expected indices of spheres from 0 to {count - 1}")
    selfish = np.flatnonzero(ordered[:, 0] == ordered[:, 1])
    if len(selfish):
        c = int(selfish[0])
        raise ValueError(f"pairs[{c}] = {given[c].tolist()}: expected two different spheres")
    unique, first_seen = np.unique(ordered, axis=0, return_index=True)
    if len(unique) < len(ordered):
        c = int(np.setdiff1d(np.arange(len(ordered)), first_seen)[0])
        raise ValueError(f"pairs[{c}] = {given[c].tolist()}: this contact is already in the list; give it once")
    return ordered


def _refuse_parts(spheres: Spheres, pairs: IntArray) -> None:
    part = connected_parts(len(spheres), pairs)
    sizes = np.bincount(part)
    if len(sizes) == 1:
        return
    smallest = np.flatnonzero(part == sizes.argmin())
    i, j, gap = _narrowest_gap(spheres, smallest)
    listed = ", ".join(map(str, smallest[:8])) + (", …" if len(smallest) > 8 else "")
    raise GeometryError(
        f"the aggregate is in {len(sizes)} parts, expected one: sphere{'s' * (len(smallest) > 1)} {listed} "
        f"({len(smallest)} of {len(spheres)}) touch{'es' * (len(smallest) == 1)} no other part; "
        f"nearest are spheres {i} and {j} with a gap of {gap:.3g} mean radii; "
        + (
            "raise the contact tolerance above it or remove the loose part"
            if gap < WIDE_GAP
            else "are these several aggregates, or one cut by a periodic box? Give one, with unwrapped coordinates"
        )
    )


def _narrowest_gap(spheres: Spheres, part: IntArray) -> tuple[int, int, float]:
    """The pair (inside `part`, outside it) with the smallest gap over its mean radius, and that gap."""
    rest = np.setdiff1d(np.arange(len(spheres)), part)
    centers, radii = spheres.centers, spheres.radii
    tree = cKDTree(centers[rest])
    nearest = np.stack([part, rest[tree.query(centers[part])[1]]], axis=1)
    bound = float(surface_gaps(centers, radii, nearest).min())
    # A larger sphere may be nearer by its surface, though not by its centre: look as far as the bound allows.
    reach = (radii[part] + radii[rest].max()) * (1 + bound / 2) * (1 + 1e-12)
    near = [rest[found] for found in tree.query_ball_point(centers[part], reach)]
    pairs = np.stack([np.repeat(part, [len(found) for found in near]), np.concatenate(near)], axis=1)
    gaps = surface_gaps(centers, radii, pairs)
    i, j = pairs[gaps.argmin()].tolist()
    return i, j, float(gaps.min())
