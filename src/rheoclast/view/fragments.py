"""Fragments side by side, and the colours by which they are known."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.breakup.event import Breakup
from rheoclast.particles.aggregate import Aggregate
from rheoclast.view import labels
from rheoclast.view.layout import (
    HEADER,
    LARGEST_RADIUS,
    MARGIN,
    Layout,
    extent,
    image_axes,
    refuse_small,
)
from rheoclast.view.projection import view_axes
from rheoclast.view.rendering import Collars, render

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLOURS = np.array([[0.56, 0.72, 0.87], [0.93, 0.85, 0.56], [0.40, 0.68, 0.58], [0.96, 0.72, 0.76]])
REST = np.array([0.80, 0.80, 0.80])
SMALLEST_SIZE = (3.0, 2.0)  # inches
FOOTER, CAPTION, CAPTION_WIDTH, LEGEND_TOP = 0.6, 0.26, 0.85, 0.24  # inches
MOST_SHOWN = 24
HALVINGS = 40
ROUNDING = 1e-9


def fragment_colours(breakup: Breakup) -> FloatArray:
    """Red, green, blue (N, 3) of the spheres by the fragment they end in; grey beyond the largest few or unsplit."""
    colours = np.tile(REST, (sum(len(spheres) for spheres in breakup.spheres), 1))
    if not breakup.splits:
        return colours
    for colour, spheres in zip(COLOURS, breakup.spheres, strict=False):
        colours[spheres] = colour
    return colours


def counted(count: int, noun: str) -> str:
    """A number and its noun, such as "1 sphere" and "2 spheres"."""
    return f"{count} {noun}{'s' * (count != 1)}"


def draw_sizes(axes: Axes, breakup: Breakup) -> None:
    """Legend above a panel: the colours, with the number of spheres in each fragment."""
    from matplotlib.patches import Patch

    sizes = [len(spheres) for spheres in breakup.spheres]
    shown = sizes[: len(COLOURS)]
    entries = [(COLOURS[k], str(size)) for k, size in enumerate(shown)]
    entries[-1] = (entries[-1][0], counted(shown[-1], "sphere"))
    if rest := sizes[len(COLOURS) :]:
        spread = f"{rest[-1]}" if rest[0] == rest[-1] else f"{rest[-1]} to {rest[0]}"
        entries.append((REST, f"{len(rest)} more, of {spread}"))
    handles = [Patch(facecolor=tuple(colour), edgecolor=labels.FAINT_INK, linewidth=0.5) for colour, _ in entries]
    panel = axes.get_window_extent()
    width, height = panel.width / axes.figure.dpi, panel.height / axes.figure.dpi
    axes.legend(
        handles,
        [text for _, text in entries],
        loc="upper left",
        bbox_to_anchor=(MARGIN / width, 1 + LEGEND_TOP / height),
        ncols=len(entries),
        frameon=False,
        fontsize=labels.TINY,
        labelcolor=labels.INK,
        handlelength=1.0,
        handleheight=1.0,
        handletextpad=0.4,
        columnspacing=1.0,
        borderpad=0,
        borderaxespad=0,
    )


def draw_fragments(
    breakup: Breakup,
    *,
    size: tuple[float, float] = (8.0, 6.0),
    length_unit: str | None = "m",
    title: str | None = None,
    dots_per_inch: float = 160.0,
) -> Figure:
    """Picture of the fragments side by side at one scale, the largest first, each seen where it is broadest.

    Parameters
    ----------
    breakup
        Whose fragments are drawn, with the number of spheres below each; of more than 24 the largest.
    size, length_unit, title, dots_per_inch
        As in `draw`.

    Returns
    -------
    matplotlib.figure.Figure
        As from `draw`.

    Raises
    ------
    TypeError
        If `breakup` is something else.
    ValueError
        If the size is too small.
    """
    _checks.instance("breakup", breakup, Breakup, "make one with break_up(aggregate, response, bonds, flow)")
    refuse_small(size, SMALLEST_SIZE)
    dots_per_inch = _checks.positive("dots_per_inch", dots_per_inch)
    bodies = [_broadest(fragment) for fragment in breakup.fragments[:MOST_SHOWN]]
    corners = np.array([extent(*body) for body in bodies])
    lengths = corners[:, 1] - corners[:, 0]
    header = HEADER if title is not None else 0.0
    scale = _scale(lengths, (size[0], size[1] - header - FOOTER), max(float(radii.max()) for _, radii in bodies))
    places, height = _shelves(scale * lengths, size[0])
    layout = Layout.rounded(size[0], header, height, FOOTER, scale, dots_per_inch)
    figure = labels.titled_figure(layout, title)
    colours = [*COLOURS, *[REST] * MOST_SHOWN]
    for body, colour, low, place in zip(bodies, colours, corners[:, 0], places, strict=False):
        _draw_body(figure, layout, body, colour, low, place)
    labels.draw_scale_bar(figure, layout.footer_box(0.03, 0.22, 0.05, 0.4), layout.scale, length_unit)
    if left := len(breakup.fragments) - len(bodies):
        note = f"and {left} more, of at most {counted(len(breakup.fragments[MOST_SHOWN]), 'sphere')}"
        figure.text(0.97, 0.3 / layout.height, note, ha="right", va="center", size=labels.SMALL, color=labels.INK)
    return figure


def _broadest(fragment: Aggregate) -> tuple[FloatArray, FloatArray]:
    """Centres and radii as seen where the fragment is broadest."""
    return fragment.spheres.centers @ view_axes(fragment.spheres).T, fragment.spheres.radii


def _scale(lengths: FloatArray, free: tuple[float, float], largest_radius: float) -> float:
    """Largest scale, inches per unit of length, at which pictures of given lengths (F, 2) find room on shelves."""
    high = min(LARGEST_RADIUS / largest_radius, (free[0] - 2 * MARGIN) / float(lengths[:, 0].max()))
    if _shelves(high * lengths, free[0])[1] <= free[1]:
        return high
    low = 0.0
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if _shelves(middle * lengths, free[0])[1] <= free[1] else (low, middle)
    return low


def _shelves(lengths: FloatArray, width: float) -> tuple[FloatArray, float]:
    """Places (F, 2) of pictures that stand on shelves, inches below the upper left corner, and the height of all."""
    rooms = np.maximum(lengths[:, 0], CAPTION_WIDTH) + MARGIN
    places = np.empty_like(lengths)
    shelf, top = 0, MARGIN
    while shelf < len(lengths):
        fitting = int(np.searchsorted(np.cumsum(rooms[shelf:]) + MARGIN, width * (1 + ROUNDING), side="right"))
        row = slice(shelf, shelf + max(1, fitting))
        left = MARGIN + np.cumsum(rooms[row]) - rooms[row]
        places[row, 0] = left + (rooms[row] - MARGIN - lengths[row, 0]) / 2
        places[row, 1] = top + lengths[row, 1].max() - lengths[row, 1]
        shelf, top = row.stop, top + float(lengths[row, 1].max()) + CAPTION + MARGIN
    return places, top


def _draw_body(
    figure: Figure,
    layout: Layout,
    body: tuple[FloatArray, FloatArray],
    colour: FloatArray,
    low: FloatArray,
    place: FloatArray,
) -> None:
    """One fragment, whose lower left corner is `low`, and below it the number of its spheres."""
    centers, radii = body
    high = extent(centers, radii)[1]
    width, height = (int(length) for length in np.ceil((high - low) * layout.scale) + 2)
    pixels = (centers - [*low, 0.0]) * layout.scale + [1.0, 1.0, 0.0]
    rendering = render(pixels, radii * layout.scale, Collars.none(), width, height, colours=colour)
    left = round(place[0] * layout.dots_per_inch)
    bottom = round((layout.picture + layout.footer - place[1]) * layout.dots_per_inch) - height
    box = layout.pixel_box(left, bottom, width, height)
    image_axes(figure, box, rendering.image)
    below = box[1] - 0.06 / layout.height
    text = counted(len(radii), "sphere")
    figure.text(box[0] + box[2] / 2, below, text, ha="center", va="top", size=labels.SMALL, color=labels.INK)
