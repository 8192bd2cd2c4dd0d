"""Gaussian velocity gradients: strain rate and rotation rate are independent linear random processes.

The model is that of B. K. Brunk, D. L. Koch and L. W. Lion, J. Fluid Mech. 364 (1998) 81. It has the two correlation
times that S. S. Girimaji and S. B. Pope, Phys. Fluids A 2 (1990) 242, found along fluid paths, and lacks all that
is not Gaussian: intermittency, skewness, and the alignment of vorticity with the axes of strain.
"""

from __future__ import annotations

import numpy as np

from rheoclast._checks import FloatArray
from rheoclast.histories import GradientHistory, traceless
from rheoclast.turbulence._requests import Request

STRAIN_TIME = 2.3  # Kolmogorov times
ROTATION_TIME = 7.2
STRAIN_DEVIATION = np.sqrt(1 / 10)  # of each of five orthonormal components, inverse Kolmogorov times
ROTATION_DEVIATION = np.sqrt(1 / 6)  # of each of three


def gaussian_histories(
    count: int,
    duration: float,
    dissipation: float,
    kinematic_viscosity: float,
    seed: int,
    step: float | None = None,
) -> tuple[GradientHistory, ...]:
    """Histories of a Gaussian velocity gradient in isotropic turbulence.

    Strain rate and rotation rate are Ornstein-Uhlenbeck processes with correlation times of 2.3 and 7.2 Kolmogorov
    times (ν/ε)^½. At all instants, from the first on, ⟨Γ_ij Γ_kl⟩ = ε/(30 ν) (4 δ_ik δ_jl − δ_ij δ_kl − δ_il δ_jk).

    Parameters
    ----------
    count
        Number of independent histories. The first ones are the same for any count.
    duration
        Time that each spans from zero on, s.
    dissipation
        Mean dissipation of energy per mass ε, m²/s³.
    kinematic_viscosity
        Kinematic viscosity ν of the liquid, m²/s (water: 1e-6).
    seed
        Equal seeds give equal histories.
    step
        Largest time between instants, s, shortened to fit; by default a tenth of the Kolmogorov time. The process is
        sampled exactly at any step. Between the instants lie straight lines, whose mean square is lower by about
        step/(3 correlation times): 1.4 % for the strain rate at the default.

    Raises
    ------
    ValueError
        If a number is not positive, the seed negative, or there would be more than 10⁸ instants in all.
    """
    request = Request.checked(count, duration, dissipation, kinematic_viscosity, seed, step)
    return tuple(request.history(_path(request.step, len(request.instants), random)) for random in request.random)


def _path(step: float, instants: int, random: np.random.Generator) -> FloatArray:
    """Gradients (T, 3, 3) in inverse Kolmogorov times."""
    normal = random.standard_normal((instants, 3, 3))
    transposed = np.swapaxes(normal, 1, 2)
    strain_rate = _correlated(traceless(normal + transposed) / 2, step / STRAIN_TIME)
    rotation_rate = _correlated((normal - transposed) / 2, step / ROTATION_TIME)
    return STRAIN_DEVIATION * strain_rate + ROTATION_DEVIATION * rotation_rate


def _correlated(normal: FloatArray, step: float) -> FloatArray:
    """The Ornstein-Uhlenbeck process of unit variance and correlation time, from independent normal numbers (T, ...).

    The exact recursion x_k = ρ x_{k−1} + (1 − ρ²)^½ n_k with ρ = exp(−step) (D. T. Gillespie, Phys. Rev. E 54 (1996)
    2084); it starts from the stationary distribution.
    """
    from scipy.signal import lfilter

    innovations = normal * np.sqrt(-np.expm1(-2 * step))
    innovations[0] = normal[0]
    return lfilter([1.0], [1.0, -np.exp(-step)], innovations, axis=0)
