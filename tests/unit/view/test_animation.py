"""The animated picture of a breakup."""

from io import BytesIO

import numpy as np
import pytest
from matplotlib.animation import FFMpegWriter
from PIL import Image

import rheoclast as rc
from rheoclast.generation import random_packed_ball, straight_chain
from rheoclast.view import animate_crack
from rheoclast.view.animation import END, MOST_STEPS, PARTING_STEPS, SPLIT, START, Step, _heading, _steps

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
    assert _heading(breakup, Step(1, 0.0, 1.0)) == f"failure 1 of {count}, at the initiation rate"
    assert _heading(breakup, Step(10, 0.0, 1.0)) == f"failure 10 of {count}, at {ratio:.3g} times the initiation rate"
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
    assert 50_000 < path.stat().st_size < 300_000


def test_ending_of_the_file_is_checked(tmp_path):
    with pytest.raises(ValueError, match=r"^file: expected a path that ends in \.gif or \.mp4, got '.*chain\.avi'$"):
        animate_crack(CHAIN_BROKEN, tmp_path / "chain.avi")


def test_missing_ffmpeg_is_said(tmp_path, monkeypatch):
    monkeypatch.setattr(FFMpegWriter, "isAvailable", classmethod(lambda cls: False))
    with pytest.raises(
        RuntimeError, match=r"^file: an \.mp4 needs the program ffmpeg, which is not found; install it or"
    ):
        animate_crack(CHAIN_BROKEN, tmp_path / "chain.mp4")


@pytest.mark.skipif(not FFMpegWriter.isAvailable(), reason="needs ffmpeg")
def test_mp4_is_written(tmp_path):
    path = tmp_path / "chain.mp4"
    animate_crack(CHAIN_BROKEN, path, dots_per_inch=60)
    assert path.read_bytes()[4:8] == b"ftyp"
