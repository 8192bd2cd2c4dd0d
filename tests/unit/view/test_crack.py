"""The picture of a breakup."""

from dataclasses import replace
from io import BytesIO

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import EllipseCollection

import rheoclast as rc
from rheoclast.generation import random_packed_ball, straight_chain
from rheoclast.view import draw_crack, save
from rheoclast.view.crack import HEADING_WIDTH, _arrangement, sequence_colours
from rheoclast.view.fragments import COLOURS
from rheoclast.view.scene import scene

ALONG_X = rc.LinearFlow(np.diag([1.0, -0.5, -0.5]))


def broken(aggregate, flow=ALONG_X):
    response = rc.rigid_response(aggregate.spheres, rc.FreeDraining(), viscosity=1.0)
    return rc.break_up(aggregate, response, rc.Bonds(1.0, 0.8, 6e-3, 8e-3, tensile_strength=2.0), flow)


CHAIN = straight_chain(10)
BALL = random_packed_ball(80, seed=1)
CHAIN_BROKEN, BALL_BROKEN = broken(CHAIN), broken(BALL)


def pixels(figure):
    """(H, W, 3) from 0 to 1, row 0 at the top."""
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())[..., :3] / 255


def texts(figure):
    return [text.get_text() for text in figure.findobj(lambda artist: hasattr(artist, "get_text"))]


def panels(figure):
    return [axes for axes in figure.axes if axes.images and axes.images[0].get_array().ndim == 3]


def hues(image):
    """Share of red less that of blue at every pixel that is covered."""
    return (image[..., 0] - image[..., 2])[image[..., 3] > 0.99]


def test_ball_is_a_crack_of_many_contacts():
    """What the other tests of this module take for granted."""
    assert len(BALL_BROKEN.failures) > 10
    assert BALL_BROKEN.splits


def test_each_failed_contact_is_a_disc_where_it_was_in_the_colour_of_its_place():
    figure = draw_crack(BALL_BROKEN, view_direction=(0, 0, 1), dots_per_inch=80)
    axes = panels(figure)[0]
    (discs,) = axes.findobj(EllipseCollection)
    failed = [failure.contact for failure in BALL_BROKEN.failures]
    expected = sequence_colours(len(failed))
    order = [np.abs(expected - colour[:3]).sum(axis=1).argmin() for colour in discs.get_facecolors()]
    assert sorted(order) == list(range(len(failed)))
    drawn, true = discs.get_offsets(), BALL.contact_points[failed][order, :2]
    scale = np.ptp(drawn[:, 0]) / np.ptp(true[:, 0])
    assert drawn - drawn.mean(axis=0) == pytest.approx(scale * (true - true.mean(axis=0)), abs=1e-6 * scale)


def test_disc_of_a_contact_seen_from_the_side_is_narrow_along_its_normal():
    figure = draw_crack(CHAIN_BROKEN, view_direction=(0, 0, 1), dots_per_inch=80)
    axes = panels(figure)[0]
    FigureCanvasAgg(figure).draw()
    (discs,) = axes.findobj(EllipseCollection)
    corners = discs.get_paths()[0].vertices @ discs.get_transforms()[0][:2, :2].T
    assert np.ptp(corners[:, 0]) < 0.5 * np.ptp(corners[:, 1])


def test_first_failure_is_on_top_and_in_the_ring():
    axes = panels(draw_crack(BALL_BROKEN, dots_per_inch=80))[0]
    (discs,) = axes.findobj(EllipseCollection)
    assert discs.get_facecolors()[-1, :3] == pytest.approx(sequence_colours(len(BALL_BROKEN.failures))[0])
    assert axes.patches[-1].center == pytest.approx(discs.get_offsets()[-1])


def test_fragments_are_side_by_side_in_their_colours():
    figure = draw_crack(CHAIN_BROKEN, dots_per_inch=80)
    before, after = (np.asarray(axes.images[0].get_array()) for axes in panels(figure))
    expected = np.sign(COLOURS[:2, 0] - COLOURS[:2, 2])
    for image in (before, after):
        middle = image.shape[1] // 2
        assert np.sign(np.median(hues(image[:, :middle]))) == expected[0]
        assert np.sign(np.median(hues(image[:, middle:]))) == expected[1]
    covered = (after[..., 3] > 0).any(axis=0)
    assert not covered[after.shape[1] // 2]


def test_both_sides_of_a_failed_contact_are_marked():
    after = np.asarray(panels(draw_crack(CHAIN_BROKEN, dots_per_inch=80))[1].images[0].get_array())
    marked = (after[..., 2] - after[..., 1] > 0.25) & (after[..., 0] < 0.3)
    columns = np.flatnonzero(marked.any(axis=0))
    middle = after.shape[1] / 2
    assert (columns < middle).any()
    assert (columns > middle).any()
    assert np.abs(columns - middle).max() < after.shape[1] / 8


def test_long_aggregates_are_drawn_below_each_other_and_round_ones_beside():
    chain, ball = (
        [axes.get_position() for axes in panels(draw_crack(result, dots_per_inch=80))]
        for body, result in ((CHAIN, CHAIN_BROKEN), (BALL, BALL_BROKEN))
    )
    assert chain[0].y0 > chain[1].y1
    assert ball[0].x1 <= ball[1].x0 + 1e-9
    assert ball[0].y1 == pytest.approx(ball[1].y1)


def test_whole_aggregate_has_one_panel_and_says_so():
    pressed = broken(CHAIN, rc.LinearFlow(np.diag([-1.0, 0.5, 0.5])))
    figure = draw_crack(pressed, dots_per_inch=80)
    assert len(panels(figure)) == 1
    assert "no contact fails at any rate" in texts(figure)
    assert np.ptp(pixels(figure), axis=2).max() < 0.15


@pytest.mark.parametrize("width", [7.0, 8.0, 14.0])
def test_panels_beside_each_other_are_wide_enough_for_their_headings(width):
    lengths = np.array([[1.0, 1.0], [6.0, 3.0]])
    scale, beside = _arrangement(lengths, np.array([width, 6.0]), 1e3)
    narrowest = width / 2 + scale * (1.0 - 3.5)
    assert narrowest >= HEADING_WIDTH - 1e-9 if beside else scale * 6 < width
    assert beside == (width > 8)


def test_rates_and_sizes_are_told():
    shown = texts(draw_crack(BALL_BROKEN, title="Ball", dots_per_inch=80))
    ratio = max(failure.rate for failure in BALL_BROKEN.failures) / BALL_BROKEN.failures[0].rate
    assert any(text.startswith(f"{len(BALL_BROKEN.failures)} failed contacts") for text in shown)
    assert any(text.endswith(f"1/s, split at {ratio:.3g} times that") for text in shown)
    assert {"Ball", "rate / initiation rate", "first failure"} <= set(shown)
    assert {str(len(BALL_BROKEN.spheres[0])), f"{len(BALL_BROKEN.spheres[1])} spheres"} <= set(shown)


def test_a_crack_that_runs_at_once_is_told():
    """Later failures at lower rates than the first; and a tree, which one failure splits."""
    falling = replace(
        BALL_BROKEN, failures=tuple(replace(each, rate=1 / (k + 1)) for k, each in enumerate(BALL_BROKEN.failures))
    )
    assert any(text.endswith("1/s, and splits at once") for text in texts(draw_crack(falling, dots_per_inch=80)))


def test_chart_shows_the_rate_of_every_failure():
    figure = draw_crack(BALL_BROKEN, dots_per_inch=80)
    chart = next(axes for axes in figure.axes if axes.get_title() == "rate / initiation rate")
    rates = np.array([failure.rate for failure in BALL_BROKEN.failures])
    assert chart.lines[0].get_ydata() == pytest.approx(rates / rates[0])


def test_dimensionless_rates_have_no_unit():
    shown = texts(draw_crack(CHAIN_BROKEN, length_unit=None, dots_per_inch=80))
    assert not any("1/s" in text for text in shown)


@pytest.mark.parametrize(("body", "size"), [("chain", (7.0, 3.5)), ("ball", (7.0, 3.5)), ("ball", (9.6, 5.6))])
def test_no_text_is_cut_off(body, size):
    breakup = CHAIN_BROKEN if body == "chain" else BALL_BROKEN
    figure = draw_crack(breakup, flow=ALONG_X, size=size, title="Title", dots_per_inch=80)
    height, width, _ = pixels(figure).shape
    for text in figure.findobj(lambda artist: hasattr(artist, "get_window_extent") and hasattr(artist, "get_text")):
        if text.get_text() and text.get_visible():
            box = text.get_window_extent()
            assert box.x0 >= 0
            assert box.y0 >= 0
            assert box.x1 <= width
            assert box.y1 <= height


@pytest.mark.parametrize("size", [(7.0, 3.5), (7.0, 7.0), (9.6, 5.6)])
@pytest.mark.parametrize("direction", [None, (0, 0, 1), (1, 0, 0)])
def test_headings_do_not_run_into_each_other(size, direction):
    figure = draw_crack(BALL_BROKEN, view_direction=direction, size=size, dots_per_inch=60)
    pixels(figure)
    before, after = panels(figure)
    ends = [text.get_window_extent() for text in before.texts if text.get_text() != "first failure"]
    starts = [text.get_window_extent() for text in after.texts]
    assert not any(end.overlaps(start) for end in ends for start in starts)


def test_second_fragment_is_to_the_right_of_the_largest():
    seen = scene(BALL_BROKEN, None)
    first, second = (seen.centers[spheres] for spheres in BALL_BROKEN.spheres[:2])
    line = second.mean(axis=0) - first.mean(axis=0)
    assert line == pytest.approx([np.linalg.norm(line), 0, 0], abs=1e-6)
    assert np.linalg.det(seen.axes) == pytest.approx(1)


def test_two_spheres_have_a_picture():
    pair = straight_chain(2)
    assert "1 sphere" in texts(draw_crack(broken(pair), dots_per_inch=80))
    stream = BytesIO()
    save(draw_crack(broken(pair), dots_per_inch=80), stream)
    assert stream.getvalue().startswith(b"\x89PNG")


def test_wrong_arguments_are_refused_in_one_sentence():
    with pytest.raises(TypeError, match=r"^breakup: expected Breakup, got int; make one with break_up"):
        draw_crack(3)
    with pytest.raises(ValueError, match=r"^size: expected at least 7 by 3\.5 inches, got 4 by 4$"):
        draw_crack(CHAIN_BROKEN, size=(4, 4))
