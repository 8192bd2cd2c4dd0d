"""Units of length that a file may be in."""

from __future__ import annotations

from rheoclast import _checks

DIMENSIONLESS = "dimensionless"
METRES = {
    "m": 1.0,
    "cm": 1e-2,
    "mm": 1e-3,
    "um": 1e-6,
    "\u00b5m": 1e-6,  # micro sign
    "\u03bcm": 1e-6,  # Greek mu, which looks the same
    "nm": 1e-9,
    "angstrom": 1e-10,
    "\u00c5": 1e-10,  # Å
    DIMENSIONLESS: 1.0,
}


def metres(unit: str | float) -> float:
    """One unit of length in metres, from its name or from its value; one for dimensionless lengths.

    Raises
    ------
    ValueError
        If the name is not known or the value not positive.
    """
    if not isinstance(unit, str):
        return _checks.positive("unit", unit)
    if unit not in METRES:
        known = ", ".join(dict.fromkeys(map(ascii_name, METRES)))
        raise ValueError(f"unit: expected one of {known}, or the unit in metres as a positive number, got {unit!r:.60}")
    return METRES[unit]


def ascii_name(unit: str | float) -> str:
    """The unit as column names spell it: `um` for either mu, `angstrom` for Å, a number of metres in words."""
    if not isinstance(unit, str):
        return f"{float(unit)!r} m"
    return unit.replace("\u00b5", "u").replace("\u03bc", "u").replace("\u00c5", "angstrom")


def column_name(quantity: str, unit: str | float) -> str:
    """Name of a column of lengths, `x_nm`; without unit where the unit has no name."""
    named = isinstance(unit, str) and unit != DIMENSIONLESS
    return f"{quantity}_{ascii_name(unit)}" if named else quantity
