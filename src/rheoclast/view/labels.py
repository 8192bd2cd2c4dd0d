"""What stands beside the spheres: title, scale bar, colour bar, axes, flow, and the mark on a critical contact."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from rheoclast._checks import FloatArray
from rheoclast.view.colours import ColourScale
from rheoclast.view.layout import Box, Layout
from rheoclast.view.projection import principal_axes
from rheoclast.view.quantities import minus, prefixed, quoted, round_down
from rheoclast.view.rendering import Image

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.colors import Colormap
    from matplotlib.figure import Figure

INK, FAINT_INK = "#24282d", "#6d737a"
LARGE, SMALL, TINY = 11, 9, 8  # points
EXTENDED, SHORTENED = "#c9370f", "#1c5fb4"
MOST_ARROWS, ARROW_SPACING = 300, 9  # points
END_ON = 0.2  # projected length of a unit vector that counts as pointing at the viewer


def titled_figure(layout: Layout, title: str | None) -> Figure:
    """White figure with its title above the picture."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=layout.figure_size, dpi=layout.dots_per_inch, facecolor="white")
    if title is not None:
        top = 1 - 0.6 * layout.header / layout.height
        figure.text(0.5, top, title, ha="center", va="center", size=LARGE, color=INK)
    return figure


def draw_scale_bar(figure: Figure, box: Box, pixels_per_length: float, length_unit: str | None) -> None:
    """Bar of a round length, at most as long as the box (left, bottom, width, height as shares of the figure)."""
    available = box[2] * figure.get_figwidth() * figure.dpi
    length = round_down(available / pixels_per_length)
    share = length * pixels_per_length / available
    axes = _bare_axes(figure, box)
    axes.set(xlim=(0, 1), ylim=(0, 1))
    axes.plot([0, share], [0.66, 0.66], color=INK, linewidth=2.5, solid_capstyle="butt", clip_on=False)
    axes.text(share / 2, 0.5, quoted(length, length_unit), ha="center", va="top", size=SMALL, color=INK)


def draw_colour_bar(figure: Figure, box: Box, scale: ColourScale, quantity: str, unit: str | None) -> None:
    """Horizontal colour bar with its quantity and unit; pointed where values exceed its limits."""
    from matplotlib.cm import ScalarMappable

    divisor, shown_unit = prefixed(scale.limit, unit)
    axes = figure.add_axes(box)
    bar = figure.colorbar(
        ScalarMappable(scale.norm, scale.map), cax=axes, orientation="horizontal", extend=scale.extend, extendfrac=0.05
    )
    ticks = scale.limit * np.linspace(-1, 1, 5 if box[2] * figure.get_figwidth() > 1.8 else 3)
    bar.set_ticks(list(ticks), labels=[minus(f"{tick / divisor:g}") for tick in ticks])
    bar.outline.set(edgecolor=FAINT_INK, linewidth=0.6)
    axes.tick_params(labelsize=TINY, length=2.5, width=0.6, color=FAINT_INK, labelcolor=INK, pad=2)
    label = f"{quantity} ({shown_unit})" if shown_unit else quantity
    axes.set_title(label, size=SMALL, color=INK, pad=4)


def draw_failure_bar(figure: Figure, box: Box, colours: Colormap, rates: FloatArray) -> Axes:
    """Colour bar of failures by their number, and over it their rates (K,) over the first one's, K > 1."""
    count, ratios = len(rates), rates / rates[0]
    left, bottom, width, height = box
    bar = figure.add_axes((left, bottom, width, 0.16 * height))
    bar.imshow(np.arange(count)[None, :], cmap=colours, aspect="auto", extent=(0.5, count + 0.5, 0, 1))
    bar.set(yticks=[], xticks=[1, count], xlabel="failure")
    chart = figure.add_axes((left, bottom + 0.24 * height, width, 0.76 * height), sharex=bar)
    number = np.arange(1, count + 1)
    chart.plot(number, ratios, color=FAINT_INK, linewidth=0.7, zorder=1)
    chart.scatter(number, ratios, c=number, cmap=colours, s=min(10.0, 400 / count), linewidths=0, zorder=2)
    top = float(ratios.max())
    ticks = [0.0, top] if top > 4 else [0.0, 1.0, top] if top > 1.3 else [0.0, 1.0]
    chart.set(ylim=(0, 1.06 * top))
    chart.set_yticks(ticks, labels=[f"{tick:.3g}" for tick in ticks])
    chart.spines[["top", "right", "bottom"]].set_visible(False)
    for axes in (bar, chart):
        axes.tick_params(labelsize=TINY, length=2.5, width=0.6, color=FAINT_INK, labelcolor=INK, pad=2)
        for spine in axes.spines.values():
            spine.set(edgecolor=FAINT_INK, linewidth=0.6)
    chart.tick_params(axis="x", bottom=False, labelbottom=False)
    bar.xaxis.label.set(size=SMALL, color=INK)
    bar.xaxis.labelpad = -8
    chart.set_title("rate / initiation rate", size=SMALL, color=INK, pad=3)
    return chart


def draw_triad(figure: Figure, box: Box, view: FloatArray) -> None:
    """Projected axes of coordinates x, y, z, seen along the third row of `view` (3, 3)."""
    axes = _bare_axes(figure, box)
    axes.set(xlim=(-1.35, 1.35), ylim=(-1.35, 1.35))
    tips = view[:2].T
    for k in np.argsort(view[2]):
        length = float(np.hypot(*tips[k]))
        if length < END_ON:
            _draw_end_on(axes, towards=view[2, k] > 0)
        else:
            _arrow(axes, np.zeros(2), 0.85 * tips[k], FAINT_INK)
        aside = tips[k] - tips.sum(axis=0)
        place = (0.85 + 0.3 / length) * tips[k] if length > 0.45 else 0.5 * aside / np.hypot(*aside)
        axes.text(float(place[0]), float(place[1]), "xyz"[k], ha="center", va="center", size=TINY, color=FAINT_INK)


def draw_flow(figure: Figure, box: Box, view: FloatArray, strain_rate: FloatArray) -> None:
    """Principal strain rates as pairs of arrows: outwards where lines of fluid lengthen, inwards where they shorten."""
    axes = _bare_axes(figure, box)
    axes.set(xlim=(-1.2, 1.2), ylim=(-1.2, 1.2))
    rates, directions = principal_axes(view @ strain_rate @ view.T)
    largest, top = float(np.abs(rates).max()) or 1.0, 0.0
    for rate, direction in zip(rates / largest, directions, strict=True):
        reach = 0.3 + 0.75 * abs(rate)
        inner, outer = 0.25 * direction[:2], reach * direction[:2]
        if np.hypot(*(outer - inner)) < 0.12:
            continue
        start, end, colour = (inner, outer, EXTENDED) if rate > 0 else (outer, inner, SHORTENED)
        top = max(top, abs(float(outer[1])))
        for side in (1, -1):
            _arrow(axes, side * start, side * end, colour)
    axes.text(0, top + 0.25, "flow", ha="center", va="bottom", size=TINY, color=FAINT_INK)


def draw_forces(axes: Axes, points: FloatArray, forces: FloatArray, reach: float, unit: str | None) -> None:
    """Forces (N, 3) as arrows from points (N, 3) in pixels, the longest of length `reach`, and what that stands for.

    Of very many, which would hide each other, the largest of each small square of the picture are drawn.
    """
    size = np.linalg.norm(forces, axis=1)
    largest = float(size.max())
    if not largest > 0:
        return
    pixel = axes.figure.dpi / 72
    shown = np.argsort(-size, kind="stable")
    if len(shown) > MOST_ARROWS:
        squares = np.floor(points[shown, :2] / (ARROW_SPACING * pixel))
        shown = shown[np.sort(np.unique(squares, axis=0, return_index=True)[1])][:MOST_ARROWS]
    x, y, u, v = np.concatenate([points[shown, :2], reach / largest * forces[shown, :2]], axis=1).T
    axes.quiver(
        x,
        y,
        u,
        v,
        angles="xy",
        scale_units="xy",
        scale=1,
        units="xy",
        width=1.6 * pixel,
        headwidth=4,
        headlength=4.5,
        color=INK,
        edgecolor="white",
        linewidth=0.5,
    )
    note = f"arrows: force of the fluid, longest {quoted(largest, unit)}"
    if len(size) > MOST_ARROWS:
        note += f" ({len(shown)} of {len(size)} drawn)"
    axes.text(0.01, 0.99, note, transform=axes.transAxes, size=TINY, color=FAINT_INK, va="top")


def mark_contact(axes: Axes, image: Image, point: FloatArray, radius: float, text: str, visible: bool = True) -> None:
    """Ring of a radius around a contact point, in pixels, and a leader to a label where the picture is emptiest.

    The ring is dashed where the contact is hidden behind spheres.
    """
    from matplotlib.patches import Circle

    style = "solid" if visible else (0, (2.2, 1.6))
    pixel = axes.figure.dpi / 72
    radius = max(radius, 8 * pixel)
    for colour, width in (("white", 3.4), (INK, 1.5)):
        axes.add_patch(Circle((point[0], point[1]), radius, fill=False, color=colour, linewidth=width, linestyle=style))
    label = axes.text(0, 0, text if visible else f"{text} (hidden)", size=SMALL, color=INK, ha="center", va="center")
    extent = label.get_window_extent()
    half = np.array([extent.width, extent.height]) / 2 + 5 * pixel
    place = _free_place(image[..., 3], point[:2], half, radius + 8 * pixel)
    label.set_position((float(place[0]), float(place[1])))
    label.set_bbox({"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1.5})
    half -= 3 * pixel
    nearest = np.clip(point[:2], place - half, place + half)
    leave = point[:2] + radius * (nearest - point[:2]) / max(float(np.linalg.norm(nearest - point[:2])), pixel)
    for colour, width in (("white", 2.6), (INK, 1.0)):
        axes.plot(*np.stack([leave, nearest], axis=1), color=colour, linewidth=width, solid_capstyle="round")


def _free_place(opacity: Image, point: FloatArray, half: FloatArray, clearance: float) -> FloatArray:
    """Middle of a box of half size `half`, inside the image, that covers least of it and is near the point."""
    height, width = opacity.shape
    total = np.pad(opacity.astype(np.float64).cumsum(axis=0).cumsum(axis=1), ((1, 0), (1, 0)))
    x = np.arange(half[0] + 2, max(width - half[0] - 2, half[0] + 3), 4)
    y = np.arange(half[1] + 2, max(height - half[1] - 2, half[1] + 3), 4)
    left, right = ((x + side * half[0]).astype(int).clip(0, width) for side in (-1, 1))
    low, high = ((y + side * half[1]).astype(int).clip(0, height)[:, None] for side in (-1, 1))
    covered = (total[high, right] - total[low, right] - total[high, left] + total[low, left]) / (4 * half.prod())
    gap = np.hypot(
        np.maximum(np.abs(x - point[0]) - half[0], 0), np.maximum(np.abs(y - point[1]) - half[1], 0)[:, None]
    )
    aside = gap + 0.1 * np.hypot(x - point[0], (y - point[1])[:, None])
    cost = covered + aside / max(width, height) + np.where(gap < clearance, 10.0, 0.0)
    row, column = np.unravel_index(int(cost.argmin()), cost.shape)
    return np.array([x[column], y[row]])


def _bare_axes(figure: Figure, box: Box) -> Axes:
    axes = figure.add_axes(box)
    axes.set_axis_off()
    return axes


def _arrow(axes: Axes, start: FloatArray, end: FloatArray, colour: str) -> None:
    head = 8 * min(1.0, 2.5 * float(np.hypot(*(end - start))))
    style = {"arrowstyle": "-|>", "color": colour, "linewidth": 1.3, "mutation_scale": head, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", tuple(end), tuple(start), arrowprops=style, annotation_clip=False)


def _draw_end_on(axes: Axes, towards: bool) -> None:
    """The sign of an arrow towards the viewer, a point in a circle, or away from the viewer, a cross in it."""
    axes.plot(0, 0, "o", markersize=6, markerfacecolor="white", color=FAINT_INK, markeredgewidth=1)
    axes.plot(0, 0, "." if towards else "x", markersize=3, color=FAINT_INK)
