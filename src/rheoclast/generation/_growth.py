"""What every growth begins and ends with: a checked request in, an aggregate out. Inside, lengths are in radii."""

from __future__ import annotations

from typing import Any

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray, seeded
from rheoclast.particles.aggregate import Aggregate
from rheoclast.particles.spheres import Spheres

WIDEST_SPREAD = 1.0
TOUCHING = 1e-9
"""Gap in mean radii of a pair, far above rounding and far below any that comes by chance."""


def begin(count: Any, radius: Any, spread: Any, seed: Any, *, least: int = 1) -> tuple[FloatArray, np.random.Generator]:
    """Log-normal radii (count,) over their median, in random order, and the generator for all further draws.

    Raises
    ------
    ValueError
        If `count` is not an integer of at least `least`, `radius` not positive, `spread`, the standard deviation of
        ln radius, not within 0 and 1, or `seed` not an integer of at least 0.
    """
    count, rng = _checks.whole_number("count", count, least), seeded(seed)
    _checks.positive("radius", radius)
    spread = _checks.not_negative("spread", spread)
    if spread > WIDEST_SPREAD:
        raise ValueError(f"spread: expected a standard deviation of ln radius from 0 to 1, got {spread:g}")
    return np.exp(spread * rng.standard_normal(count)), rng


def finished(centers: FloatArray, radii: FloatArray, radius: float) -> Aggregate:
    """Aggregate with its centre of mass at the origin from spheres in units of `radius`, which is in m."""
    centered = centers - np.average(centers, axis=0, weights=radii**3)
    return Aggregate.touching(Spheres(radius * centered, radius * radii), TOUCHING)
