"""The animated picture of a breakup."""

import sys
from dataclasses import replace
from io import BytesIO
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image

import rheoclast as rc
from rheoclast.generation import random_packed_ball, straight_chain
from rheoclast.view import animate_crack
from rheoclast.view.animation import END, MOST_STEPS, PARTING_STEPS, SPLIT, START, Step, _ffmpeg, _heading, _steps
from rheoclast.view.fragments import COLOURS

ALONG_X = rc.LinearFlow(np.diag([1.0, -0.5, -0.5]))


def broken(aggregate, flow=ALONG_X):
    response = rc.rigid_response(aggregate.spheres, rc.FreeDraining(), viscosity=1.0)
    return rc.break_up(aggregate, response, rc.Bonds(1.0, 0.8, 6e-3, 8e-3, tensile_strength=2.0), flow)


CHAIN = straight_chain(6)
BALL = random_packed_ball(80, seed=1)
CHAIN_BROKEN = broken(CHAIN)


def frames(stream):
    """Pictures (T, H, W, 3) from 0 to 255 and their durations in s."""
    with Image.open(stream) as film:
        pictures, durations = [], []
        for k in range(film.n_frames):
            film.seek(k)
            pictures.append(np.asarray(film.convert("RGB"), dtype=int))
            durations.append(film.info["duration"] / 1000)
    return np.array(pictures), durations


def animated(aggregate, breakup, **arguments):
    stream = BytesIO()
    animate_crack(breakup, stream, size=(4.5, 3.5), dots_per_inch=60, **arguments)
    return frames(stream)


def test_contact_fails_and_then_the_fragments_part():
    pictures, durations = animated(CHAIN, CHAIN_BROKEN, flow=ALONG_X, frames_per_second=10)
    assert len(pictures) == 2 + PARTING_STEPS
    assert durations == pytest.approx([START, SPLIT, *[0.1] * (PARTING_STEPS - 1), END])
    dark = (pictures.sum(axis=3) < 250)[:, 60:150].sum(axis=(1, 2))
    assert dark[1] > dark[0] + 20
    row = pictures.shape[1] * 2 // 5
    coloured = np.ptp(pictures[:, row - 10 : row + 10], axis=3).max(axis=1) > 12
    assert coloured[1].sum() < coloured[-1].sum() + coloured.shape[1] // 10
    extents = [np.ptp(np.flatnonzero(line)) for line in coloured]
    assert extents[-1] > extents[1] + 10
    assert (np.diff(extents[1:]) >= 0).all()


@pytest.mark.parametrize("failures", [0, 1, 2, 59, 60, 61, 5000])
def test_all_failures_are_shown_in_few_steps(failures):
    steps = _steps(failures, True, 8.0)
    counts = [step.failed for step in steps if not step.progress]
    assert counts[0] == 0
    assert counts[-1] == failures
    assert len(counts) == min(failures, MOST_STEPS) + 1
    assert (np.diff(counts) >= 1).all()
    assert [step.progress for step in steps][-1] == 1


def test_what_does_not_split_does_not_part():
    assert all(step.progress == 0 for step in _steps(7, False, 8.0))


def test_heading_tells_the_rate_over_that_of_the_first():
    breakup = broken(BALL)
    ratio = breakup.failures[9].rate / breakup.failures[0].rate
    count = len(breakup.failures)
    assert _heading(breakup, Step(0, 0.0, 1.0)) == f"{count} contacts will fail"
    assert _heading(breakup, Step(1, 0.0, 1.0)) == f"failure 1 of {count}, rate / initiation rate = 1"
    assert _heading(breakup, Step(10, 0.0, 1.0)) == f"failure 10 of {count}, rate / initiation rate = {ratio:.3g}"
    assert _heading(breakup, Step(count, 0.5, 1.0)) == f"{len(breakup.fragments)} fragments"


def test_whole_aggregate_is_one_picture():
    pressed = broken(CHAIN, rc.LinearFlow(np.diag([-1.0, 0.5, 0.5])))
    stream = BytesIO()
    animate_crack(pressed, stream, dots_per_inch=60)
    with Image.open(stream) as film:
        assert film.n_frames == 1
    assert _heading(pressed, Step(0, 0.0, 1.0)) == "no contact fails at any rate"


def test_film_of_300_spheres_is_a_small_file(tmp_path):
    ball = random_packed_ball(300, seed=1)
    path = tmp_path / "ball.gif"
    animate_crack(broken(ball), path, flow=ALONG_X)
    assert 50_000 < path.stat().st_size < 350_000


def test_colours_of_small_fragments_and_white_are_kept():
    """One sphere breaks off a straight chain of 40; the legend above tells its colour, and the edge is white."""
    chain = straight_chain(40)
    last = replace(CHAIN_BROKEN.failures[0], contact=38, pair=(38, 39))
    broken_off = replace(CHAIN_BROKEN, aggregate=chain, failures=(last,), spheres=(np.arange(39), np.array([39])))
    pictures, _ = animated(chain, broken_off)
    for colour in COLOURS[:2]:
        assert np.abs(pictures[1, :40] - 255 * colour).max(axis=-1).min() <= 2
    assert (pictures[:, :, 0] == 255).all()


def test_ending_of_the_file_is_checked(tmp_path):
    with pytest.raises(ValueError, match=r"^file: expected a path that ends in \.gif or \.mp4, got '.*chain\.avi'$"):
        animate_crack(CHAIN_BROKEN, tmp_path / "chain.avi")


@pytest.mark.parametrize("dots_per_inch", [60, 61, 62.3])
def test_width_and_height_are_even_and_not_larger_than_asked(dots_per_inch):
    stream = BytesIO()
    animate_crack(CHAIN_BROKEN, stream, size=(4.5, 3.5), dots_per_inch=dots_per_inch)
    with Image.open(stream) as film:
        assert np.array(film.size) % 2 == pytest.approx(0)
        assert film.width in (round(4.5 * dots_per_inch), round(4.5 * dots_per_inch) - 1)
        assert film.height <= 3.5 * dots_per_inch + 1


@pytest.fixture
def no_package(monkeypatch):
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)


def test_missing_ffmpeg_is_said(tmp_path, monkeypatch, no_package):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(
        RuntimeError,
        match=r"^file: an \.mp4 needs the program ffmpeg, which is not found; "
        r'install it by `pip install "rheoclast\[film\]"`, or put one on the PATH, or write a \.gif$',
    ):
        animate_crack(CHAIN_BROKEN, tmp_path / "chain.mp4")
    assert not list(tmp_path.iterdir())


@pytest.mark.skipif(sys.platform == "win32", reason="a program of Windows has another name")
def test_ffmpeg_of_the_package_comes_before_the_one_on_the_path(tmp_path, monkeypatch, no_package):
    program = tmp_path / "ffmpeg"
    program.touch(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    assert _ffmpeg() == str(program)
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", SimpleNamespace(get_ffmpeg_exe=lambda: "packaged"))
    assert _ffmpeg() == "packaged"


@pytest.mark.filterwarnings("ignore:unclosed file:ResourceWarning")  # the reader of imageio-ffmpeg leaves its pipes
@pytest.mark.parametrize("dots_per_inch", [60, 61])
def test_mp4_shows_what_the_gif_shows(tmp_path, dots_per_inch):
    """Each step as often as it lasts, in what every browser plays; compressed colours differ by a few of 255."""
    reader = pytest.importorskip("imageio_ffmpeg", reason="needs imageio-ffmpeg to read the film")
    arguments = {"size": (4.5, 3.5), "dots_per_inch": dots_per_inch, "flow": ALONG_X, "frames_per_second": 10}
    path, stream = tmp_path / "chain.mp4", BytesIO()
    animate_crack(CHAIN_BROKEN, path, **arguments)
    animate_crack(CHAIN_BROKEN, stream, **arguments)
    pictures, durations = frames(stream)
    expected = pictures.repeat(np.round(10 * np.array(durations)).astype(int), axis=0)

    film = reader.read_frames(path)
    about = next(film)
    assert about["codec"] == "h264"
    assert about["pix_fmt"].startswith("yuv420p")
    assert about["fps"] == 10
    assert about["duration"] == pytest.approx(sum(durations), abs=0.05)
    assert about["size"] == (pictures.shape[2], pictures.shape[1])
    shown = np.array([np.frombuffer(each, dtype=np.uint8).reshape(pictures.shape[1:]) for each in film])
    assert shown.shape == expected.shape
    difference = np.abs(shown - expected).mean(axis=(1, 2, 3))
    assert difference.max() < 2
    assert np.abs(shown[-1] - expected[0]).mean() > 2 * difference.max()
    assert path.stat().st_size < 60_000
