"""Bonds: the stiffness and the strength of every contact."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray


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

    def _table(self, contacts: int, *names: str) -> FloatArray:
        columns = []
        for name in names:
            value = getattr(self, name)
            if value.ndim and len(value) != contacts:
                raise ValueError(f"bonds.{name}: expected one value or one per contact ({contacts}), got {len(value)}")
            columns.append(np.broadcast_to(value, contacts))
        return np.stack(columns, axis=1)
