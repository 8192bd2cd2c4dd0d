"""Numbers as short as the page shows them, for JSON."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

DIGITS = 5
ROUNDING = 1e-12  # of what is about 1


def shortened(values: NDArray[np.number], divisor: float = 1.0) -> list[float | None]:
    """Values over a divisor with few digits; what is not finite, as the rate at which nothing fails, is None."""
    scaled = np.asarray(values, dtype=np.float64) / divisor
    scaled = np.where(np.abs(scaled) < ROUNDING, 0.0, scaled)
    return [float(f"{value:.{DIGITS}g}") if np.isfinite(value) else None for value in scaled]
