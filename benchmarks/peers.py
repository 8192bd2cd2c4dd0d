"""Other codes on the same spheres: six rigid motions of N equal touching spheres, where they install."""

from __future__ import annotations

from importlib.util import find_spec

import numpy as np
from scipy.linalg import cho_factor, cho_solve
from scipy.sparse.linalg import LinearOperator, cg


def pygrpy(centers: np.ndarray) -> None:
    """Rotne–Prager–Yamakawa force and torque mobility by pygrpy (no stresslet), dense Cholesky."""
    from pygrpy.grpy_tensors import mu, rigidProjectionMatrix

    radii = np.ones(len(centers))
    cho_solve(cho_factor(mu(centers, radii)), rigidProjectionMatrix(centers))


def pystokes(centers: np.ndarray) -> None:
    """Force and torque mobility by PyStokes (no stresslet), conjugate gradients to 1e-6 on each motion in turn."""
    from pystokes.unbounded import Rbm

    count = len(centers)
    spheres, place = Rbm(1.0, count, 1.0), centers.T.ravel().copy()

    def apply(loads: np.ndarray) -> np.ndarray:
        force, torque = np.split(np.ascontiguousarray(loads).ravel(), 2)
        velocity, spin = np.zeros(3 * count), np.zeros(3 * count)
        spheres.mobilityTT(velocity, place, force)
        spheres.mobilityTR(velocity, place, torque)
        spheres.mobilityRT(spin, place, force)
        spheres.mobilityRR(spin, place, torque)
        return np.concatenate([velocity, spin])

    mobility = LinearOperator((6 * count, 6 * count), matvec=apply, dtype=float)
    for axis in np.eye(3):
        stream = np.concatenate([np.repeat(axis, count), np.zeros(3 * count)])
        turning = np.concatenate([np.cross(axis, centers).T.ravel(), np.repeat(axis, count)])
        for motion in (stream, turning):
            _, failed = cg(mobility, motion, rtol=1e-6)
            assert not failed


PEERS = {name: peer for name, peer in {"pygrpy": pygrpy, "pystokes": pystokes}.items() if find_spec(name)}
"""Those that are installed."""
