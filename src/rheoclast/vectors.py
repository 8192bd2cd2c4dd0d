"""Vector and tensor algebra that fluid and structure share.

A symmetric traceless tensor E has five components e_k = B_k : E on the orthonormal basis `STRAIN_BASIS`
(B_k : B_l = 1 if k = l, else 0), so that E = Σ e_k B_k. The components are ordered like the real spherical
harmonics of degree two, m = −2 … 2: xy, yz, (2zz − xx − yy), zx, (xx − yy).
"""

from __future__ import annotations

import numpy as np

from rheoclast._checks import FloatArray, frozen

LEVI_CIVITA: FloatArray = np.zeros((3, 3, 3))
for _i, _j, _k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
    LEVI_CIVITA[_i, _j, _k], LEVI_CIVITA[_i, _k, _j] = 1.0, -1.0
frozen(LEVI_CIVITA)

STRAIN_BASIS: FloatArray = frozen(
    np.array(
        [
            [[0, 1, 0], [1, 0, 0], [0, 0, 0]],
            [[0, 0, 0], [0, 0, 1], [0, 1, 0]],
            [[-1 / np.sqrt(3), 0, 0], [0, -1 / np.sqrt(3), 0], [0, 0, 2 / np.sqrt(3)]],
            [[0, 0, 1], [0, 0, 0], [1, 0, 0]],
            [[1, 0, 0], [0, -1, 0], [0, 0, 0]],
        ]
    )
    / np.sqrt(2)
)


def strain_components(tensor: FloatArray) -> FloatArray:
    """Components (..., 5) of symmetric traceless tensors (..., 3, 3) on `STRAIN_BASIS`."""
    return np.einsum("kij,...ij->...k", STRAIN_BASIS, tensor)


def strain_tensor(components: FloatArray) -> FloatArray:
    """Symmetric traceless tensors (..., 3, 3) from components (..., 5) on `STRAIN_BASIS`."""
    return np.einsum("...k,kij->...ij", components, STRAIN_BASIS)


def cross_matrix(vector: FloatArray) -> FloatArray:
    """Matrices (..., 3, 3) with cross_matrix(v) @ w = v × w, from vectors (..., 3)."""
    return np.einsum("ikj,...k->...ij", LEVI_CIVITA, vector)


def elementary_velocities(points: FloatArray) -> FloatArray:
    """Velocities (..., 11, 3) of the eleven elementary flows at points x (..., 3).

    Three unit streams e_k, three unit rotations e_k × x, five unit strains B_k·x. Contracted with a force at x, the
    same array gives that force, its moment about the origin, and its stresslet components.
    """
    streams = np.broadcast_to(np.eye(3), (*points.shape[:-1], 3, 3))
    rotations = np.einsum("ckj,...j->...kc", LEVI_CIVITA, points)
    strains = np.einsum("kcj,...j->...kc", STRAIN_BASIS, points)
    return np.concatenate([streams, rotations, strains], axis=-2)
