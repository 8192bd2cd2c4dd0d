"""The everyday picture: an aggregate with its contacts coloured by what they carry."""

from __future__ import annotations

from collections.abc import Callable
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
from rheoclast.view.layout import (
    FOOTER,
    HEADER,
    LARGEST_RADIUS,
    MARGIN,
    Layout,
    extent,
    image_axes,
    refuse_small,
)
from rheoclast.view.projection import view_axes
from rheoclast.view.quantities import quoted
from rheoclast.view.rendering import Collars, Rendering, render

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SMALLEST_SIZE = (4.5, 2.5)  # inches
LABEL_ROOM = 0.3  # inches
ARROW, SMALLEST_ARROW = 3.5, 18.0  # radii and at least points: length of the longest arrow
COLLAR_REACH = 0.9  # of the smaller radius
RING_RADIUS = 0.55  # of the smaller radius


def draw(
    aggregate: Aggregate,
    contact_values: ArrayLike | None = None,
    *,
    quantity: str = "tension",
    unit: str | None = "N",
    forces: ArrayLike | None = None,
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
    forces
        (N, 3) forces of the fluid on the spheres, such as `SphereLoads.force`, shown as arrows from the centres, in N
        or, if `unit` is None, without a unit. Of more than 300 the largest of each place are shown.
    flow
        Linear flow whose principal strain rates are shown as arrows, seen from the same side as the aggregate.
    critical
        Index of a contact to point out.
    view_direction
        (3,) from the aggregate to the viewer. By default the aggregate is seen from where it is broadest.
    size
        Largest width and height of the figure in inches; the height shrinks to fit what is drawn.
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
    values = None if contact_values is None else _values(contact_values, len(aggregate.pairs))
    pushes = None if forces is None else _checks.real_array("forces", forces, (len(aggregate), 3))
    if critical is not None:
        critical = _contact_index(critical, len(aggregate.pairs))
    refuse_small(size, SMALLEST_SIZE)
    dots_per_inch = _checks.positive("dots_per_inch", dots_per_inch)
    axes = view_axes(aggregate.spheres, view_direction)
    layout = _layout(aggregate, axes, size, dots_per_inch, critical is not None, title is not None)
    shown = np.zeros(len(aggregate.pairs)) if values is None else values
    scale = ColourScale(shown)
    pixels = _pixels(aggregate, axes, layout)
    points = pixels(aggregate.contact_points)
    rendering = _rendered(aggregate, layout, pixels(aggregate.spheres.centers), points, scale(shown))

    figure = labels.titled_figure(layout, title)
    picture = image_axes(figure, layout.picture_box, rendering.image)
    if pushes is not None:
        longest = max(ARROW * layout.scale * aggregate.spheres.mean_radius, SMALLEST_ARROW * dots_per_inch / 72)
        named = None if unit is None else "N"
        labels.draw_forces(picture, pixels(aggregate.spheres.centers), pushes @ axes.T, longest, named)
    if critical is not None:
        text = "critical contact" if values is None else f"critical contact: {quoted(values[critical], unit)}"
        _mark(picture, rendering, critical, points, RING_RADIUS * layout.scale * _reaches(aggregate)[critical], text)
    labels.draw_scale_bar(figure, layout.scale_bar_box, layout.scale, length_unit)
    if values is not None:
        labels.draw_colour_bar(figure, layout.colour_bar_box, scale, quantity, unit)
    labels.draw_triad(figure, layout.footer_square(0 if flow is None else 1), axes)
    if flow is not None:
        labels.draw_flow(figure, layout.footer_square(0), axes, flow.strain_rate)
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


def _layout(
    aggregate: Aggregate,
    axes: FloatArray,
    size: tuple[float, float],
    dots_per_inch: float,
    marked: bool,
    titled: bool,
) -> Layout:
    """Sizes with which the aggregate fills the figure, its spheres not larger than `LARGEST_RADIUS`."""
    low, high = extent(aggregate.spheres.centers @ axes.T, aggregate.spheres.radii)
    header = HEADER if titled else 0.0
    room = 2 * MARGIN + (LABEL_ROOM if marked else 0.0)
    free = np.array([size[0] - 2 * MARGIN, size[1] - header - FOOTER - room])
    inches_per_metre = min(float((free / (high - low)).min()), LARGEST_RADIUS / float(aggregate.spheres.radii.max()))
    picture = inches_per_metre * float(high[1] - low[1]) + room
    return Layout.rounded(size[0], header, picture, FOOTER, inches_per_metre, dots_per_inch)


def _pixels(aggregate: Aggregate, axes: FloatArray, layout: Layout) -> Callable[[FloatArray], FloatArray]:
    """Where points (P, 3) of the aggregate are in the picture, (P, 3) in pixels, the last towards the viewer."""
    low, high = extent(aggregate.spheres.centers @ axes.T, aggregate.spheres.radii)
    lower_middle = np.array([(low[0] + high[0]) / 2, low[1], float(axes[2] @ aggregate.spheres.center_of_mass)])
    shift = np.array([layout.pixels[0] / 2, MARGIN * layout.dots_per_inch, 0.0])
    return lambda points: (points @ axes.T - lower_middle) * layout.scale + shift


def _rendered(
    aggregate: Aggregate, layout: Layout, centers: FloatArray, points: FloatArray, colours: FloatArray
) -> Rendering:
    """The image, from centres (N, 3) and contact points (C, 3) in its pixels."""
    reaches = layout.scale * _reaches(aggregate)
    collars = Collars.around(aggregate.pairs, points, reaches, COLLAR_REACH, colours)
    return render(centers, layout.scale * aggregate.spheres.radii, collars, *layout.pixels)


def _reaches(aggregate: Aggregate) -> FloatArray:
    """Radius (C,) of the smaller sphere of every contact."""
    return aggregate.spheres.radii[aggregate.pairs].min(axis=1)


def _mark(axes: Axes, rendering: Rendering, contact: int, points: FloatArray, ring: float, text: str) -> None:
    """Ring a contact, one of those at points (C, 3), and say what it is."""
    visible = bool((rendering.contact == contact).any())
    labels.mark_contact(axes, rendering.image, points[contact], ring, text, visible)
