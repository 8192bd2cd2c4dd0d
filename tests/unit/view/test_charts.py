"""Charts show the numbers that they are given."""

import numpy as np
import pytest

import rheoclast as rc
from rheoclast import view
from rheoclast.generation import cluster_cluster, straight_chain


def axes_of(figure):
    (axes,) = figure.axes
    return axes


def test_histogram_counts_every_contact_once():
    values = 1e-9 * np.random.default_rng(1).normal(size=500)
    axes = axes_of(view.draw_load_distribution(values))
    assert sum(bar.get_height() for bar in axes.patches) == 500
    assert axes.get_xlabel() == "tension (nN)"
    reds = {bar.get_facecolor() for bar in axes.patches if bar.get_height() and bar.get_x() >= -1e-9}
    blues = {bar.get_facecolor() for bar in axes.patches if bar.get_height() and bar.get_x() < -1e-9}
    assert len(reds) == len(blues) == 1
    assert reds.isdisjoint(blues)


def test_histogram_of_equal_and_of_no_loads():
    for value in (0.0, 3.0):
        bars = axes_of(view.draw_load_distribution(np.full(7, value), unit=None)).patches
        assert sum(bar.get_height() for bar in bars) == 7


def test_histogram_spans_what_there_is():
    for sign, limits in ((1, (0, 2)), (-1, (-2, 0))):
        bars = axes_of(view.draw_load_distribution(sign * np.linspace(0.5, 2, 20), unit=None)).patches
        ends = [bar.get_x() for bar in bars] + [bar.get_x() + bar.get_width() for bar in bars]
        assert (min(ends), max(ends)) == pytest.approx(limits)


def test_counts_are_logarithmic_only_where_one_bar_dwarfs_the_others():
    rare = np.append(np.full(5000, 0.1), np.linspace(-10, 10, 40))
    assert axes_of(view.draw_load_distribution(rare)).get_yscale() == "log"
    assert axes_of(view.draw_load_distribution(np.linspace(-10, 10, 5000))).get_yscale() == "linear"


def test_counts_are_marked_at_whole_numbers():
    ticks = axes_of(view.draw_load_distribution([1.0, 2.0, 2.0])).get_yticks()
    np.testing.assert_array_equal(ticks, np.round(ticks))


def tick_boxes(axis):
    """Extents of the labels that are seen, in pixels."""
    axis.figure.draw_without_rendering()
    low, high = sorted(axis.get_view_interval())
    ticks = [*axis.get_major_ticks(), *axis.get_minor_ticks()]
    return [
        tick.label1.get_window_extent() for tick in ticks if tick.label1.get_text() and low <= tick.get_loc() <= high
    ]


@pytest.mark.parametrize("ratio", [1, 1.05, 3, 12, 99, 1e3, 1e5])
def test_numbers_on_logarithmic_axes_do_not_run_into_each_other(ratio):
    values = 2e-6 * np.geomspace(1, ratio, 30)
    axes = axes_of(view.draw_critical_rates(values, 1e10 * values))
    for axis in (axes.xaxis, axes.yaxis):
        boxes = tick_boxes(axis)
        assert len(boxes) >= 2
        assert not any(box.overlaps(other) for k, box in enumerate(boxes) for other in boxes[:k])


def test_dots_of_very_many_points_are_small_and_rasterized():
    radii = np.geomspace(1, 10, 20_000)
    few, many = (axes_of(view.draw_critical_rates(each, each)).lines[0] for each in (radii[::2000], radii))
    assert many.get_markersize() < 0.6 * few.get_markersize()
    assert many.get_rasterized()
    assert not few.get_rasterized()


def test_long_names_are_not_cut_off():
    quantity = "tension over the strength of the weakest contact of each aggregate of the whole ensemble"
    halves = rc.fragment_distribution([[1, 1]] * 30, bins=4)
    names = [f"a family of aggregates with a name that is rather long for the legend of a chart {k}" for k in range(6)]
    for figure in (
        view.draw_load_distribution([1.0, 2.0], quantity=quantity, unit=None),
        view.draw_load_against_position(straight_chain(3), [1.0, 2.0], quantity=quantity[:75], unit=None),
        view.draw_fragment_distributions(dict.fromkeys(names, halves)),
    ):
        figure.draw_without_rendering()
        axes = axes_of(figure)
        legend = axes.get_legend()
        texts = [axes.xaxis.label, axes.yaxis.label, *(legend.get_texts() if legend else [])]
        for text in texts:
            box = text.get_window_extent()
            assert min(box.x0, box.y0) >= 0
            assert box.x1 <= figure.bbox.x1
            assert box.y1 <= figure.bbox.y1


def test_legend_of_distributions_is_above_them():
    halves = rc.fragment_distribution([[1, 1]] * 30, bins=4)
    figure = view.draw_fragment_distributions(dict.fromkeys(("one", "two", "three"), halves))
    figure.draw_without_rendering()
    axes = axes_of(figure)
    assert axes.get_legend().get_window_extent().y0 >= axes.get_window_extent().y1 - 1
    heights = {text.get_window_extent().y0 // 3 for text in axes.get_legend().get_texts()}
    assert len(heights) == 1


def test_load_against_position():
    aggregate = cluster_cluster(100, radius=1.0, seed=1)
    values = np.linspace(-2e-6, 5e-6, 99)
    axes = axes_of(view.draw_load_against_position(aggregate, values, quantity="shear"))
    points = axes.collections[0].get_offsets()
    np.testing.assert_allclose(points[:, 0], rc.radial_position(aggregate, aggregate.contact_points))
    np.testing.assert_allclose(points[:, 1], 1e6 * values)
    assert axes.get_ylabel() == "shear (µN)"
    assert np.average(axes.lines[-1].get_ydata()) == pytest.approx(1e6 * values.mean(), rel=0.1)


def test_critical_rates_with_their_law():
    gyrations = 1e-6 * np.geomspace(1, 10, 8)
    rates = 3e-7 * gyrations**-1.9
    axes = axes_of(view.draw_critical_rates(gyrations, rates, rc.power_law(gyrations, rates)))
    np.testing.assert_allclose(axes.lines[0].get_xydata(), np.stack([1e6 * gyrations, rates], axis=1))
    np.testing.assert_allclose(axes.lines[1].get_ydata(), rates[[0, -1]])
    assert "exponent −1.90" in axes.get_legend().get_texts()[0].get_text()
    assert axes.get_xscale() == axes.get_yscale() == "log"
    assert not view.draw_critical_rates(gyrations, rates).axes[0].get_legend()


def test_fragment_distributions():
    halves = rc.fragment_distribution([[1, 1]] * 30, bins=4)
    thirds = rc.fragment_distribution([[1, 2]] * 30, bins=4)
    axes = axes_of(view.draw_fragment_distributions({"halves": halves, "thirds": thirds}))
    np.testing.assert_allclose(axes.lines[0].get_ydata(), [0, 0, 8, 0])
    np.testing.assert_allclose(axes.lines[1].get_ydata(), [0, 4, 4, 0])
    legend = axes.get_legend()
    assert [text.get_text() for text in legend.get_texts()] == ["halves", "thirds"]
    assert [handle.get_color() for handle in legend.legend_handles] == [line.get_color() for line in axes.lines]


def test_convergence_is_the_difference_from_the_highest_order():
    aggregate, flow = straight_chain(4), rc.uniaxial_extension(1.0).rotated(rc.random_orientations(1, 1)[0])
    response = rc.rigid_response(aggregate.spheres, rc.StokesianDynamics(4, solver=rc.DenseCholesky()), 1.0)
    table = rc.contact_response(aggregate, response)
    axes = axes_of(view.draw_convergence(table, flow))
    tension = axes.lines[0]
    assert tension.get_xdata().tolist() == [1, 2, 3]
    exact, coarse = table.loads(flow).tension, table.coarser.loads(flow).tension
    assert tension.get_ydata()[-1] == pytest.approx(np.linalg.norm(coarse - exact) / np.linalg.norm(exact))
    assert [line.get_label() for line in axes.lines] == ["tension", "shear", "bending"]  # nothing twists a chain


def test_refusals():
    chain = straight_chain(3)
    with pytest.raises(ValueError, match=r"^values: expected at least one contact, got none$"):
        view.draw_load_distribution([])
    with pytest.raises(ValueError, match=r"^values: expected one per contact \(2\), got 3$"):
        view.draw_load_against_position(chain, [1, 2, 3])
    with pytest.raises(ValueError, match=r"^distributions: expected one to 6, got 0; draw them in several charts$"):
        view.draw_fragment_distributions({})
    table = rc.contact_response(chain, rc.rigid_response(chain.spheres, rc.FreeDraining(), 1.0))
    with pytest.raises(ValueError, match=r"^table: expected hydrodynamics of order 2 or higher"):
        view.draw_convergence(table, rc.simple_shear(1.0))
