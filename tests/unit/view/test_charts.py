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
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["halves", "thirds"]


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
