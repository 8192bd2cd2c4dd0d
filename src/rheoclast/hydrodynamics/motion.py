"""Rigid-body motion of an aggregate."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.loads import SphereLoads


@dataclass(frozen=True, eq=False)
class RigidMotion:
    """Motion of a rigid aggregate.

    Attributes
    ----------
    velocity
        (3,) of the point `center`, in m/s.
    angular_velocity
        (3,) in rad/s.
    center
        (3,) in m, the centre of mass.
    """

    velocity: FloatArray
    angular_velocity: FloatArray
    center: FloatArray

    def __post_init__(self) -> None:
        names = ("velocity", "angular_velocity", "center")
        _checks.set_fields(self, **{name: _checks.real_array(name, getattr(self, name), (3,)) for name in names})

    def at(self, points: ArrayLike) -> FloatArray:
        """Velocity (..., 3) in m/s of points (..., 3) of the aggregate, in m."""
        return self.velocity + np.cross(self.angular_velocity, np.asarray(points) - self.center)


@dataclass(frozen=True, eq=False)
class Settling(RigidMotion):
    """Motion of an aggregate on which a force acts at its centre of mass, in fluid at rest.

    Attributes
    ----------
    loads
        Force and torque of the fluid on every sphere.
    net_loads
        The same plus each sphere's share of the force, by volume: these balance, as contact loads require.
    """

    loads: SphereLoads
    net_loads: SphereLoads
