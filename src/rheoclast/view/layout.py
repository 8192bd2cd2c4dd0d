"""Where the parts of a picture stand, in inches and in shares of the figure."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.view.rendering import Image

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LARGEST_RADIUS = 0.8  # inches
MARGIN, FOOTER, HEADER = 0.18, 0.95, 0.34  # inches
FOOTER_SQUARE = 0.7  # inches
SLIVER = 1e-6  # pixels more for a figure and less for an image in its box, lest rounding cost or add one and blur it
Box = tuple[float, float, float, float]


@dataclass(frozen=True)
class Layout:
    """Inches of the figure and of its parts, whole pixels each, and the scale of the picture amid them."""

    width: float
    header: float
    picture: float
    footer: float
    inches_per_metre: float
    dots_per_inch: float

    @classmethod
    def rounded(
        cls, width: float, header: float, picture: float, footer: float, inches_per_metre: float, dots_per_inch: float
    ) -> Layout:
        """Layout of nearly these inches."""
        lengths = np.array([width, header, picture, footer])
        width, header, picture, footer = (np.round(lengths * dots_per_inch) / dots_per_inch).tolist()
        return cls(width, header, picture, footer, inches_per_metre, dots_per_inch)

    def even(self) -> Layout:
        """The same, a pixel narrower or lower where the figure's width or height in pixels is odd."""
        dot = 1 / self.dots_per_inch
        across, along = (round(length * self.dots_per_inch) for length in (self.width, self.height))
        return replace(self, width=self.width - across % 2 * dot, picture=self.picture - along % 2 * dot)

    @property
    def height(self) -> float:
        """Height of the figure."""
        return self.header + self.picture + self.footer

    @property
    def figure_size(self) -> tuple[float, float]:
        """Width and height of the figure."""
        return self.width + SLIVER / self.dots_per_inch, self.height + SLIVER / self.dots_per_inch

    @property
    def scale(self) -> float:
        """Pixels per metre."""
        return self.inches_per_metre * self.dots_per_inch

    @property
    def pixels(self) -> tuple[int, int]:
        """Width and height of the picture."""
        return round(self.width * self.dots_per_inch), round(self.picture * self.dots_per_inch)

    @property
    def picture_box(self) -> Box:
        """Place of the picture, as shares of the figure."""
        return 0.0, self.footer / self.height, 1.0, self.picture / self.height

    def footer_box(self, left: float, width: float, bottom: float, height: float) -> Box:
        """Box as shares of the figure, from shares of its width and inches above its lower edge."""
        return left, bottom / self.height, width, height / self.height

    def pixel_box(self, left: int, bottom: int, width: int, height: int) -> Box:
        """Box as shares of the figure, from pixels."""
        across, along = (round(length * self.dots_per_inch) for length in (self.width, self.height))
        return left / across, bottom / along, width / across, height / along

    @property
    def scale_bar_box(self) -> Box:
        """At the left end of the footer."""
        return self.footer_box(0.03, 0.22, 0.3, 0.4)

    @property
    def colour_bar_box(self) -> Box:
        """Between the scale bar and the two footer squares."""
        left = 0.31
        width = min(0.39, 1 - left - (MARGIN + 2 * FOOTER_SQUARE + 0.3) / self.width)
        return self.footer_box(left, width, 0.38, 0.13)

    def footer_square(self, column: int) -> Box:
        """Square place in the footer, counted from the right."""
        left = 1 - (MARGIN + (column + 1) * FOOTER_SQUARE + 0.1 * column) / self.width
        return self.footer_box(left, FOOTER_SQUARE / self.width, 0.12, FOOTER_SQUARE)


def refuse_small(size: tuple[float, float], smallest: tuple[float, float]) -> None:
    """Refuse a figure in which the parts would not find room.

    Raises
    ------
    ValueError
        If `size` is not two positive lengths of at least those of `smallest`, in inches.
    """
    width, height = _checks.positive_array("size", size, (2,))
    if width < smallest[0] or height < smallest[1]:
        shown = " by ".join(f"{length:g}" for length in smallest)
        raise ValueError(f"size: expected at least {shown} inches, got {width:g} by {height:g}")


def extent(centers: FloatArray, radii: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Lower left and upper right corner (2,) of spheres (N, 3) seen along z."""
    flat, reach = centers[:, :2], radii[:, None]
    return (flat - reach).min(axis=0), (flat + reach).max(axis=0)


def image_axes(figure: Figure, box: Box, image: Image) -> Axes:
    """Axes in pixels, as large as the image (H, W, 4), that show it one to one."""
    height, width = image.shape[:2]
    axes = figure.add_axes(box)
    inside = (SLIVER, width - SLIVER, SLIVER, height - SLIVER)
    axes.imshow(image, origin="lower", extent=inside, aspect="auto", interpolation="antialiased")
    axes.set(xlim=(0, width), ylim=(0, height))
    axes.set_axis_off()
    return axes
