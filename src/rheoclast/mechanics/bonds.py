"""Bonds: the stiffness and the strength of every contact."""

from __future__ import annotations

from dataclasses import dataclass, fields
from math import gamma

import numpy as np
from numpy.typing import ArrayLike

from rheoclast import _checks
from rheoclast._checks import FloatArray, IntArray

SMALLEST_FACTOR = 1e-12
LEAST_MODULUS = 0.1


@dataclass(frozen=True, eq=False, init=False)
class Bonds:
    """Stiffness and strength of the contacts, one value for all or one per contact.

    Parameters
    ----------
    normal, tangential
        Stiffness against relative displacement along and across the contact normal, N/m.
    bending, twisting
        Stiffness against relative rotation across and about the contact normal, N m/rad.
    tensile_strength
        Tension that breaks the contact (pull-off force), N. Infinite by default: a criterion without a limit is off.
    shear_strength
        Tangential force that breaks it, N.
    bending_strength, twisting_strength
        Moments that break it, N m.

    Raises
    ------
    ValueError
        If a value is not positive, a stiffness is not finite, or the lengths differ.
    """

    normal: FloatArray
    tangential: FloatArray
    bending: FloatArray
    twisting: FloatArray
    tensile_strength: FloatArray
    shear_strength: FloatArray
    bending_strength: FloatArray
    twisting_strength: FloatArray

    def __init__(
        self,
        normal: ArrayLike,
        tangential: ArrayLike,
        bending: ArrayLike,
        twisting: ArrayLike,
        tensile_strength: ArrayLike = np.inf,
        shear_strength: ArrayLike = np.inf,
        bending_strength: ArrayLike = np.inf,
        twisting_strength: ArrayLike = np.inf,
    ) -> None:
        given = [normal, tangential, bending, twisting]
        given += [tensile_strength, shear_strength, bending_strength, twisting_strength]
        values = {
            field.name: _one_or_one_per_contact(field.name, value, infinite_allowed=field.name.endswith("strength"))
            for field, value in zip(fields(self), given, strict=True)
        }
        lengths = {name: len(value) for name, value in values.items() if value.ndim}
        if len(set(lengths.values())) > 1:
            raise ValueError(f"bonds: expected the same number of contacts everywhere, got {lengths}")
        _checks.set_fields(self, **values)

    def stiffness(self, contacts: int) -> FloatArray:
        """Normal, tangential, bending and twisting stiffness of `contacts` contacts, (C, 4)."""
        return self._table(contacts, "normal", "tangential", "bending", "twisting")

    def strength(self, contacts: int) -> FloatArray:
        """Tensile, shear, bending and twisting strength of `contacts` contacts, (C, 4)."""
        return self._table(contacts, "tensile_strength", "shear_strength", "bending_strength", "twisting_strength")

    def chosen(self, contacts: IntArray) -> Bonds:
        """The bonds of some contacts, by their indices or a mask."""
        values = (getattr(self, field.name) for field in fields(self))
        return Bonds(*(value[contacts] if value.ndim else value for value in values))

    def scattered(self, contacts: int, modulus: float, seed: int) -> Bonds:
        """The same bonds with strengths that scatter from contact to contact, for `contacts` of them.

        All strengths of a contact are multiplied by one number from a Weibull distribution of mean 1 and the given
        modulus (shape): 1 is an exponential distribution, 10 a scatter of 12 %. Equal seeds give equal numbers.
        """
        modulus = _checks.positive("modulus", modulus)
        if modulus < LEAST_MODULUS:
            raise ValueError(f"modulus: expected at least {LEAST_MODULUS:g}, got {modulus:g}; 1 is a wide scatter")
        drawn = _checks.seeded(seed).weibull(modulus, _checks.whole_number("contacts", contacts, 0))
        factor = np.maximum(drawn / gamma(1 + 1 / modulus), SMALLEST_FACTOR)
        return Bonds(*self.stiffness(contacts).T, *(factor[:, None] * self.strength(contacts)).T)

    def refuse_other_count(self, contacts: int) -> None:
        """Refuse bonds that are given one by one for another number of contacts."""
        for field in fields(self):
            value = getattr(self, field.name)
            if value.ndim and len(value) != contacts:
                raise ValueError(
                    f"bonds.{field.name}: expected one value or one per contact ({contacts}), got {len(value)}"
                )

    def _table(self, contacts: int, *names: str) -> FloatArray:
        self.refuse_other_count(contacts)
        return np.stack([np.broadcast_to(getattr(self, name), contacts) for name in names], axis=1)


def _one_or_one_per_contact(name: str, value: ArrayLike, infinite_allowed: bool) -> FloatArray:
    if np.ndim(value) > 1:
        raise ValueError(f"{name}: expected one value or one per contact, got shape {np.shape(value)}")
    return _checks.positive_array(name, value, np.shape(value), infinite_allowed=infinite_allowed)
