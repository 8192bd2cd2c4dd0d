"""Random numbers from the seed that a caller asks for."""

from __future__ import annotations

from typing import Any

import numpy as np

from rheoclast import _checks


def seeded(seed: Any) -> np.random.Generator:
    """Random numbers that are the same for equal seeds."""
    return np.random.default_rng(_checks.whole_number("seed", seed, 0))
