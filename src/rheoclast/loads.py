"""The one value that crosses from fluid to structure."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rheoclast._checks import FloatArray, real_array


@dataclass(frozen=True, eq=False)
class SphereLoads:
    """Force and torque on every sphere.

    Attributes
    ----------
    force
        (N, 3), or (..., N, 3) for a batch of load cases, in N.
    torque
        Same shape, in N m, about the centre of each sphere.
    """

    force: FloatArray
    torque: FloatArray

    def __post_init__(self) -> None:
        force = real_array("force", self.force, (*np.shape(self.force)[:-2], "N", 3))
        object.__setattr__(self, "force", force)
        object.__setattr__(self, "torque", real_array("torque", self.torque, force.shape))
