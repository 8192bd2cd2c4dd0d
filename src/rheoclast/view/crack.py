"""A crack in one still: which contacts failed, in what order, and what they left."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.breakup.event import Breakup
from rheoclast.flows import LinearFlow
from rheoclast.view import labels
from rheoclast.view.fragments import counted, draw_sizes
from rheoclast.view.layout import (
    HEADER,
    LARGEST_RADIUS,
    MARGIN,
    Box,
    Layout,
    image_axes,
    refuse_small,
)
from rheoclast.view.quantities import quoted
from rheoclast.view.rendering import Collars, Image, render
from rheoclast.view.scene import Scene, scene

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.collections import EllipseCollection
    from matplotlib.colors import Colormap
    from matplotlib.figure import Figure
    from matplotlib.text import Text

SMALLEST_SIZE = (7.0, 3.5)  # inches
HEADING, HEADING_WIDTH, LABEL_ROOM, FOOTER = 0.55, 3.2, 0.3, 1.15  # inches
GHOST = 0.55  # share of white in spheres through which failed contacts are seen
ROOM = np.array([2 * MARGIN, 2 * MARGIN + LABEL_ROOM + HEADING])  # inches of a panel besides the spheres
DISC, SCAR, RING = 0.5, 0.75, 0.75  # of the smaller radius
SMALLEST_DISC = 1.8  # points
EDGE_ON = 0.35  # smallest height over width of a disc
FIRST_TO_LAST = (0.0, 0.88)  # part of the colour map "plasma" that stands out from white


@dataclass(frozen=True)
class Frame:
    """A window on the scene: its pixels, pixels per unit of length, and what lies at its lower left corner."""

    width: int
    height: int
    scale: float
    origin: tuple[float, float]

    @classmethod
    def around(cls, corners: tuple[FloatArray, FloatArray], width: int, height: int, scale: float) -> Frame:
        """The window with given corners of the scene in its middle."""
        middle = (corners[0] + corners[1]) / 2
        return cls(width, height, scale, (middle[0] - width / 2 / scale, middle[1] - height / 2 / scale))

    def pixels(self, points: FloatArray) -> FloatArray:
        """Points (..., 3) of the scene in pixels."""
        return (points - [*self.origin, 0.0]) * self.scale


def draw_crack(
    breakup: Breakup,
    *,
    view_direction: ArrayLike | None = None,
    size: tuple[float, float] = (9.6, 5.6),
    length_unit: str | None = "m",
    flow: LinearFlow | None = None,
    title: str | None = None,
    dots_per_inch: float = 160.0,
) -> Figure:
    """Picture of a breakup: the failed contacts in their order, and the fragments pulled apart.

    Spheres have the colour of the fragment they end in. Before the split they are pale, and the failed contacts are
    discs seen through them, lying as the contacts do. After it the fragments are pulled apart, and failed contacts are
    spots on both of their spheres; where three contacts or more led to other fragments, each is turned by 40° to show
    its fracture face. Below are the rates of the failures.

    Parameters
    ----------
    breakup
        From `break_up`. If it does not split, there are no fragments to show.
    view_direction
        (3,) from the aggregate to the viewer. By default the two largest fragments are side by side.
    size, length_unit, flow, title, dots_per_inch
        As in `draw`.

    Returns
    -------
    matplotlib.figure.Figure
        As from `draw`.

    Raises
    ------
    TypeError
        If the breakup is something else.
    ValueError
        If the view direction is zero or the size too small.
    """
    refuse_small(size, SMALLEST_SIZE)
    dots_per_inch = _checks.positive("dots_per_inch", dots_per_inch)
    seen = scene(breakup, view_direction)
    layout, boxes, frames = _panels(seen, breakup.splits, size, HEADER if title is not None else 0.0, dots_per_inch)
    figure = labels.titled_figure(layout, title)
    before = image_axes(figure, boxes[0], ghost(seen, frames[0]))
    draw_discs(before, seen, frames[0])
    _mark_first(before, seen, frames[0])
    _write_failures(before, breakup, None if length_unit is None else "1/s")
    if breakup.splits:
        after = image_axes(figure, boxes[1], pulled_apart(seen, frames[1]))
        turned = ", each turned to show its fracture face" if seen.parting.turns.any() else ", pulled apart"
        write_heading(after, counted(len(breakup.fragments), "fragment") + turned)
        draw_sizes(after, breakup)
    draw_footer(figure, layout, seen, breakup, length_unit, flow)
    return figure


def failure_colours() -> Colormap:
    """Colours of failures from the first to the last."""
    import matplotlib
    from matplotlib.colors import LinearSegmentedColormap

    colours = matplotlib.colormaps["plasma"](np.linspace(*FIRST_TO_LAST, 256))
    return LinearSegmentedColormap.from_list("failures", list(colours))


def sequence_colours(count: int) -> FloatArray:
    """Red, green, blue (K, 3) of failures in their order."""
    return np.asarray(failure_colours()(np.linspace(0, 1, count)))[:, :3]


def ghost(seen: Scene, frame: Frame) -> Image:
    """Pale image of the spheres in their places."""
    image = _rendered(seen, frame, 0.0, Collars.none())
    image[..., :3] += GHOST * (1 - image[..., :3])
    return image


def pulled_apart(seen: Scene, frame: Frame, progress: float = 1.0) -> Image:
    """Image of the fragments after a share of their parting, with a spot where each failed contact was."""
    spheres = seen.pairs.T.ravel()
    points = seen.parting.moved(np.tile(seen.points, (2, 1)), spheres, progress)
    radii, colours = frame.scale * np.tile(seen.smaller_radii, 2), np.tile(sequence_colours(len(seen.pairs)), (2, 1))
    scars = Collars.around(np.stack([spheres, spheres], axis=1), frame.pixels(points), radii, SCAR, colours)
    return _rendered(seen, frame, progress, scars)


def draw_discs(axes: Axes, seen: Scene, frame: Frame, count: int | None = None) -> EllipseCollection:
    """The first `count` failed contacts as discs that lie as the contacts do, nearer ones above, the first on top."""
    from matplotlib.collections import EllipseCollection

    order = 1 + np.argsort(seen.points[1:count, 2], kind="stable")
    order = np.append(order, np.zeros(min(1, len(seen.pairs)), dtype=order.dtype))
    normals, points = seen.normals[order], frame.pixels(seen.points[order])
    smallest = 2 * SMALLEST_DISC * axes.figure.dpi / 72
    width = np.maximum(2 * DISC * frame.scale * seen.smaller_radii[order], smallest)
    discs = EllipseCollection(
        width,
        width * np.maximum(np.abs(normals[:, 2]), EDGE_ON),
        np.degrees(np.arctan2(normals[:, 1], normals[:, 0])) + 90,
        units="xy",
        offsets=points[:, :2],
        offset_transform=axes.transData,
        facecolors=sequence_colours(len(seen.pairs))[order],
        edgecolors="white",
        linewidths=0.4,
        zorder=0.5,
    )
    axes.add_collection(discs, autolim=False)
    return discs


def write_heading(axes: Axes, text: str) -> Text:
    """Line of text above a panel."""
    return _above(axes, text, 25, labels.SMALL, labels.INK)


def draw_footer(
    figure: Figure, layout: Layout, seen: Scene, breakup: Breakup, length_unit: str | None, flow: LinearFlow | None
) -> Axes | None:
    """Scale bar, rates and colours of the failures, axes and flow; gives the chart of the rates, if there is one."""
    rates = np.array([failure.rate for failure in breakup.failures])
    labels.draw_scale_bar(figure, layout.scale_bar_box, layout.scale, length_unit)
    labels.draw_triad(figure, layout.footer_square(0 if flow is None else 1), seen.axes)
    if flow is not None:
        labels.draw_flow(figure, layout.footer_square(0), seen.axes, flow.strain_rate)
    if len(rates) < 2:
        return None
    left, _, width, _ = layout.colour_bar_box
    return labels.draw_failure_bar(figure, layout.footer_box(left, width, 0.32, 0.6), failure_colours(), rates)


def _above(axes: Axes, text: str, height: float, size: float, colour: str) -> Text:
    return axes.annotate(
        text, (0, 1), (72 * MARGIN, height), "axes fraction", textcoords="offset points", size=size, color=colour
    )


def _write_failures(axes: Axes, breakup: Breakup, rate_unit: str | None) -> None:
    """How many contacts fail, and at which rates of the flow."""
    if not breakup.failures:
        write_heading(axes, "no contact fails at any rate")
        return
    write_heading(axes, counted(len(breakup.failures), "failed contact") + ", seen through the spheres")
    rates = [failure.rate for failure in breakup.failures]
    first = quoted(rates[0], rate_unit)
    if not breakup.splits:
        text = f"first at rate {first}, no split"
    elif len(rates) == 1:
        text = f"at rate {first}, which splits it"
    elif max(rates) == rates[0]:
        text = f"first at rate {first}, and splits at once"
    else:
        text = f"first at rate {first}, split at {max(rates) / rates[0]:.3g} times that"
    _above(axes, text, 11, labels.TINY, labels.FAINT_INK)


def _mark_first(axes: Axes, seen: Scene, frame: Frame) -> None:
    if len(seen.pairs):
        radius = RING * frame.scale * float(seen.smaller_radii[0])
        image = np.asarray(axes.images[0].get_array())
        labels.mark_contact(axes, image, frame.pixels(seen.points[0]), radius, "first failure")


def _rendered(seen: Scene, frame: Frame, progress: float, collars: Collars) -> Image:
    centers = seen.parting.moved(seen.centers, np.arange(len(seen.radii)), progress)
    radii = seen.radii * frame.scale
    rendering = render(frame.pixels(centers), radii, collars, frame.width, frame.height, colours=seen.colours)
    return rendering.image


def _panels(
    seen: Scene, splits: bool, size: tuple[float, float], header: float, dots_per_inch: float
) -> tuple[Layout, list[Box], list[Frame]]:
    """Boxes and windows of the panels before and after, side by side or below each other, whichever is larger."""
    corners = [seen.corners(progress) for progress in ((0.0, 1.0) if splits else (0.0,))]
    lengths = np.array([high - low for low, high in corners])
    free = np.array([size[0], size[1] - header - FOOTER])
    scale, beside = _arrangement(lengths, free, LARGEST_RADIUS / float(seen.radii.max()))
    sizes = scale * lengths + ROOM
    if beside:
        sizes[:, 0] += (size[0] - sizes[:, 0].sum()) / len(sizes)
        sizes[:, 1] = sizes[:, 1].max()
    else:
        sizes[:, 0] = size[0]
    pixels = np.floor(sizes * dots_per_inch).astype(int)
    picture = pixels[:, 1].max() if beside else pixels[:, 1].sum()
    layout = Layout.rounded(size[0], header, picture / dots_per_inch, FOOTER, scale, dots_per_inch)
    heading, foot = round(HEADING * dots_per_inch), round(FOOTER * dots_per_inch)
    steps = np.cumsum(pixels, axis=0) - pixels
    boxes, frames = [], []
    for corner, (width, height), step in zip(corners, pixels.tolist(), steps.tolist(), strict=True):
        left, bottom = (step[0], foot) if beside else (0, foot + picture - step[1] - height)
        boxes.append(layout.pixel_box(left, bottom, width, height - heading))
        frames.append(Frame.around(corner, width, height - heading, layout.scale))
    return layout, boxes, frames


def _arrangement(lengths: FloatArray, free: FloatArray, largest: float) -> tuple[float, bool]:
    """Inches per unit of length at which pictures of given lengths (P, 2) fit, and whether side by side."""
    spare = free - ROOM * len(lengths)
    narrower = float(lengths[:, 0].mean() - lengths[:, 0].min())  # the narrowest panel is by that below the mean
    headings = (free[0] / len(lengths) - HEADING_WIDTH) / narrower if narrower else np.inf
    beside = min(spare[0] / lengths[:, 0].sum(), (free - ROOM)[1] / lengths[:, 1].max(), largest, headings)
    below = min((free - ROOM)[0] / lengths[:, 0].max(), spare[1] / lengths[:, 1].sum(), largest)
    return (float(beside), True) if beside >= below else (float(below), False)
