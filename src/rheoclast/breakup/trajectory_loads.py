"""How near the contacts of an aggregate are to failure, at any time of its trajectory."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rheoclast._checks import FloatArray, IntArray
from rheoclast.breakup.ratio_response import RatioResponse
from rheoclast.hydrodynamics.trajectory import Trajectory

INSTANTS_AT_ONCE = 2**14  # some 10 MB of matrices


@dataclass(frozen=True, eq=False)
class TrajectoryLoads:
    """Load ratios of an aggregate's contacts as functions of time.

    Parameters
    ----------
    trajectory, ratios
        Of the same aggregate: how it turns, and how near its contacts then are to failure.
    """

    trajectory: Trajectory
    ratios: RatioResponse

    @property
    def criteria(self) -> tuple[str, ...]:
        """Names of all the criterion's parts."""
        return self.ratios.criteria

    def largest(self, times: FloatArray) -> tuple[FloatArray, IntArray, IntArray]:
        """Largest load ratio (T,), its contact (T,) and its position in `criteria` (T,), at times (T,) in s.

        It is negative where tension alone counts and every contact is compressed.
        """
        ratio, contact, part = np.empty(len(times)), np.empty(len(times), np.intp), np.empty(len(times), np.intp)
        for first in range(0, len(times), INSTANTS_AT_ONCE):
            here = slice(first, first + INSTANTS_AT_ONCE)
            components = self.trajectory.strain_components(times[here])
            ratio[here], contact[here], part[here] = self.ratios.largest(components)
        return ratio, contact, part

    def largest_at(self, time: float) -> float:
        """Largest load ratio at one time."""
        return float(self.largest(np.array([time]))[0][0])
