"""From loads on a held aggregate to those on a free one. Dimensionless, with viscosity one.

`loads` are (N, 11, 11) as from `HydrodynamicModel`, `centers` (N, 3) relative to the reference point.
"""

from __future__ import annotations

import numpy as np

from rheoclast._checks import FloatArray
from rheoclast.vectors import elementary_velocities

SINGULAR = 1e-12


def total_resistance(centers: FloatArray, loads: FloatArray) -> FloatArray:
    """Total force, torque and stresslet about the reference point in the elementary flows, (11, 11)."""
    total = np.tensordot(elementary_velocities(centers), loads[:, :3], axes=((0, 2), (0, 1)))
    total[3:] += loads[:, 3:].sum(axis=0)
    return total


def total_load(centers: FloatArray, loads: FloatArray) -> FloatArray:
    """Total force and torque (6, K) about the reference point of force and torque (N, 6, K) on the spheres."""
    total = loads.sum(axis=0)
    total[3:] += np.cross(centers[:, :, None], loads[:, :3], axis=1).sum(axis=0)
    return total


def mobility(resistance: FloatArray) -> FloatArray:
    """Inverse (6, 6) of the resistance to rigid motion.

    A rotation without resistance is left out: it occurs at order 1, for spheres in line.
    """
    rigid = resistance[:6, :6]
    return np.asarray(np.linalg.pinv((rigid + rigid.T) / 2, rcond=SINGULAR, hermitian=True), dtype=np.float64)


def strain_motion(resistance: FloatArray) -> FloatArray:
    """Velocity and angular velocity of the free aggregate relative to the fluid, per strain component, (6, 5)."""
    return mobility(resistance) @ resistance[:6, 6:]


def free_loads(centers: FloatArray, loads: FloatArray) -> FloatArray:
    """Force and torque on every sphere of the free aggregate, per strain component, (N, 6, 5)."""
    resistance = total_resistance(centers, loads)
    rigid, motion = loads[:, :6, :6], mobility(resistance)
    free = loads[:, :6, 6:] - rigid @ (motion @ resistance[:6, 6:])
    # What is left is a difference of much larger loads: its rounding is moved away in the same manner.
    return free - rigid @ (motion @ total_load(centers, free))
