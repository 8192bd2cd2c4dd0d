"""Real spherical harmonics: values, products with the unit vector, and rotations.

Real harmonics Y_nm are orthonormal on the unit sphere, ordered m = −n … n, with cos mφ for m > 0 and sin |m|φ for
m < 0 and no Condon–Shortley phase. Degree one is sqrt(3/4π) (y, z, x).
"""

from __future__ import annotations

from functools import cache

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray


def real_harmonics(degree: int, directions: FloatArray) -> FloatArray:
    """Values (..., 2n + 1) of the real harmonics of degree n at unit vectors (..., 3)."""
    from scipy.special import sph_harm_y  # slow to import, and needed by few

    polar, azimuth = _angles(directions)
    order = np.arange(-degree, degree + 1)
    magnitude = np.abs(order)
    complex_values = sph_harm_y(degree, magnitude, polar[..., None], azimuth[..., None])
    parts = np.where(order < 0, complex_values.imag, complex_values.real)
    weights = np.where(order == 0, 1.0, np.sqrt(2) * (-1.0) ** magnitude)
    return weights * parts


def sphere_quadrature(degree: int) -> tuple[FloatArray, FloatArray]:
    """Unit vectors (Q, 3) and weights (Q,), Σ weights = 4π, exact for polynomials up to `degree`.

    Gauss–Legendre in the cosine of the polar angle, equidistant in azimuth.
    """
    cosine, weight = np.polynomial.legendre.leggauss(degree // 2 + 1)
    azimuth = 2 * np.pi * np.arange(degree + 1) / (degree + 1)
    sine = np.sqrt(1 - cosine**2)[:, None]
    directions = np.stack(
        [sine * np.cos(azimuth), sine * np.sin(azimuth), np.broadcast_to(cosine[:, None], (len(cosine), degree + 1))],
        axis=-1,
    )
    weights = np.repeat(2 * np.pi / (degree + 1) * weight, degree + 1)
    return directions.reshape(-1, 3), weights


@cache
def raising(degree: int) -> FloatArray:
    """Matrix elements T[k, m', m] = ∫ Y_{n+1,m'} u_k Y_{n,m} of the unit vector u, (3, 2n + 3, 2n + 1).

    The unit vector times a harmonic of degree n has a part of degree n + 1, given by T_k of that degree, and one of
    degree n − 1, given by the transpose of T_k of degree n − 1.
    """
    directions, weights = sphere_quadrature(2 * degree + 2)
    upper, lower = real_harmonics(degree + 1, directions), real_harmonics(degree, directions)
    return _checks.frozen(np.einsum("q,qa,qk,qb->kab", weights, upper, directions, lower))


def _angles(directions: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Polar angle and azimuth (...) of unit vectors (..., 3), accurate at the poles as well."""
    x, y, z = np.moveaxis(directions, -1, 0)
    return np.arctan2(np.hypot(x, y), z), np.arctan2(y, x)


@cache
def quarter_turn(degree: int) -> FloatArray:
    """Components of the harmonics turned by −π/2 about x, which carries z to y."""
    directions, weights = sphere_quadrature(2 * degree)
    turned_back = np.stack([directions[:, 0], -directions[:, 2], directions[:, 1]], axis=1)
    values, turned = real_harmonics(degree, directions), real_harmonics(degree, turned_back)
    return _checks.frozen(np.einsum("q,qa,qb->ab", weights, values, turned))
