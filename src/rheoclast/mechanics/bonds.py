"""Bonds: the stiffness and the strength of every contact."""

from __future__ import annotations

from dataclasses import dataclass, fields
from math import gamma

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray, IntArray

SMALLEST_FACTOR = 1e-12
LEAST_MODULUS = 0.1


@dataclass(frozen=True, eq=False)
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
    tensile_strength: FloatArray = np.inf  # type: ignore[assignment]
    shear_strength: FloatArray = np.inf  # type: ignore[assignment]
    bending_strength: FloatArray = np.inf  # type: ignore[assignment]
    twisting_strength: FloatArray = np.inf  # type: ignore[assignment]

    def __post_init__(self) -> None:
        lengths = {}
        for field in fields(self):
            given = getattr(self, field.name)
            if np.ndim(given) > 1:
                raise ValueError(f"{field.name}: expected one value or one per contact, got shape {np.shape(given)}")
            unlimited = field.name.endswith("strength")
            value = _checks.positive_array(field.name, given, np.shape(given), infinite_allowed=unlimited)
            object.__setattr__(self, field.name, value)
            if value.ndim:
                lengths[field.name] = len(value)
        if len(set(lengths.values())) > 1:
            raise ValueError(f"bonds: expected the same number of contacts everywhere, got {lengths}")

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
        drawn = np.random.default_rng(seed).weibull(modulus, contacts)
        factor = np.maximum(drawn / gamma(1 + 1 / modulus), SMALLEST_FACTOR)
        return Bonds(*self.stiffness(contacts).T, *(factor[:, None] * self.strength(contacts)).T)

    def _table(self, contacts: int, *names: str) -> FloatArray:
        columns = []
        for name in names:
            value = getattr(self, name)
            if value.ndim and len(value) != contacts:
                raise ValueError(f"bonds.{name}: expected one value or one per contact ({contacts}), got {len(value)}")
            columns.append(np.broadcast_to(value, contacts))
        return np.stack(columns, axis=1)
