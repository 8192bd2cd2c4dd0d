"""When a contact fails: each load against its strength."""

from __future__ import annotations

import numpy as np

from rheoclast._checks import FloatArray
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.contact_loads import ContactLoads

CRITERIA = ("tension", "shear", "bending", "twisting")


def load_ratios(loads: ContactLoads, bonds: Bonds) -> FloatArray:
    """Load over strength (..., C, 4) for the four `CRITERIA`. A contact fails where a ratio reaches one.

    Compression does not fail a contact: its ratio in tension is negative. Where a strength is infinite the ratio is
    zero, so a criterion without a limit is off.
    """
    carried = np.stack([loads.tension, loads.shear, loads.bending, np.abs(loads.twisting)], axis=-1)
    return carried / bonds.strength(carried.shape[-2])
