"""What a file of velocity-gradient histories holds, before units and order are applied."""

from __future__ import annotations

import re
from typing import NamedTuple

from rheoclast._checks import FloatArray

SECONDS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "min": 60.0, "h": 3600.0, "dimensionless": 1.0}
PER_SECOND = {name if name == "dimensionless" else f"1/{name}": 1 / value for name, value in SECONDS.items()}


class Samples(NamedTuple):
    """One path in the units of its file; `transposable` where the file does not say which derivative is which."""

    label: str
    times: FloatArray
    entries: FloatArray
    time_unit: str | None = None
    gradient_unit: str | None = None
    transposable: bool = True


def inverse_time_unit(text: str) -> str:
    """A unit of the gradient as `PER_SECOND` has it, where it stands as a power: s^-1, s-1 or s⁻¹ for 1/s."""
    return re.sub(r"^(\w+?)(?:(?:\^|\*\*)?-1|⁻¹)$", r"1/\1", text)
