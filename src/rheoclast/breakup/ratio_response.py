"""How near the contacts of an aggregate are to failure, in every linear flow at once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rheoclast._checks import FloatArray, IntArray
from rheoclast._threads import one_blas_thread
from rheoclast.breakup.contact_response import ContactResponse
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.criteria.criterion import AnyOf, Criterion
from rheoclast.mechanics.criteria.load_ratios import (
    largest_ratios,
    limited_parts,
    load_ratios,
    refuse_without_strength,
)
from rheoclast.mechanics.criteria.tension import Tension

ROUNDING = 1e-10  # of the largest load in any flow: loads that vanish by symmetry are no larger
RATIOS_AT_ONCE = 2**18  # contacts times flows: 2 MB of ratios, which stay in the cache; 60 MB of loads


@dataclass(frozen=True, eq=False)
class RatioResponse:
    """Load ratios of the contacts of a freely suspended aggregate, for any strain rates.

    Parameters
    ----------
    table
        Contact loads in every flow.
    bonds
        Strength of the contacts.
    criterion
        When a contact fails. Parts whose strengths are all infinite do not count.

    Raises
    ------
    ValueError
        If no contact has a strength, or the bonds have another number of contacts.
    """

    table: ContactResponse
    bonds: Bonds
    criterion: Criterion

    def __post_init__(self) -> None:
        refuse_without_strength(self.bonds, self.criterion)
        self.bonds.refuse_other_count(len(self.table.normals))

    @property
    def criteria(self) -> tuple[str, ...]:
        """Names of all the criterion's parts, those that do not count among them."""
        return self.criterion.part_names

    def is_rounding(
        self, ratio: FloatArray | float, contact: IntArray | int, components: FloatArray
    ) -> NDArray[np.bool_]:
        """Whether load ratios (n,) of contacts (n,) are rounding, or negative, in strain rates (n, 5)."""
        return np.less_equal(ratio, self._rounding[contact] * np.linalg.norm(components, axis=-1))

    @cached_property
    def _rounding(self) -> FloatArray:
        """Load ratio (C,) per strain rate, s, of loads far below the largest in any contact and flow."""
        count = len(self.table.normals)
        return ROUNDING * largest_ratios(self.table.force, self.table.moment, self.bonds, self.criterion, count)

    def largest(self, components: FloatArray) -> tuple[FloatArray, IntArray, IntArray]:
        """Largest load ratio (n,), its contact (n,) and its position in `criteria` (n,).

        Strain rates are given by their components (n, 5) on `STRAIN_BASIS`, in 1/s. The ratio is negative where tension
        alone counts and every contact is compressed.
        """
        ratio, contact, part = self._in_pieces(_largest, components)
        return ratio, contact, self._counting[part]

    def largest_two(self, components: FloatArray) -> tuple[FloatArray, IntArray, IntArray, FloatArray]:
        """The same as `largest`, and the largest ratio (n,) of any other contact, −∞ if there is none."""
        ratio, contact, part, other = self._in_pieces(_largest_two, components)
        return ratio, contact, self._counting[part], other

    def _in_pieces(
        self, find: Callable[[FloatArray], tuple[NDArray[Any], ...]], components: FloatArray
    ) -> tuple[NDArray[Any], ...]:
        """What is found in ratios (n, C, K) by the K parts that count, for as many flows at once as the cache holds."""
        size = max(1, RATIOS_AT_ONCE // len(self.table.normals))
        with one_blas_thread():  # more would spend their time on waiting for each other
            found = [
                find(self._ratios(components[start : start + size])) for start in range(0, len(components) or 1, size)
            ]
        return tuple(map(np.concatenate, zip(*found, strict=True)))

    def _ratios(self, components: FloatArray) -> FloatArray:
        if self._tension is not None:
            return (components @ self._tension)[..., None]
        return load_ratios(self.table.loads_of(components), self.bonds, criterion=self._part_that_counts)

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
        return load_ratios(self.table.loads_of(np.eye(5)), self.bonds, criterion=counting[0])[..., 0]


def _largest(ratios: FloatArray) -> tuple[FloatArray, IntArray, IntArray]:
    """Largest of ratios (n, C, K) in every flow, and where it is."""
    flows, contacts, parts = ratios.shape
    flat = ratios.reshape(flows, contacts * parts)
    place = flat.argmax(axis=1)
    contact, part = np.divmod(place, parts)
    return flat[np.arange(flows), place], contact, part


def _largest_two(ratios: FloatArray) -> tuple[FloatArray, IntArray, IntArray, FloatArray]:
    """`_largest`, and the largest that any other contact has."""
    ratio, contact, part = _largest(ratios)
    others = ratios.max(axis=2)
    others[np.arange(len(others)), contact] = -np.inf
    return ratio, contact, part, others.max(axis=1)
