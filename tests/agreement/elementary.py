"""The eleven elementary problems of a rigid aggregate, from any symmetric operator that turns loads into motion.

Written from the definitions and apart from the package. A motion of a sphere is (velocity, angular velocity, five
strain components), its load (force, torque, five stresslet components); viscosity 1.
"""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from rheoclast.vectors import STRAIN_BASIS


@dataclass(frozen=True)
class Elementary:
    """What a rigid aggregate does and bears in the eleven unit ambient flows about its centre of mass."""

    center: np.ndarray
    ambient: np.ndarray
    """(N, 11, 11): motion of the fluid at every sphere (middle) in every unit ambient flow (last)."""
    held: np.ndarray
    """(N, 11, 11): load of the fluid on every sphere (middle) held fixed in every unit ambient flow (last)."""

    @property
    def grand_resistance(self):
        """(11, 11): loads of the fluid on the whole aggregate, about its centre, held in the unit ambient flows."""
        return np.einsum("nlk,nlm->km", self.ambient, self.held)

    @property
    def slip(self):
        """(6, 5): velocity and angular velocity of the free aggregate relative to the fluid at its centre.

        The least solution where a rotation meets no resistance: about the line of a straight chain at order 1.
        """
        grand = self.grand_resistance
        return np.linalg.lstsq(grand[:6, :6], grand[:6, 6:], rcond=1e-12)[0]

    @property
    def table(self):
        """(N, 6, 5): force and torque on every sphere of the free aggregate in the unit strains."""
        return (self.held[:, :, 6:] - self.held[:, :, :6] @ self.slip)[:, :6]

    @property
    def free_stresslet(self):
        """(5, 5): stresslet of the free aggregate in the unit strains; needs no centre, for no force is left."""
        grand = self.grand_resistance
        return grand[6:, 6:] - grand[6:, :6] @ self.slip

    @property
    def couplings(self):
        """(2, 3, 3, 3): velocity and angular velocity of the free aggregate relative to the fluid, per E_jk."""
        return np.einsum("vik,kjl->vijl", self.slip.reshape(2, 3, 5), STRAIN_BASIS)

    @property
    def hydrodynamic_radius(self):
        """1/(6π mean translational mobility) at the centre of mobility: the point where that mean is least.

        The mean translational mobility at a point is a quadratic function of the point, so differences of unit step
        give its gradient and curvature exactly; it is least where the coupling to rotation is symmetric.
        """
        mobility = np.linalg.inv(self.grand_resistance[:6, :6])

        def mean_mobility(offset):
            lever = np.cross(np.eye(3), offset).T  # lever @ angular velocity: what the offset point gains
            to_point = np.hstack([np.eye(3), -lever.T])
            return np.trace(to_point @ mobility @ to_point.T) / 3

        unit = np.eye(3)
        zero = mean_mobility(np.zeros(3))
        plus, minus = (np.array([mean_mobility(sign * e) for e in unit]) for sign in (1, -1))
        curvature = np.array(
            [[mean_mobility(e + f) - mean_mobility(e) - mean_mobility(f) + zero for e in unit] for f in unit]
        )
        offset = -np.linalg.solve(curvature, (plus - minus) / 2)
        return 1 / (6 * np.pi * mean_mobility(offset))

    def intrinsic_viscosity(self, radii):
        """Mean of the free stresslet over orientations, over 2 μ E and the volume of the spheres."""
        return np.trace(self.free_stresslet) / 5 / (2 * 4 / 3 * np.pi * np.sum(radii**3))


def eleven_problems(operator, probes, centers, radii):
    """Solve all eleven by one Cholesky factorization.

    Parameters
    ----------
    operator
        (N, M, N, M) symmetric positive definite: projected velocity of the fluid from the modes of the traction.
    probes
        (N, M, 11): projected velocity of each unit motion of a sphere, whose transpose takes moments of the traction.
    """
    count, modes = operator.shape[:2]
    center = np.average(centers, axis=0, weights=radii**3)
    ambient = np.array([motion_at(place - center) for place in centers])
    velocity = (probes @ ambient).reshape(count * modes, 11)
    traction = cho_solve(cho_factor(operator.reshape(count * modes, count * modes)), velocity)
    held = np.swapaxes(probes, 1, 2) @ traction.reshape(count, modes, 11)
    return Elementary(center, ambient, held)


def motion_at(offset):
    """(11, 11): motion, at `offset` from the centre, of the fluid in every unit ambient flow about the centre."""
    motion = np.eye(11)
    motion[:3, 3:6] = np.cross(np.eye(3), offset).T
    motion[:3, 6:] = (STRAIN_BASIS @ offset).T
    return motion
