"""Trajectories: shapes, axes, units, changing flows, and what is refused."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import rheoclast as rc
from rheoclast.histories import GradientHistory
from rheoclast.hydrodynamics.trajectory import Gradients, trajectory
from rheoclast.vectors import STRAIN_BASIS

GRADIENT = np.array([[0.3, 1.1, -0.4], [0.2, -0.9, 0.7], [-1.3, 0.5, 0.6]])
FLOW = rc.LinearFlow(GRADIENT, rate=2.5)
START = Rotation.random(random_state=2)


class Samples:
    """Gradients linear between samples, by NumPy's own interpolation of every entry."""

    def __init__(self, times, gradients):
        self.times, self.gradients = np.asarray(times), np.asarray(gradients)

    def gradient(self, times):
        columns = [np.interp(times, self.times, column) for column in self.gradients.reshape(-1, 9).T]
        return np.stack(columns, axis=-1).reshape(*np.shape(times), 3, 3)


def changing(count=14):
    """Random traceless gradients at uneven times that do not start at zero."""
    rng = np.random.default_rng(4)
    gradients = rng.normal(size=(count, 3, 3))
    gradients -= np.trace(gradients, axis1=1, axis2=2)[:, None, None] / 3 * np.eye(3)
    return Samples(3.0 + np.cumsum(rng.uniform(0.1, 1.0, count)), gradients)


FLOWS = {"steady": FLOW, "changing": changing()}


@pytest.fixture(scope="module")
def response():
    """A bent chain of four unequal spheres, which has no symmetry."""
    directions = np.array([[1.0, 0, 0], [0.8, 0.6, 0], [0, 0.6, 0.8]])
    radii = np.array([1.0, 0.6, 1.4, 0.8])
    steps = (radii[1:] + radii[:-1])[:, None] * directions
    spheres = rc.Spheres(np.cumsum(np.vstack([[5.0, -3, 2], steps]), axis=0), radii)
    return rc.rigid_response(spheres, rc.StokesianDynamics(2), 1.0)


@pytest.fixture(params=FLOWS, scope="module")
def case(request, response):
    flow = FLOWS[request.param]
    return trajectory(response, flow, 4.0, START, 1e-11)


def instants(path, count=23):
    return np.linspace(*path.times[[0, -1]], count)


def now(flow, time):
    """The undisturbed flow at one time."""
    return flow if isinstance(flow, rc.LinearFlow) else rc.LinearFlow(flow.gradient(time))


class TestAsAFunctionOfTime:
    def test_starts_at_the_start_and_lasts(self, case):
        np.testing.assert_allclose(case.rotation(case.times[0]), START.as_matrix(), atol=1e-14)
        assert case.duration == pytest.approx(4.0, rel=1e-14)
        assert np.all(np.diff(case.times) > 0)

    def test_rotations_are_orthonormal_and_continuous(self, case):
        rotations = case.rotation(instants(case, 10_000))
        np.testing.assert_allclose(
            rotations @ rotations.swapaxes(1, 2), np.broadcast_to(np.eye(3), (10_000, 3, 3)), atol=1e-14
        )
        assert np.linalg.det(rotations).min() > 0
        quaternions = case.quaternions(instants(case, 10_000))
        assert np.linalg.norm(np.diff(quaternions, axis=0), axis=1).max() < 4e-3  # half the largest rate times 4e-4
        np.testing.assert_allclose(Rotation.from_quat(quaternions).as_matrix(), rotations, atol=1e-14)

    @pytest.mark.parametrize(
        "name", ["quaternions", "rotation", "gradient", "strain_rate", "strain_components", "angular_velocity"]
    )
    def test_all_times_at_once_or_one_by_one(self, case, name):
        function, times = getattr(case, name), instants(case, 12)
        together = function(times.reshape(3, 4))
        alone = np.array([function(time) for time in times])
        assert together.shape == (3, 4, *alone.shape[1:])
        np.testing.assert_allclose(together.reshape(alone.shape), alone, rtol=0, atol=1e-14)

    def test_rate_of_turning_is_that_of_the_motion(self, case, response):
        """d/dt R = Ω × R by differences, Ω by the response to the flow as the aggregate sees it."""
        step = 1e-4
        for time in instants(case)[1:-1] + 0.01:
            change = (case.rotation(time + step) - case.rotation(time - step)) / (2 * step)
            angular_velocity = case.rotation(time) @ response.motion(case.flow(time)).angular_velocity
            np.testing.assert_allclose(change, np.cross(angular_velocity, case.rotation(time).T).T, atol=1e-6)
            np.testing.assert_allclose(case.angular_velocity(time), angular_velocity, atol=1e-12)

    def test_flow_in_body_axes(self, case):
        for time in instants(case, 5):
            rotation, undisturbed = case.rotation(time), now(case.undisturbed, time)
            seen = case.flow(time)
            np.testing.assert_allclose(seen.gradient, rotation.T @ undisturbed.gradient @ rotation, atol=1e-14)
            np.testing.assert_allclose(case.gradient(time), seen.gradient, atol=1e-14)
            np.testing.assert_allclose(case.strain_rate(time), seen.strain_rate, atol=1e-14)
            np.testing.assert_allclose(
                case.strain_components(time), [np.sum(basis * seen.strain_rate) for basis in STRAIN_BASIS], atol=1e-14
            )
            assert seen.rate == pytest.approx(undisturbed.rate, rel=1e-13)

    def test_steps_cannot_be_changed(self, case):
        for array in (case.times, case.coefficients):
            with pytest.raises(ValueError, match="read-only"):
                array[...] = 0


class TestFlows:
    def test_fluid_at_rest(self, response):
        path = trajectory(response, rc.simple_shear(0.0), 10.0, START)
        np.testing.assert_allclose(path.rotation([0.0, 3.0, 10.0]), [START.as_matrix()] * 3, atol=1e-15)
        assert np.all(path.angular_velocity([0.0, 10.0]) == 0)

    def test_rotating_fluid_carries_the_aggregate_along(self, response):
        """Without strain there is no magnitude to scale by, and the turn is ω t."""
        spin = np.array([0.3, -0.5, 0.9])
        path = trajectory(response, rc.LinearFlow(np.cross(spin, np.eye(3)).T), 5.0, START)
        expected = (Rotation.from_rotvec(5.0 * spin) * START).as_matrix()
        np.testing.assert_allclose(path.rotation(5.0), expected, atol=1e-7)

    @pytest.mark.parametrize("factor", [1e-12, 1e9])
    def test_rate_and_duration_scale(self, response, factor):
        quick, slow = trajectory(response, FLOW.scaled(factor), 10.0 / factor), trajectory(response, FLOW, 10.0)
        np.testing.assert_allclose(quick.times * factor, slow.times, rtol=1e-8)  # step lengths magnify rounding
        times = np.linspace(0, 10.0, 30)
        np.testing.assert_allclose(quick.rotation(times / factor), slow.rotation(times), atol=1e-11)

    def test_constant_gradients_are_a_steady_flow(self, response):
        constant = Samples(np.linspace(2.0, 12.0, 7), np.broadcast_to(GRADIENT, (7, 3, 3)))
        assert isinstance(constant, Gradients)
        path, steady = (trajectory(response, flow, 10.0, START, 1e-11) for flow in (constant, FLOW))
        times = np.linspace(0, 10.0, 50)
        np.testing.assert_allclose(path.rotation(2.0 + times), steady.rotation(times), atol=1e-9)

    def test_samples_are_among_the_steps(self, response):
        """The gradient has kinks there; the span defaults to all samples."""
        flow = changing(40)
        path = trajectory(response, flow)
        assert path.times[0] == flow.times[0]
        assert path.times[-1] == flow.times[-1]
        assert np.abs(path.times[:, None] - flow.times).min(axis=0).max() < 1e-12

    def test_gradient_history(self, response):
        flow = changing(40)
        history = GradientHistory(flow.times, flow.gradients)
        path, same = trajectory(response, history), trajectory(response, flow)
        np.testing.assert_allclose(path.rotation(path.times), same.rotation(path.times), atol=1e-10)
        np.testing.assert_allclose(path.strain_rate(instants(path)), same.strain_rate(instants(path)), atol=1e-10)

    def test_flow_where_gradients_nearly_cancel(self, response):
        """What is left half-way is as small as its rounding, which has a trace."""
        gradient = GRADIENT / 3
        history = GradientHistory(np.array([0.0, 1.0]), np.array([gradient, -gradient * (1 - 1e-12)]))
        path = trajectory(response, history)
        times = 0.5 + 1e-13 * np.arange(-20, 20)
        left = path.gradient(times)
        assert (np.abs(np.trace(left, axis1=1, axis2=2)) > 1e-9 * np.abs(left).max(axis=(1, 2))).any()
        for time in times:
            np.testing.assert_allclose(path.flow(time).gradient, path.gradient(time), atol=1e-15)

    def test_part_of_the_samples(self, response):
        flow = changing(40)
        whole, part = trajectory(response, flow), trajectory(response, flow, 2.345)
        assert part.times[-1] == pytest.approx(flow.times[0] + 2.345)
        np.testing.assert_allclose(part.rotation(part.times), whole.rotation(part.times), atol=1e-6)

    def test_start_as_matrix_or_rotation(self, response):
        given = [trajectory(response, FLOW, 1.0, start).rotation(1.0) for start in (START, START.as_matrix())]
        np.testing.assert_array_equal(*given)
        none, identity = (trajectory(response, FLOW, 1.0, start).rotation(1.0) for start in (None, np.eye(3)))
        np.testing.assert_array_equal(none, identity)


class Wavy(Samples):
    def gradient(self, times):
        return super().gradient(times) + np.sin(np.pi * np.asarray(times))[..., None, None] * GRADIENT


class TestRefusals:
    @pytest.mark.parametrize("duration", [0.0, -1.0])
    def test_duration_must_be_positive(self, response, duration):
        with pytest.raises(ValueError, match=f"^duration: expected a positive number, got {duration:g}$"):
            trajectory(response, FLOW, duration)

    def test_steady_flow_needs_a_duration(self, response):
        with pytest.raises(
            ValueError, match=r"^duration: expected a number of seconds for a steady flow, got None; pass"
        ):
            trajectory(response, FLOW)

    def test_duration_beyond_the_samples(self, response):
        flow = Samples([1.0, 3.0], [GRADIENT, GRADIENT])
        with pytest.raises(ValueError, match=r"^duration: expected at most 2 s, which the samples span, got 2.1 s$"):
            trajectory(response, flow, 2.1)

    def test_endless_turning(self, response):
        with pytest.raises(ValueError, match=r"^duration: expected .* at most 1e\+06, got 2e\+07; follow"):
            trajectory(response, rc.simple_shear(1e4), 2e3)

    @pytest.mark.parametrize("tolerance", [1e-14, 0.1])
    def test_tolerance_out_of_range(self, response, tolerance):
        with pytest.raises(ValueError, match=f"^tolerance: expected 1e-13 to 0.01, got {tolerance:g}$"):
            trajectory(response, FLOW, 1.0, tolerance=tolerance)

    def test_start_that_is_no_rotation(self, response):
        with pytest.raises(ValueError, match=r"^start: expected a rotation matrix"):
            trajectory(response, FLOW, 1.0, np.diag([1.0, 1, -1]))

    def test_times_outside_the_span(self, response):
        path = trajectory(response, FLOW, 2.0)
        for times in (-0.1, [0.5, -0.1]):
            with pytest.raises(ValueError, match=r"^times: expected 0 s to 2 s, got -0.1 s$"):
                path.rotation(times)
        with pytest.raises(ValueError, match=r"^times\[1\]: expected a finite number, got nan$"):
            path.rotation([1.0, np.nan])

    def test_other_things(self, response):
        with pytest.raises(TypeError, match=r"^response: expected RigidResponse, got Spheres; make one"):
            trajectory(response.spheres, FLOW, 1.0)
        with pytest.raises(TypeError, match=r"^flow: expected LinearFlow or an object .*, got ndarray; for instance"):
            trajectory(response, GRADIENT, 1.0)

    @pytest.mark.parametrize("times", [[1.0], [1.0, 1.0], [2.0, 1.0]])
    def test_times_of_samples_must_increase(self, response, times):
        with pytest.raises(ValueError, match=r"^times: expected two samples or more at increasing times; sort them"):
            trajectory(response, Samples(times, [GRADIENT] * len(times)))

    def test_gradients_that_are_no_numbers(self, response):
        with pytest.raises(ValueError, match=r"^gradient\[1, 2, 0\]: expected a finite number, got nan$"):
            trajectory(response, Samples([0.0, 1.0], [GRADIENT, np.where(GRADIENT == -1.3, np.nan, GRADIENT)]))

    def test_gradients_with_a_trace(self, response):
        gradients = np.tile(GRADIENT, (3, 1, 1))
        gradients[1, 0, 0] += 1e-3
        with pytest.raises(
            ValueError, match=r"gradient: expected zero trace .*, got 0\.001 1/s at 2 s; subtract a third"
        ):
            trajectory(response, Samples([1.0, 2.0, 3.0], gradients))

    def test_gradients_that_bend_between_samples(self, response):
        flow = Wavy([0.0, 1.0, 3.0], [GRADIENT] * 3)
        with pytest.raises(ValueError, match=r"^gradient: .* bends by 1.3 1/s between 0 s and 1 s; give more times$"):
            trajectory(response, flow)
