"""How near the contacts of an aggregate are to failure, at any time of its trajectory."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray, IntArray
from rheoclast._threads import one_blas_thread
from rheoclast.breakup.contact_response import ContactResponse
from rheoclast.hydrodynamics.trajectory import Trajectory
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.criteria.any_of import AnyOf
from rheoclast.mechanics.criteria.criterion import Criterion
from rheoclast.mechanics.criteria.load_ratios import limited_parts, load_ratios, refuse_without_strength
from rheoclast.mechanics.criteria.tension import Tension

INSTANTS_AT_ONCE = 2**14  # some 10 MB of matrices
RATIOS_AT_ONCE = 2**18  # contacts times instants: 2 MB of ratios, which stay in the cache; 60 MB of loads


@dataclass(frozen=True, eq=False)
class TrajectoryLoads:
    """Load ratios of an aggregate's contacts as functions of time.

    Parameters
    ----------
    trajectory, table
        Of the same aggregate: how it turns, and what its contacts then carry.
    bonds
        Strength of the contacts.
    criterion
        When a contact fails. Parts whose strengths are all infinite are left out.

    Raises
    ------
    TypeError
        If an argument is something else.
    ValueError
        If no contact has a strength, or the bonds have another number of contacts.
    """

    trajectory: Trajectory
    table: ContactResponse
    bonds: Bonds
    criterion: Criterion

    def __post_init__(self) -> None:
        _checks.instance("trajectory", self.trajectory, Trajectory, "make one with trajectory(response, flow)")
        _checks.instance("table", self.table, ContactResponse, "make one with contact_response(aggregate, response)")
        _checks.instance("bonds", self.bonds, Bonds, "for instance jkr_bonds(aggregate, material)")
        _checks.instance("criterion", self.criterion, Criterion, "for instance Tension()")
        refuse_without_strength(self.bonds, self.criterion)
        self.bonds.strength(len(self.table.normals))

    @property
    def criteria(self) -> tuple[str, ...]:
        """Names of all the criterion's parts."""
        return tuple(part.name for part in self.criterion.parts)

    def largest(self, times: FloatArray) -> tuple[FloatArray, IntArray, IntArray]:
        """Largest load ratio (T,), its contact (T,) and its position in `criteria` (T,), at times (T,).

        It is negative where tension alone counts and every contact is compressed.
        """
        ratio, contact, part = np.empty(len(times)), np.empty(len(times), np.intp), np.empty(len(times), np.intp)
        step = max(1, RATIOS_AT_ONCE // len(self.table.normals))
        with one_blas_thread():  # more would spend their time on waiting for each other
            for first in range(0, len(times), INSTANTS_AT_ONCE):
                components = self.trajectory.strain_components(times[first : first + INSTANTS_AT_ONCE])
                for start in range(0, len(components), step):
                    here = slice(first + start, first + min(start + step, len(components)))
                    ratio[here], contact[here], part[here] = _largest(self._ratios(components[start : start + step]))
        return ratio, contact, self._counting[part]

    def largest_at(self, time: float) -> float:
        """Largest load ratio at one time."""
        return float(self._ratios(self.trajectory.strain_components(np.array([time]))).max())

    def _ratios(self, components: FloatArray) -> FloatArray:
        """Load ratios (T, C, K) by the K parts that count, for strain rates with components (T, 5)."""
        if self._tension is not None:
            return (components @ self._tension)[..., None]
        return load_ratios(self.table.loads_of(components), self.bonds, self._part_that_counts)

    @cached_property
    def _counting(self) -> IntArray:
        """Positions of the parts that have a finite strength."""
        return limited_parts(self.bonds, self.criterion)

    @cached_property
    def _part_that_counts(self) -> Criterion:
        return AnyOf(*(self.criterion.parts[k] for k in self._counting))

    @cached_property
    def _tension(self) -> FloatArray | None:
        """Load ratio (5, C) per component of the strain rate if tension alone counts, as it is linear in the loads."""
        counting = self._part_that_counts.parts
        if len(counting) != 1 or not isinstance(counting[0], Tension):
            return None
        return load_ratios(self.table.loads_of(np.eye(5)), self.bonds, counting[0])[..., 0]


def _largest(ratios: FloatArray) -> tuple[FloatArray, IntArray, IntArray]:
    """Largest of ratios (T, C, K) at every time, and where it is."""
    flat = ratios.reshape(len(ratios), -1)
    place = flat.argmax(axis=1)
    contact, part = np.divmod(place, ratios.shape[2])
    return flat[np.arange(len(flat)), place], contact, part
