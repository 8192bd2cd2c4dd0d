"""What a caller may ask of a generator: whole numbers within bounds."""

from __future__ import annotations

from typing import Any

import numpy as np


def whole_number(name: str, value: Any, least: int) -> int:
    """An integer of at least `least`."""
    if isinstance(value, bool | np.bool_) or not isinstance(value, int | np.integer) or value < least:
        raise ValueError(f"{name}: expected an integer of at least {least}, got {value!r}")
    return int(value)


def seeded(seed: Any) -> np.random.Generator:
    """Random numbers that are the same for equal seeds."""
    return np.random.default_rng(whole_number("seed", seed, 0))
