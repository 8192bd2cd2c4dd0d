"""Histories of the velocity gradient: straight lines between instants, and what is refused."""

import dataclasses

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.histories import GradientHistory, traceless


def history(count=7, seed=1):
    rng = np.random.default_rng(seed)
    return GradientHistory(np.cumsum(rng.uniform(0.1, 1.0, count)), traceless(rng.normal(size=(count, 3, 3))))


def test_samples_are_kept_and_cannot_be_changed():
    given = np.array([np.diag([1.0, 1.0, -2.0]), np.zeros((3, 3))])
    path = GradientHistory([0.0, 2.0], given)
    given[0] = 7.0
    np.testing.assert_array_equal(path.gradients[0], np.diag([1.0, 1.0, -2.0]))
    assert not path.times.flags.writeable
    assert not path.gradients.flags.writeable
    assert len(path) == 2
    assert path.duration == 2.0
    with pytest.raises(dataclasses.FrozenInstanceError):
        path.times = np.zeros(2)


def test_gradient_runs_straight_from_sample_to_sample():
    """At the instants the samples; at a quarter of an interval three quarters of one sample and one of the next."""
    path = history()
    np.testing.assert_allclose(path.gradient(path.times), path.gradients, rtol=1e-15)
    quarter = 0.75 * path.times[:-1] + 0.25 * path.times[1:]
    np.testing.assert_allclose(
        path.gradient(quarter), 0.75 * path.gradients[:-1] + 0.25 * path.gradients[1:], atol=1e-14
    )


def test_shapes_of_times_are_kept():
    path = history()
    times = np.linspace(path.times[0], path.times[-1], 12).reshape(3, 4)
    assert path.gradient(times).shape == (3, 4, 3, 3)
    assert path.strain_rate(times).shape == (3, 4, 3, 3)
    assert path.magnitude(times).shape == (3, 4)
    assert path.gradient(times[1, 2]).shape == (3, 3)
    np.testing.assert_array_equal(path.gradient(times)[1, 2], path.gradient(times[1, 2]))
    assert path.gradient([]).shape == (0, 3, 3)


def test_flow_at_a_time_agrees_with_the_vectorised_quantities():
    path = history()
    time = 0.5 * (path.times[2] + path.times[3]) + 0.01
    flow = path.flow(time)
    np.testing.assert_allclose(flow.gradient, path.gradient(time), atol=1e-15)
    np.testing.assert_allclose(path.strain_rate(time), flow.strain_rate, atol=1e-15)
    assert path.magnitude(time) == pytest.approx(flow.magnitude, rel=1e-14)


def test_flow_where_the_gradient_passes_through_zero():
    """What is left there is rounding, whose trace is as large as itself."""
    gradient = traceless(np.random.default_rng(3).normal(size=(3, 3)))
    path = GradientHistory([0.0, 0.3], [gradient, -gradient])
    for time in (0.15, np.nextafter(0.15, 0), np.nextafter(0.15, 1)):
        assert path.flow(time).magnitude < 1e-14


@pytest.mark.parametrize("time", [-0.1, 2.1, np.nan])
def test_times_outside_the_span_are_refused(time):
    path = GradientHistory([0.0, 2.0], np.zeros((2, 3, 3)))
    with pytest.raises(ValueError, match=r"times: expected times from 0 to 2 s, which the history spans, got"):
        path.gradient([1.0, time])


def test_rounding_at_the_ends_is_no_step_outside():
    path = history()
    for end, inside in ((path.times[-1], np.inf), (path.times[0], -np.inf)):
        np.testing.assert_array_equal(path.gradient(np.nextafter(end, inside)), path.gradient(end))


def test_dissipation_of_steady_shear_is_viscosity_times_rate_squared():
    path = GradientHistory([0.0, 1.0, 5.0], np.tile(rc.simple_shear(3.0).gradient, (3, 1, 1)))
    assert path.dissipation(2e-6) == pytest.approx(2e-6 * 9.0, rel=1e-14)


def test_dissipation_weighs_instants_by_time():
    """A shear rate of 2/s for a long time and 0 at the end of a short last interval."""
    shear = rc.simple_shear(2.0).gradient
    path = GradientHistory([0.0, 98.0, 100.0], [shear, shear, 0 * shear])
    assert path.dissipation(1.0) == pytest.approx(4.0 * (98 + 1) / 100, rel=1e-14)


def test_scaling_keeps_the_strain_that_builds_up():
    """The same deformation in a time divided by the factor: gradient times time stays."""
    path, fast = history(), history().scaled(4.0)
    np.testing.assert_allclose(fast.times, path.times / 4)
    np.testing.assert_allclose(fast.gradient(path.times / 4), 4 * path.gradient(path.times), atol=1e-13)
    assert fast.dissipation(1e-6) == pytest.approx(16 * path.dissipation(1e-6), rel=1e-13)
    with pytest.raises(ValueError, match="factor: expected a positive number, got 0"):
        path.scaled(0.0)


class TestTrace:
    noisy = np.diag([1.0, 2.0, -2.97]) * np.array([1.0, -2.0])[:, None, None]

    def test_is_refused_by_default(self):
        with pytest.raises(
            ValueError, match=r"gradients\[1\]: expected zero trace .* got 0.06 1/s, 0.01 of the largest entry; check"
        ):
            GradientHistory([0.0, 1.0], self.noisy)

    def test_is_taken_from_the_diagonal_on_request(self):
        path = GradientHistory([0.0, 1.0], self.noisy, tolerance=0.011)
        np.testing.assert_allclose(path.gradients[0], np.diag([0.99, 1.99, -2.98]), atol=1e-15)
        np.testing.assert_allclose(np.trace(path.gradients, axis1=1, axis2=2), 0, atol=1e-15)

    def test_above_the_tolerance_is_refused(self):
        with pytest.raises(ValueError, match="pass a tolerance above this fraction"):
            GradientHistory([0.0, 1.0], self.noisy, tolerance=0.009)

    def test_of_rounding_passes(self):
        gradients = np.random.default_rng(2).normal(size=(50, 3, 3))
        gradients[:, 2, 2] = -gradients[:, 0, 0] - gradients[:, 1, 1]
        GradientHistory(np.arange(50.0), 1e5 * gradients)

    def test_tolerance_is_not_negative(self):
        with pytest.raises(ValueError, match="tolerance: expected zero or a positive number, got -1"):
            GradientHistory([0.0, 1.0], self.noisy, tolerance=-1.0)


@pytest.mark.parametrize(
    ("times", "gradients", "message"),
    [
        ([0.0], np.zeros((1, 3, 3)), "times: expected at least two instants, got 1"),
        ([0.0, 1.0, 1.0], np.zeros((3, 3, 3)), r"times\[2\]: expected a time after 1 s, the instant before, got 1 s"),
        ([0.0, 2.0, 1.0], np.zeros((3, 3, 3)), r"times\[2\]: expected a time after 2 s, .* got 1 s; sort the instants"),
        ([0.0, np.inf], np.zeros((2, 3, 3)), r"times\[1\]: expected a finite number, got inf"),
        ([0.0, 1.0], np.full((2, 3, 3), np.nan), r"gradients\[0, 0, 0\]: expected a finite number, got nan"),
        ([0.0, 1.0], np.zeros((3, 3, 3)), r"gradients: expected shape \(2, 3, 3\), got \(3, 3, 3\)"),
        ([0.0, 1.0], np.zeros((2, 9)), r"gradients: expected shape \(2, 3, 3\), got \(2, 9\)"),
        (
            [0.0, 1.0],
            1e101 * np.tile(np.diag([1, 1, -2.0]), (2, 1, 1)),
            r"expected rates up to 1e\+100 1/s, got 2e\+101; check",
        ),
    ],
)
def test_bad_samples_are_refused(times, gradients, message):
    with pytest.raises(ValueError, match=message):
        GradientHistory(times, gradients)
