"""The colour scale of contact values."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

from rheoclast._checks import FloatArray
from rheoclast.view.quantities import symmetric_limit

if TYPE_CHECKING:
    from matplotlib.colors import Colormap, Normalize

COMPRESSED, UNLOADED, PULLED = ("#08399c", "#1f74e0", "#74b0f2"), "#e3e3e3", ("#fa9a70", "#ee5220", "#b80f0a")


class ColourScale:
    """Blue through light grey to red from −limit to limit; told apart with every kind of colour vision.

    Attributes
    ----------
    limit
        End of the scale, in the unit of the values.
    map, norm
        Matplotlib's map of colours and of values.
    extend
        At which ends values lie beyond the limit, as Matplotlib names it.
    """

    limit: float
    map: Colormap
    norm: Normalize
    extend: Literal["neither", "both", "min", "max"]

    def __init__(self, values: FloatArray) -> None:
        from matplotlib.colors import LinearSegmentedColormap, Normalize

        self.limit = symmetric_limit(values)
        self.map = LinearSegmentedColormap.from_list("load", [*COMPRESSED, UNLOADED, *PULLED])
        self.norm = Normalize(-self.limit, self.limit, clip=True)
        below, above = bool((values < -self.limit).any()), bool((values > self.limit).any())
        self.extend = "both" if below and above else "min" if below else "max" if above else "neither"

    def __call__(self, values: FloatArray) -> FloatArray:
        """Red, green, blue (C, 3) of values (C,)."""
        return np.asarray(self.map(self.norm(values)), dtype=np.float64)[:, :3]
