"""From which side an aggregate is seen."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.particles.spheres import Spheres


def view_axes(spheres: Spheres, view_direction: ArrayLike | None = None) -> FloatArray:
    """Unit vectors to the right, upwards and towards the viewer, the rows of a rotation matrix (3, 3).

    Without a direction the aggregate is seen at its broadest: the largest principal axis of its gyration tensor lies
    to the right, the smallest along the line of sight, each pointing to where the outliers are. With a direction
    (3,), from the aggregate to the viewer, z is upwards, or y when looking along z.
    """
    if view_direction is None:
        return _broadest_view(spheres)
    toward = _checks.real_array("view_direction", view_direction, (3,))
    length = float(np.linalg.norm(toward))
    if length == 0:
        raise ValueError("view_direction: expected a direction (x, y, z), got zeros; (0, 0, 1) looks from above")
    toward = toward / length
    upwards = np.array([0.0, 0.0, 1.0] if abs(toward[2]) < 0.999 else [0.0, 1.0, 0.0])
    right = np.cross(upwards, toward)
    right /= np.linalg.norm(right)
    return np.stack([right, np.cross(toward, right), toward])


def principal_axes(tensor: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Eigenvalues, largest first, and eigenvectors as rows of a symmetric tensor (3, 3).

    Where eigenvalues coincide, the eigenvectors keep to the axes of coordinates in their order.
    """
    size = float(np.abs(tensor).max()) or 1.0
    vectors = np.linalg.eigh(tensor + 1e-6 * size * np.diag([2.0, 1.0, 0.0]))[1].T[::-1]
    return np.einsum("ki,ij,kj->k", vectors, tensor, vectors), vectors


def _broadest_view(spheres: Spheres) -> FloatArray:
    offset = spheres.centers - spheres.center_of_mass
    axes = principal_axes(np.einsum("n,ni,nj->ij", spheres.volumes, offset, offset))[1]
    right, up = (_outwards(axis, offset @ axis, spheres.volumes) for axis in axes[:2])
    return np.stack([right, up, np.cross(right, up)])


def _outwards(axis: FloatArray, position: FloatArray, weights: FloatArray) -> FloatArray:
    """The axis or its opposite: with positive third moment, or with positive largest component in a symmetric body."""
    size = float(np.sum(weights * np.abs(position) ** 3))
    skewness = float(np.sum(weights * position**3))
    if abs(skewness) < 1e-6 * size or size == 0:
        skewness = float(axis[np.argmax(np.abs(axis) - 1e-6 * np.arange(3))])
    return axis if skewness > 0 else -axis
