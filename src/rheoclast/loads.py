"""The one value that crosses from fluid to structure."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rheoclast._checks import FloatArray, not_negative, real_array, set_fields


@dataclass(frozen=True, eq=False)
class SphereLoads:
    """Force and torque on every sphere.

    Attributes
    ----------
    force
        (N, 3), or (..., N, 3) for a batch of load cases, in N.
    torque
        Same shape, in N m, about the centre of each sphere.
    rounding
        Size of the rounding errors in `force`, in N: totals of this size count as zero. Loads that vanish by symmetry
        are nothing else.
    """

    force: FloatArray
    torque: FloatArray
    rounding: float = 0.0

    def __post_init__(self) -> None:
        force = real_array("force", self.force, (*np.shape(self.force)[:-2], "N", 3))
        torque, rounding = real_array("torque", self.torque, force.shape), not_negative("rounding", self.rounding)
        set_fields(self, force=force, torque=torque, rounding=rounding)

    @classmethod
    def stacked(cls, each: Sequence[SphereLoads]) -> SphereLoads:
        """Several loads (..., N, 3) of the same spheres as one batch (n, ..., N, 3), with the largest rounding."""
        force, torque = (np.stack([getattr(loads, name) for loads in each]) for name in ("force", "torque"))
        return cls(force, torque, max(loads.rounding for loads in each))
