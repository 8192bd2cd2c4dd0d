"""The everyday picture: an aggregate with its contacts coloured by what they carry."""

from __future__ import annotations

from dataclasses import dataclass
from os import PathLike
from typing import IO, TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.flows import LinearFlow
from rheoclast.particles.aggregate import Aggregate
from rheoclast.view import labels
from rheoclast.view.colours import ColourScale
from rheoclast.view.projection import view_axes
from rheoclast.view.quantities import quoted
from rheoclast.view.rendering import Collars, Rendering, render

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SMALLEST_SIZE = (4.5, 2.5)  # inches
LARGEST_RADIUS = 0.8  # inches
MARGIN, FOOTER, HEADER, LABEL_ROOM = 0.18, 0.95, 0.34, 0.3  # inches
FOOTER_SQUARE = 0.7  # inches
COLLAR_REACH = 0.9  # of the smaller radius
RING_RADIUS = 0.55  # of the smaller radius
INK = labels.INK


@dataclass(frozen=True)
class _Layout:
    """Inches of the figure and of its parts, whole pixels each, and the scale of the picture amid them."""

    width: float
    header: float
    picture: float
    footer: float
    inches_per_metre: float
    dots_per_inch: float

    @property
    def height(self) -> float:
        """Height of the figure."""
        return self.header + self.picture + self.footer

    @property
    def scale(self) -> float:
        """Pixels per metre."""
        return self.inches_per_metre * self.dots_per_inch

    @property
    def pixels(self) -> tuple[int, int]:
        """Width and height of the picture."""
        return round(self.width * self.dots_per_inch), round(self.picture * self.dots_per_inch)

    def footer_box(self, left: float, width: float, bottom: float, height: float) -> labels.Box:
        """Box as shares of the figure, from shares of its width and inches above its lower edge."""
        return left, bottom / self.height, width, height / self.height

    @property
    def colour_bar_box(self) -> labels.Box:
        """Between the scale bar and the two footer squares."""
        left = 0.31
        width = min(0.39, 1 - left - (MARGIN + 2 * FOOTER_SQUARE + 0.3) / self.width)
        return self.footer_box(left, width, 0.38, 0.13)

    def footer_square(self, column: int) -> labels.Box:
        """Square place in the footer, counted from the right."""
        left = 1 - (MARGIN + (column + 1) * FOOTER_SQUARE + 0.1 * column) / self.width
        return self.footer_box(left, FOOTER_SQUARE / self.width, 0.12, FOOTER_SQUARE)


def draw(
    aggregate: Aggregate,
    contact_values: ArrayLike | None = None,
    *,
    quantity: str = "tension",
    unit: str | None = "N",
    flow: LinearFlow | None = None,
    critical: int | None = None,
    view_direction: ArrayLike | None = None,
    size: tuple[float, float] = (6.4, 5.6),
    length_unit: str | None = "m",
    title: str | None = None,
    dots_per_inch: float = 160.0,
) -> Figure:
    """Picture of an aggregate: spheres in true size, each contact coloured by its value.

    Parameters
    ----------
    aggregate
        What to draw.
    contact_values
        (C,) one value per contact in `unit`, such as the tension: red where positive (pulled apart), blue where
        negative (pressed together), grey where near zero. None leaves the contacts grey.
    quantity, unit
        What the values are, for the colour bar. A decimal prefix is chosen: give "N" and it may show nN. None for
        dimensionless values.
    flow
        Linear flow whose principal strain rates are shown as arrows, seen from the same side as the aggregate.
    critical
        Index of a contact to point out.
    view_direction
        (3,) from the aggregate to the viewer. By default the aggregate is seen from where it is broadest.
    size
        Largest width and height of the figure in inches; the height shrinks to fit a flat aggregate.
    length_unit
        Unit of the coordinates for the scale bar, which shows a decimal prefix; None when they are dimensionless.
    title
        Text above the picture.
    dots_per_inch
        Resolution; 300 suits print.

    Returns
    -------
    matplotlib.figure.Figure
        Not registered with pyplot. Save it with `save` or its own `savefig`.

    Raises
    ------
    ValueError
        If the number of values is not that of the contacts, a value is not finite, the index is out of range, the
        view direction is zero or the size too small.
    """
    from matplotlib.figure import Figure

    values = None if contact_values is None else _values(contact_values, len(aggregate.pairs))
    if critical is not None:
        critical = _contact_index(critical, len(aggregate.pairs))
    _refuse_small(size)
    dots_per_inch = _checks.positive("dots_per_inch", dots_per_inch)
    axes = view_axes(aggregate.spheres, view_direction)
    layout = _layout(aggregate, axes, size, dots_per_inch, critical is not None, title is not None)
    shown = np.zeros(len(aggregate.pairs)) if values is None else values
    scale = ColourScale(shown)
    rendering, points = _rendered(aggregate, axes, layout, scale(shown))

    figure = Figure(figsize=(layout.width, layout.height), dpi=layout.dots_per_inch, facecolor="white")
    picture = _picture_axes(figure, layout, rendering)
    if title is not None:
        figure.text(0.5, 1 - 0.6 * HEADER / layout.height, title, ha="center", va="center", size=11, color=INK)
    labels.draw_scale_bar(figure, layout.footer_box(0.03, 0.22, 0.3, 0.4), layout.scale, length_unit)
    if values is not None:
        labels.draw_colour_bar(figure, layout.colour_bar_box, scale, quantity, unit)
    labels.draw_triad(figure, layout.footer_square(0 if flow is None else 1), axes)
    if flow is not None:
        labels.draw_flow(figure, layout.footer_square(0), axes, flow.strain_rate)
    if critical is not None:
        text = "critical contact" if values is None else f"critical contact: {quoted(values[critical], unit)}"
        ring = RING_RADIUS * layout.scale * float(aggregate.spheres.radii[aggregate.pairs[critical]].min())
        labels.mark_contact(picture, rendering, points[critical], ring, critical, text)
    return figure


def save(figure: Figure, file: str | PathLike[str] | IO[bytes]) -> None:
    """Write a figure to a path, by whose ending the format is chosen (png, pdf, svg), or to a binary file as PNG."""
    figure.savefig(file, dpi=figure.dpi, facecolor="white")


def _values(contact_values: ArrayLike, count: int) -> FloatArray:
    values = _checks.real_array("contact_values", contact_values, ("C",))
    if len(values) != count:
        raise ValueError(f"contact_values: expected one per contact ({count}), got {len(values)}")
    return values


def _contact_index(critical: int, count: int) -> int:
    if isinstance(critical, bool) or not isinstance(critical, int | np.integer) or not 0 <= critical < count:
        expected = f"the index of a contact from 0 to {count - 1}" if count else "None, as there are no contacts"
        raise ValueError(f"critical: expected {expected}, got {critical!r}")
    return int(critical)


def _refuse_small(size: tuple[float, float]) -> None:
    width, height = _checks.positive_array("size", size, (2,))
    if width < SMALLEST_SIZE[0] or height < SMALLEST_SIZE[1]:
        smallest = " by ".join(f"{length:g}" for length in SMALLEST_SIZE)
        raise ValueError(f"size: expected at least {smallest} inches, got {width:g} by {height:g}")


def _layout(
    aggregate: Aggregate,
    axes: FloatArray,
    size: tuple[float, float],
    dots_per_inch: float,
    marked: bool,
    titled: bool,
) -> _Layout:
    """Sizes with which the aggregate fills the figure, its spheres not larger than `LARGEST_RADIUS`."""
    low, high = _extent(aggregate, axes)
    header = HEADER if titled else 0.0
    room = 2 * MARGIN + (LABEL_ROOM if marked else 0.0)
    free = np.array([size[0] - 2 * MARGIN, size[1] - header - FOOTER - room])
    inches_per_metre = min(float((free / (high - low)).min()), LARGEST_RADIUS / float(aggregate.spheres.radii.max()))
    lengths = np.array([size[0], header, inches_per_metre * float(high[1] - low[1]) + room, FOOTER])
    width, header, picture, footer = (float(length) for length in np.round(lengths * dots_per_inch) / dots_per_inch)
    return _Layout(width, header, picture, footer, inches_per_metre, dots_per_inch)


def _extent(aggregate: Aggregate, axes: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Lower left and upper right corner of the projected aggregate, in m."""
    flat, radii = aggregate.spheres.centers @ axes[:2].T, aggregate.spheres.radii[:, None]
    return (flat - radii).min(axis=0), (flat + radii).max(axis=0)


def _rendered(
    aggregate: Aggregate, axes: FloatArray, layout: _Layout, colours: FloatArray
) -> tuple[Rendering, FloatArray]:
    """The image, and the contact points (C, 3) in its pixels."""
    low, high = _extent(aggregate, axes)
    lower_middle = np.array([(low[0] + high[0]) / 2, low[1], float(axes[2] @ aggregate.spheres.center_of_mass)])
    width, height = layout.pixels
    shift = np.array([width / 2, MARGIN * layout.dots_per_inch, 0.0])
    centers = (aggregate.spheres.centers @ axes.T - lower_middle) * layout.scale + shift
    points = (aggregate.contact_points @ axes.T - lower_middle) * layout.scale + shift
    radii = aggregate.spheres.radii * layout.scale
    reaches = COLLAR_REACH * radii[aggregate.pairs].min(axis=1)
    return render(centers, radii, Collars(aggregate.pairs, points, reaches, colours), width, height), points


def _picture_axes(figure: Figure, layout: _Layout, rendering: Rendering) -> Axes:
    """Axes in pixels that show the image one to one."""
    width, height = layout.pixels
    axes = figure.add_axes((0, layout.footer / layout.height, 1, layout.picture / layout.height))
    axes.imshow(
        rendering.image, origin="lower", extent=(0, width, 0, height), aspect="auto", interpolation="antialiased"
    )
    axes.set_axis_off()
    return axes
