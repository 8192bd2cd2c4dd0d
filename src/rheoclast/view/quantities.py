"""Numbers as an engineer writes them: decimal prefixes and round limits."""

from __future__ import annotations

import math

import numpy as np

from rheoclast._checks import FloatArray

PREFIXES = {-18: "a", -15: "f", -12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T"}
ROUND_STEPS = (1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10)


def prefixed(size: float, unit: str | None) -> tuple[float, str]:
    """Divisor and unit with the decimal prefix that brings `size` (in `unit`) to between 1 and 1000.

    Without a unit, or with one that takes no prefix ("1/s"), the divisor is 1.
    """
    if not unit or not unit[0].isalpha() or size <= 0 or not math.isfinite(size):
        return 1.0, unit or ""
    exponent = 3 * math.floor(math.log10(size * (1 + 1e-9)) / 3)
    exponent = min(max(exponent, min(PREFIXES)), max(PREFIXES))
    return 10.0**exponent, PREFIXES[exponent] + unit


def quoted(value: float, unit: str | None) -> str:
    """A value with three digits and its unit, such as "12.3 nN"."""
    rounded = float(f"{value:.3g}")
    divisor, text = prefixed(abs(rounded), unit)
    return minus(f"{rounded / divisor:g} {text}".rstrip())


def minus(text: str) -> str:
    """The text with true minus signs."""
    return text.replace("-", "−")


def round_up(value: float) -> float:
    """The smallest of `ROUND_STEPS` times a power of ten that is not below a positive value."""
    power = 10.0 ** math.floor(math.log10(value))
    return next(step * power for step in ROUND_STEPS if step * power >= value * (1 - 1e-9))


def round_down(value: float) -> float:
    """The largest of 1, 2, 5 times a power of ten that is not above a positive value."""
    power = 10.0 ** math.floor(math.log10(value))
    return max(step * power for step in (1, 2, 5) if step * power <= value * (1 + 1e-9) or step == 1)


def symmetric_limit(values: FloatArray) -> float:
    """Round limit L of a colour scale from −L to L: the largest magnitude unless a few outliers dwarf the rest."""
    magnitude = np.abs(values)
    if not magnitude.any():
        return 1.0
    usual, largest = float(np.percentile(magnitude, 95)), float(magnitude.max())
    return round_up(largest if largest <= 1.5 * usual or usual == 0 else usual)
