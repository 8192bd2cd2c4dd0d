"""The picture of fragments side by side."""

from dataclasses import replace

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.generation import straight_chain
from rheoclast.view import draw_fragments
from rheoclast.view.fragments import COLOURS, REST, fragment_colours

CHAIN = straight_chain(60)
ALONG_X = rc.LinearFlow(np.diag([1.0, -0.5, -0.5]))


def cut(*sizes):
    """Breakup of a chain into pieces of given sizes, the largest first."""
    chain = straight_chain(sum(sizes))
    response = rc.rigid_response(chain.spheres, rc.FreeDraining(), viscosity=1.0)
    breakup = rc.break_up(chain, response, rc.Bonds(1.0, 0.8, 6e-3, 8e-3, tensile_strength=2.0), ALONG_X)
    ends = np.cumsum(sizes)
    failures = tuple(
        replace(breakup.failures[0], contact=int(end) - 1, pair=(int(end) - 1, int(end))) for end in ends[:-1]
    )
    return replace(breakup, failures=failures, spheres=tuple(np.split(np.arange(sum(sizes)), ends[:-1])))


def captions(figure):
    return [text.get_text() for text in figure.texts]


def pictures(figure):
    return [axes for axes in figure.axes if axes.images]


@pytest.mark.parametrize("sizes", [(5, 1), (9, 7, 3), (4,) * 11])
def test_every_fragment_is_drawn_with_its_size(sizes):
    figure = draw_fragments(cut(*sizes), dots_per_inch=80)
    assert captions(figure) == [f"{size} sphere{'s' * (size > 1)}" for size in sizes]
    assert len(pictures(figure)) == len(sizes)


def test_all_fragments_have_one_scale():
    """A chain of n spheres is n times as long as one sphere."""
    figure = draw_fragments(cut(6, 4, 1))
    lengths = [(np.asarray(axes.images[0].get_array())[..., 3] > 0.5).any(axis=0).sum() for axes in pictures(figure)]
    assert np.array(lengths) / lengths[-1] == pytest.approx([6, 4, 1], rel=0.02)


@pytest.mark.parametrize("sizes", [(9, 7, 3), (2,) * 11, (30, 2, 2, 2, 1, 1)])
def test_pictures_stand_apart_within_the_figure(sizes):
    figure = draw_fragments(cut(*sizes), dots_per_inch=80, title="Pieces")
    boxes = [axes.get_position() for axes in pictures(figure)]
    for k, box in enumerate(boxes):
        assert box.x0 >= 0
        assert box.y0 >= 0
        assert box.x1 <= 1
        assert box.y1 <= 1
        assert not any(box.overlaps(other) for other in boxes[:k])
    assert figure.get_figheight() <= 6.0 + 0.02


def test_of_very_many_the_largest_are_drawn_and_the_rest_counted():
    figure = draw_fragments(cut(3, *[2] * 29), dots_per_inch=80)
    assert len(pictures(figure)) == 24
    assert "and 6 more, of at most 2 spheres" in captions(figure)


def test_largest_few_have_colours_and_the_rest_are_grey():
    colours = fragment_colours(cut(6, 5, 4, 3, 2, 1))
    assert colours[[0, 6, 11, 15]] == pytest.approx(COLOURS)
    assert colours[18:] == pytest.approx(np.tile(REST, (3, 1)))


def test_colours_are_told_apart_without_red_or_green():
    """Luminance and blue are what is left to the red- and green-blind: they must differ between all pairs."""
    seen = np.column_stack([COLOURS @ [0.2126, 0.7152, 0.0722], COLOURS[:, 2]])
    for k, one in enumerate(seen):
        assert all(np.linalg.norm(one - other) > 0.07 for other in seen[:k])


def test_aggregate_that_does_not_split_is_grey():
    assert fragment_colours(cut(4)) == pytest.approx(np.tile(REST, (4, 1)))
    assert captions(draw_fragments(cut(4), dots_per_inch=80)) == ["4 spheres"]


def test_wrong_arguments_are_refused_in_one_sentence():
    with pytest.raises(TypeError, match=r"^breakup: expected Breakup, got Aggregate; make one with break_up"):
        draw_fragments(CHAIN)
    with pytest.raises(ValueError, match=r"^size: expected at least 3 by 2 inches, got 1 by 1$"):
        draw_fragments(cut(2, 1), size=(1, 1))
