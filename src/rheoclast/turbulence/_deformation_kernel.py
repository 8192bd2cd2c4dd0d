"""Paths of the recent-fluid-deformation equation, compiled by Numba, in units of its integral time T.

With A the velocity gradient and C = exp(γA) exp(γAᵀ) the deformation over the last γ T,

    dA = [−A² + tr(A²)/tr(C⁻¹) C⁻¹ − tr(C⁻¹)/3 A] dt + dW,  ⟨dW_ij dW_kl⟩ = (2 δ_ik δ_jl − ½ δ_ij δ_kl − ½ δ_il δ_jk) dt

(L. Chevillard and C. Meneveau, Phys. Rev. Lett. 97 (2006) 174501). Heun's scheme has weak order two, because the noise
is additive (P. E. Kloeden and E. Platen, Numerical Solution of Stochastic Differential Equations (1992), section 15.1).
"""

from __future__ import annotations

import numpy as np
from numba import njit

from rheoclast._checks import FloatArray

GRADIENT_NOISE = (np.sqrt(1.5) + np.sqrt(2.5)) / 2
TRANSPOSE_NOISE = (np.sqrt(1.5) - np.sqrt(2.5)) / 2
ROUNDING = 1e-16


@njit(cache=True, error_model="numpy")
def follow(
    start: FloatArray, memory: float, step: float, steps: int, random: np.random.Generator, path: FloatArray
) -> None:
    """Write `path` (K, 3, 3), from a gradient (3, 3) on, with a number of steps from one instant to the next."""
    gradient = start.copy()
    path[0] = gradient
    for instant in range(1, len(path)):
        for _ in range(steps):
            noise = increment(step, random)
            slope = drift(gradient, memory)
            ahead = drift(gradient + step * slope + noise, memory)
            gradient = gradient + 0.5 * step * (slope + ahead) + noise
        path[instant] = gradient


@njit(cache=True, error_model="numpy")
def drift(gradient: FloatArray, memory: float) -> FloatArray:
    """Deterministic part of dA/dt (3, 3) at a traceless gradient A (3, 3), with γ the memory."""
    square = product(gradient, gradient)
    inverse_deformation = exponential(gradient, square, -memory)
    inverse_cauchy_green = product(inverse_deformation.T, inverse_deformation)
    stretch = trace(inverse_cauchy_green)
    return trace(square) / stretch * inverse_cauchy_green - square - stretch / 3 * gradient


@njit(cache=True, error_model="numpy")
def exponential(matrix: FloatArray, square: FloatArray, factor: float) -> FloatArray:
    """exp(factor · M), (3, 3), of a traceless matrix M and its square.

    By the theorem of Cayley and Hamilton, M³ = ½ tr(M²) M + det(M) 1: every term of the series is a sum of 1, M and M²,
    and the coefficients of one term follow from those of the term before.
    """
    half_trace, determinant = 0.5 * trace(square), trace(product(square, matrix)) / 3
    a, b, c = 1.0, 0.0, 0.0
    sum_a, sum_b, sum_c = 1.0, 0.0, 0.0
    size = np.sqrt(np.sum(matrix**2))
    order, bound = 0, 1.0
    while ROUNDING < bound < np.inf:
        order += 1
        share = factor / order
        a, b, c = share * determinant * c, share * (a + half_trace * c), share * b
        sum_a, sum_b, sum_c = sum_a + a, sum_b + b, sum_c + c
        bound *= abs(share) * size
    return sum_a * np.eye(3) + sum_b * matrix + sum_c * square


@njit(cache=True, error_model="numpy")
def increment(step: float, random: np.random.Generator) -> FloatArray:
    """Noise dW (3, 3) of one step: isotropic, Gaussian and traceless, from nine independent normal numbers."""
    normal = np.empty((3, 3))
    for i in range(3):
        for j in range(3):
            normal[i, j] = random.standard_normal()
    noise = GRADIENT_NOISE * normal + TRANSPOSE_NOISE * normal.T
    return np.sqrt(step) * (noise - trace(noise) / 3 * np.eye(3))


@njit(cache=True, error_model="numpy")
def product(left: FloatArray, right: FloatArray) -> FloatArray:
    """Product of two (3, 3) matrices; the library's would take longer to call than to compute."""
    out = np.empty((3, 3))
    for i in range(3):
        for j in range(3):
            out[i, j] = left[i, 0] * right[0, j] + left[i, 1] * right[1, j] + left[i, 2] * right[2, j]
    return out


@njit(cache=True, error_model="numpy")
def trace(matrix: FloatArray) -> float:
    """Trace of a (3, 3) matrix."""
    return matrix[0, 0] + matrix[1, 1] + matrix[2, 2]
