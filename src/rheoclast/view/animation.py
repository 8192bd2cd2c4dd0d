"""A crack as it runs, as an animated picture."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from rheoclast import _checks
from rheoclast.breakup.event import Breakup
from rheoclast.flows import LinearFlow
from rheoclast.view import labels
from rheoclast.view.crack import (
    FOOTER,
    RING,
    Frame,
    draw_discs,
    draw_footer,
    ghost,
    pulled_apart,
    sequence_colours,
    write_heading,
)
from rheoclast.view.fragments import COLOURS, counted, draw_sizes
from rheoclast.view.layout import HEADER, LARGEST_RADIUS, MARGIN, Layout, image_axes, refuse_small
from rheoclast.view.scene import Scene, scene

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from PIL.Image import Image as PillowImage

SMALLEST_SIZE = (4.5, 3.5)  # inches
HEADING = 0.5  # inches
MOST_STEPS = 60  # in which contacts fail
PARTING_STEPS = 7
START, SPLIT, END = 0.8, 1.0, 2.5  # seconds that the picture rests
PALETTE, FAILURE_COLOURS = 64, 16
ALIKE = 8  # of 255: Pillow does not tell colours apart that are closer
SMALLEST_RING = 7  # points
PLAYABLE = ["-pix_fmt", "yuv420p", "-movflags", "+faststart"]  # by every browser, and before all of it has come


@dataclass(frozen=True)
class Step:
    """Number of contacts that failed, share of the parting, and how long it is seen, in s."""

    failed: int
    progress: float
    seconds: float


def animate_crack(
    breakup: Breakup,
    file: str | PathLike[str] | IO[bytes],
    *,
    frames_per_second: float = 8.0,
    view_direction: ArrayLike | None = None,
    size: tuple[float, float] = (6.0, 5.2),
    length_unit: str | None = "m",
    flow: LinearFlow | None = None,
    title: str | None = None,
    dots_per_inch: float = 80.0,
) -> None:
    """Write an animated picture of a breakup: the contacts fail one after the other, then the fragments part.

    Failed contacts are discs seen through pale spheres, which have the colour of the fragment they end in. A ring is
    around the latest, and above is the rate of the flow at which it failed, over that of the first. Of many failures
    several are shown at a time, in at most 60 steps.

    Parameters
    ----------
    breakup, view_direction
        As in `draw_crack`.
    file
        Path that ends in .gif or .mp4, or a binary file, which gets a GIF. An MP4 needs the program ffmpeg, which
        comes with ``pip install "rheoclast[film]"`` or is on the PATH.
    frames_per_second
        Steps per second.
    size, length_unit, flow, title
        As in `draw`.
    dots_per_inch
        Resolution; the size of the file grows with its square.

    Raises
    ------
    TypeError
        If the breakup is something else.
    ValueError
        If the ending of the path is another, the view direction is zero or the size too small.
    RuntimeError
        If an MP4 is wanted and ffmpeg is not found.
    """
    encoder = _encoder(file)
    refuse_small(size, SMALLEST_SIZE)
    frames_per_second = _checks.positive("frames_per_second", frames_per_second)
    dots_per_inch = _checks.positive("dots_per_inch", dots_per_inch)
    seen = scene(breakup, view_direction)
    layout, frame = _window(seen, breakup.splits, size, HEADER if title is not None else 0.0, dots_per_inch)
    figure = labels.titled_figure(layout, title)
    chart = draw_footer(figure, layout, seen, breakup, length_unit, flow)
    steps = _steps(len(breakup.failures), breakup.splits, frames_per_second)
    film = _played(figure, layout, frame, seen, breakup, chart, steps)
    if encoder is None:
        _write_gif(figure, film, file)
    else:
        _write_mp4(figure, film, file, frames_per_second, encoder)


def _encoder(file: str | PathLike[str] | IO[bytes]) -> str | None:
    """Path of the program that an MP4 needs, None for a GIF."""
    ending = Path(file).suffix.lower() if isinstance(file, str | PathLike) else ".gif"
    if ending not in (".gif", ".mp4"):
        raise ValueError(f"file: expected a path that ends in .gif or .mp4, got {str(file)!r}")
    return _ffmpeg() if ending == ".mp4" else None


def _ffmpeg() -> str:
    """Path of the program ffmpeg: that of the package imageio-ffmpeg, or else the one on the PATH."""
    try:
        from imageio_ffmpeg import get_ffmpeg_exe

        return get_ffmpeg_exe()
    except (ImportError, RuntimeError):  # not installed, or installed without the program
        found = shutil.which("ffmpeg")
    if found is None:
        raise RuntimeError(
            "file: an .mp4 needs the program ffmpeg, which is not found; "
            'install it by `pip install "rheoclast[film]"`, or put one on the PATH, or write a .gif'
        )
    return found


def _window(
    seen: Scene, splits: bool, size: tuple[float, float], header: float, dots_per_inch: float
) -> tuple[Layout, Frame]:
    """Layout, of even size as H.264 asks, and a window in which all of the parting stays in sight."""
    corners = [seen.corners(progress) for progress in (np.linspace(0, 1, PARTING_STEPS + 1) if splits else (0.0,))]
    low, high = np.min([pair[0] for pair in corners], axis=0), np.max([pair[1] for pair in corners], axis=0)
    free = np.array(size) - 2 * MARGIN - [0, header + HEADING + FOOTER]
    scale = min(float((free / (high - low)).min()), LARGEST_RADIUS / float(seen.radii.max()))
    picture = scale * float(high[1] - low[1]) + 2 * MARGIN + HEADING
    layout = Layout.rounded(size[0], header, picture, FOOTER, scale, dots_per_inch).even()
    width, height = layout.pixels
    return layout, Frame.around((low, high), width, height - round(HEADING * dots_per_inch), layout.scale)


def _steps(failures: int, splits: bool, frames_per_second: float) -> list[Step]:
    """From the whole aggregate to the last failure and on to its fragments."""
    usual = 1 / frames_per_second
    counts = np.unique(np.linspace(0, failures, min(failures, MOST_STEPS) + 1).round().astype(int)).tolist()
    steps = [Step(count, 0.0, usual) for count in counts]
    steps[0] = Step(0, 0.0, max(START, usual))
    if failures:
        steps[-1] = Step(failures, 0.0, max(SPLIT, usual))
    if splits:
        shares = np.linspace(0, 1, PARTING_STEPS + 1)[1:].tolist()
        steps += [Step(failures, share, usual if share < 1 else max(END, usual)) for share in shares]
    return steps


def _played(
    figure: Figure,
    layout: Layout,
    frame: Frame,
    seen: Scene,
    breakup: Breakup,
    chart: Axes | None,
    steps: list[Step],
) -> Iterator[Step]:
    """Bring the figure to each step in turn."""
    box = layout.pixel_box(0, round(layout.footer * layout.dots_per_inch), frame.width, frame.height)
    axes = image_axes(figure, box, ghost(seen, frame))
    heading = write_heading(axes, "")
    marker = None if chart is None else chart.axvline(0.5, color=labels.INK, linewidth=0.8, clip_on=False)
    draw_sizes(axes, breakup)
    for step in steps:
        heading.set_text(_heading(breakup, step))
        shown: list[Artist] = []
        if step.progress:
            axes.images[0].set_data(pulled_apart(seen, frame, step.progress))
        elif step.failed:
            shown = [draw_discs(axes, seen, frame, step.failed), _latest(axes, seen, frame, step.failed - 1)]
        if marker is not None:
            marker.set_xdata([step.failed, step.failed])
            marker.set_visible(step.failed > 0)
        yield step
        for artist in shown:
            artist.remove()


def _latest(axes: Axes, seen: Scene, frame: Frame, failure: int) -> Artist:
    """Ring around a failed contact."""
    from matplotlib.patches import Circle

    x, y, _ = frame.pixels(seen.points[failure])
    radius = max(RING * frame.scale * float(seen.smaller_radii[failure]), SMALLEST_RING * axes.figure.dpi / 72)
    return axes.add_patch(Circle((x, y), radius, fill=False, color=labels.INK, linewidth=1.3))


def _heading(breakup: Breakup, step: Step) -> str:
    """What is seen at a step; the number that changes is last, so that no words move."""
    failures = breakup.failures
    if step.progress:
        return counted(len(breakup.fragments), "fragment")
    if not step.failed:
        return f"{counted(len(failures), 'contact')} will fail" if failures else "no contact fails at any rate"
    ratio = failures[step.failed - 1].rate / failures[0].rate
    return f"failure {step.failed} of {len(failures)}, rate / initiation rate = {ratio:.3g}"


def _write_gif(figure: Figure, film: Iterator[Step], file: str | PathLike[str] | IO[bytes]) -> None:
    """All pictures with the colours of the last ones, as Pillow keeps only what changes from one to the next."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from PIL import Image

    canvas: Any = FigureCanvasAgg(figure)
    pictures, durations = [], []
    for step in film:
        canvas.draw()
        pictures.append(Image.fromarray(np.asarray(canvas.buffer_rgba())[..., :3]))
        durations.append(round(1000 * step.seconds))
    palette = _palette(pictures)
    first, *others = (picture.quantize(palette=palette, dither=Image.Dither.NONE) for picture in pictures)
    first.save(file, format="GIF", save_all=True, append_images=others, duration=durations, loop=0, optimize=True)


def _palette(pictures: list[PillowImage]) -> PillowImage:
    """Few colours: some that are kept, others that suit the first picture, that at the last failure, and the last.

    White, fragments of few spheres and rare failures would otherwise take on the colour of what is more frequent.
    """
    from PIL import Image

    width, height = pictures[0].size
    chosen = [pictures[0], pictures[max(0, len(pictures) - PARTING_STEPS - 1)], pictures[-1]]
    montage = Image.new("RGB", (width, height * len(chosen)))
    for k, picture in enumerate(chosen):
        montage.paste(picture, (0, k * height))
    kept = np.round(255 * np.concatenate([np.ones((1, 3)), COLOURS, sequence_colours(FAILURE_COLOURS)]))
    count = PALETTE - len(kept)
    found = montage.quantize(count, dither=Image.Dither.NONE).convert("RGB").getcolors(count) or []
    fitting = np.array([colour for _, colour in found])
    apart = np.abs(fitting[:, None] - kept).max(axis=2).min(axis=1) > ALIKE
    palette = Image.new("P", (1, 1))
    palette.putpalette(np.concatenate([kept, fitting[apart]]).astype(int).ravel().tolist())
    return palette


def _write_mp4(
    figure: Figure, film: Iterator[Step], file: str | PathLike[str] | IO[bytes], rate: float, encoder: str
) -> None:
    import matplotlib
    from matplotlib.animation import FFMpegWriter

    writer = FFMpegWriter(fps=rate, codec="h264", extra_args=PLAYABLE)  # type: ignore[arg-type]  # fps may be a fraction
    with matplotlib.rc_context({"animation.ffmpeg_path": encoder}), writer.saving(figure, str(file), figure.dpi):
        for step in film:
            for _ in range(max(1, round(step.seconds * rate))):
                writer.grab_frame()
