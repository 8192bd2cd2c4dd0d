"""The recent-fluid-deformation model of the velocity gradient in isotropic turbulence.

Pressure and viscous forces are closed by the deformation that the fluid has undergone during the last Kolmogorov time,
and a random force feeds energy (L. Chevillard and C. Meneveau, Phys. Rev. Lett. 97 (2006) 174501; limits of validity:
M. Martins Afonso and C. Meneveau, Physica D 239 (2010) 1241).
"""

from __future__ import annotations

import numpy as np

from rheoclast._checks import FloatArray
from rheoclast.histories import GradientHistory
from rheoclast.turbulence._requests import Request

MEMORY = 0.1  # time over which deformation is remembered, in integral times T
MEAN_SQUARE_MAGNITUDE = 11.16  # 2 ⟨E:E⟩ T², ± 0.01: the mean over 2.8·10⁶ T with steps of 0.01 T
LONGEST_STEP = 0.02  # integral times
SETTLING_TIME = 10.0  # integral times


def recent_deformation_histories(
    count: int,
    duration: float,
    dissipation: float,
    kinematic_viscosity: float,
    seed: int,
    step: float | None = None,
) -> tuple[GradientHistory, ...]:
    """Histories of a velocity gradient that is skewed, intermittent and aligned as in isotropic turbulence.

    The model's own unit of time is chosen so that the mean of 2 ν E:E is the dissipation. Its one parameter, the ratio
    of memory to integral time, has the published value 0.1, which belongs to a Taylor-scale Reynolds number of about
    150; higher Reynolds numbers are out of its reach. The histories are stationary from the first instant on.

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
        Largest time between instants, s, shortened to fit; by default a tenth of the Kolmogorov time (ν/ε)^½. The
        equation is integrated with steps of 0.07 Kolmogorov times or less, whatever the instants.

    Notes
    -----
    Strain, on which all loads depend, has an integral correlation time of 4 Kolmogorov times, where direct simulations
    have 2.3, so that loads outlast those of turbulence. Rotation has 3, where they have 7, and the mean square of its
    rate is 0.84 of that of the strain rate, where they have 1.

    Raises
    ------
    ValueError
        If a number is not positive, the seed negative, or there would be more than 10⁸ instants in all.
    """
    request = Request.checked(count, duration, dissipation, kinematic_viscosity, seed, step)
    return tuple(request.history(_path(request.step, len(request.instants), random)) for random in request.random)


def _path(step: float, instants: int, random: np.random.Generator) -> FloatArray:
    """Gradients (T, 3, 3) in inverse Kolmogorov times, from a state that has forgotten where it started."""
    from rheoclast.turbulence._deformation_kernel import follow

    kolmogorov_time = 1 / np.sqrt(MEAN_SQUARE_MAGNITUDE)
    settling, path = np.empty((2, 3, 3)), np.empty((instants, 3, 3))
    follow(np.zeros((3, 3)), MEMORY, LONGEST_STEP, round(SETTLING_TIME / LONGEST_STEP), random, settling)
    interval = step * kolmogorov_time
    steps = int(np.ceil(interval / LONGEST_STEP))
    follow(settling[-1], MEMORY, interval / steps, steps, random, path)
    return path * kolmogorov_time
