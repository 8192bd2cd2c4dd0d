"""Free aggregates in flow: Jeffery's orbits, symmetry, reversibility, and the order of the integration."""

import json
from functools import cache
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import expm
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

import rheoclast as rc
from rheoclast.hydrodynamics.trajectory import trajectory

REFERENCE = json.loads((Path(__file__).parents[1] / "published" / "reference" / "doublet.json").read_text())
DOUBLET = rc.Spheres(np.array([[-1.0, 0, 0], [1.0, 0, 0]]), 1.0)
AXIS = np.array([1.0, 0, 0])
SHEAR_RATE = 3.0
SHEAR = rc.simple_shear(SHEAR_RATE)
GRADIENT = np.array([[0.3, 1.1, -0.4], [0.2, -0.9, 0.7], [-1.3, 0.5, 0.6]])
START = Rotation.random(random_state=8).as_matrix()
FINE = 1e-12
LATTICES = {
    "octahedron": np.vstack([np.eye(3), -np.eye(3)]) * np.sqrt(2),
    "cube": np.array([[x, y, z] for x in (-1.0, 1) for y in (-1.0, 1) for z in (-1.0, 1)]),
}


@cache
def doublet(order=2):
    return rc.rigid_response(DOUBLET, rc.StokesianDynamics(order), 1.0)


@cache
def crooked():
    """Four spheres without any symmetry."""
    directions = np.array([[1.0, 0, 0], [0.8, 0.6, 0], [0, 0.6, 0.8]])
    radii = np.array([1.0, 0.6, 1.4, 0.8])
    centers = np.cumsum(np.vstack([np.zeros(3), (radii[1:] + radii[:-1])[:, None] * directions]), axis=0)
    return rc.rigid_response(rc.Spheres(centers, radii), rc.StokesianDynamics(2), 1.0)


def bretherton(aspect_ratio):
    return (aspect_ratio**2 - 1) / (aspect_ratio**2 + 1)


def stretched(flow, constant):
    """Jeffery's equation in the linear form of Bretherton: the axis is along exp((W + B E) t)·p."""
    return flow.gradient + (constant - 1) * flow.strain_rate


class TestJeffery:
    """The touching doublet moves as the spheroid of aspect ratio r with B = (r² − 1)/(r² + 1)."""

    RATIO = REFERENCE["order_2"]["r_e"]

    @pytest.mark.parametrize("start", Rotation.random(4, random_state=5).as_matrix())
    def test_axis_in_any_flow(self, start):
        flow = rc.LinearFlow(GRADIENT)
        path, times = trajectory(doublet(), flow, 8.0, start, FINE), np.linspace(0, 8.0, 40)
        axes = np.array([expm(stretched(flow, bretherton(self.RATIO)) * time) @ start @ AXIS for time in times])
        axes /= np.linalg.norm(axes, axis=1, keepdims=True)
        np.testing.assert_allclose(path.rotation(times) @ AXIS, axes, atol=2e-8)  # nine digits of r are known

    def test_spin_about_the_axis_is_that_of_the_fluid(self):
        flow = rc.LinearFlow(GRADIENT)
        path, times = trajectory(doublet(), flow, 8.0, START), np.linspace(0, 8.0, 40)
        axes = path.rotation(times) @ AXIS
        spins = np.sum(axes * path.angular_velocity(times), axis=1)
        np.testing.assert_allclose(spins, axes @ flow.angular_velocity, atol=1e-12)

    def test_orbit_in_simple_shear(self):
        """With φ from the gradient: tan φ = r tan(G t/(r + 1/r)), and tan θ sqrt(r² cos² φ + sin² φ) is constant."""
        ratio = self.RATIO
        tilted = np.array([0.0, np.sin(0.7), np.cos(0.7)])  # φ = 0, θ = 0.7 from the vorticity
        start = Rotation.align_vectors([tilted], [AXIS])[0]
        path = trajectory(doublet(), SHEAR, 20.0, start, FINE)
        times = np.linspace(0, 20.0, 400)
        x, y, z = (path.rotation(times) @ AXIS).T
        phase = SHEAR_RATE * times / (ratio + 1 / ratio)
        np.testing.assert_allclose(x * np.cos(phase), ratio * y * np.sin(phase), atol=1e-7)
        np.testing.assert_allclose(np.sqrt(ratio**2 * y**2 + x**2) / z, ratio * np.tan(0.7), rtol=1e-7)
        assert np.all(np.sign(y) == np.sign(np.cos(phase)))  # the right way round, too

    @pytest.mark.parametrize(("order", "source", "accuracy"), [(2, "order_2", 1e-8), (8, "converged", 2e-5)])
    def test_period_in_simple_shear(self, order, source, accuracy):
        """T = 2π/G (r + 1/r), after which the axis points where it did; 15.62/G for touching spheres."""
        ratio = REFERENCE[source]["r_e"]
        expected = 2 * np.pi / SHEAR_RATE * (ratio + 1 / ratio)
        path = trajectory(doublet(order), SHEAR, 1.1 * expected, tolerance=FINE)

        def height(time):
            return (path.rotation(time) @ AXIS)[1]

        assert brentq(height, 0.9 * expected, 1.1 * expected, xtol=1e-13) == pytest.approx(expected, rel=accuracy)
        half = brentq(height, 0.4 * expected, 0.6 * expected, xtol=1e-13)
        assert half == pytest.approx(expected / 2, rel=accuracy)
        assert SHEAR_RATE * expected == pytest.approx(15.62 if order == 8 else 15.81, abs=5e-3)

    def test_changing_gradient(self):
        """The axis follows dp/dt = (W + B E)·p, apart from its length, through all kinks."""
        times = np.linspace(0, 6.0, 25)
        gradients = np.random.default_rng(1).normal(size=(25, 3, 3))
        gradients -= np.trace(gradients, axis1=1, axis2=2)[:, None, None] / 3 * np.eye(3)
        flow = Samples(times, gradients)
        path = trajectory(doublet(), flow, start=START, tolerance=FINE)
        axis, constant = START @ AXIS, bretherton(self.RATIO)

        def rate(time, axis):
            return stretched(rc.LinearFlow(flow.gradient(time)), constant) @ axis

        for begin, end in pairwise(times):
            axis = solve_ivp(rate, (begin, end), axis, rtol=1e-11, atol=1e-12).y[:, -1]
            np.testing.assert_allclose(path.rotation(end) @ AXIS, axis / np.linalg.norm(axis), atol=3e-8)


class Samples:
    """Gradients linear between samples."""

    def __init__(self, times, gradients):
        self.times, self.gradients = times, gradients

    def gradient(self, times):
        columns = [np.interp(times, self.times, column) for column in self.gradients.reshape(-1, 9).T]
        return np.stack(columns, axis=-1).reshape(*np.shape(times), 3, 3)


@pytest.mark.parametrize("name", LATTICES)
@pytest.mark.parametrize("model", [rc.FreeDraining(), rc.StokesianDynamics(2), rc.StokesianDynamics(4)], ids=str)
def test_cubic_cluster_turns_with_the_vorticity(name, model):
    """Cubic symmetry leaves no coupling to strain: in simple shear the turn is −G t/2 about z."""
    response = rc.rigid_response(rc.Spheres(LATTICES[name], 1.0), model, 1.0)
    times = np.linspace(0, 10.0, 50)
    path = trajectory(response, SHEAR, 10.0, START, FINE)
    turned = Rotation.from_rotvec(np.outer(-0.5 * SHEAR_RATE * times, [0, 0, 1.0])).as_matrix() @ START
    np.testing.assert_allclose(path.rotation(times), turned, atol=1e-10)


def test_chain_aligns_with_stretching():
    """In uniaxial extension e the tangent of the angle to the axis falls as exp(−3/2 B e t)."""
    chain = rc.generation.straight_chain(5).spheres
    response = rc.rigid_response(chain, rc.StokesianDynamics(2), 1.0)
    along = chain.centers[-1] - chain.centers[0]
    along /= np.linalg.norm(along)
    across = np.linalg.svd(along[None])[2][1]
    strain = np.outer(along, across) + np.outer(across, along)
    flow, rate = rc.uniaxial_extension(2.0), 2.0
    constant = float(np.linalg.norm(np.einsum("ijk,jk->i", response.rotation_coupling, strain)))
    assert 0.8 < constant < 1
    start = Rotation.align_vectors([[np.sin(1.2), 0, np.cos(1.2)]], [along])[0]
    path, times = trajectory(response, flow, 4.0, start, FINE), np.linspace(0, 4.0, 20)
    x, y, z = (path.rotation(times) @ along).T
    np.testing.assert_allclose(x / z, np.tan(1.2) * np.exp(-1.5 * constant * rate * times), rtol=1e-8)
    assert np.abs(y).max() < 1e-10
    assert z[-1] > 0.9999


class TestNoInertia:
    def test_reversed_flow_leads_back(self):
        times, rng = np.linspace(0, 5.0, 11), np.random.default_rng(2)
        gradients = rng.normal(size=(11, 3, 3))
        gradients -= np.trace(gradients, axis1=1, axis2=2)[:, None, None] / 3 * np.eye(3)
        there = trajectory(crooked(), Samples(times, gradients), start=START, tolerance=FINE)
        back = trajectory(crooked(), Samples(times, -gradients[::-1]), start=there.rotation(5.0), tolerance=FINE)
        np.testing.assert_allclose(back.rotation(times), there.rotation(times[::-1]), atol=1e-9)
        assert np.abs(there.rotation(5.0) - START).max() > 0.1

    def test_motion_depends_on_the_strain_passed_only(self):
        """A flow that starts gently, Γ s(t), leads along the same path as the steady one, at ∫ s dt."""
        ramp = np.array([0.0, 1.0, 3.0, 0.5])
        gentle = trajectory(crooked(), Samples(np.arange(4.0), ramp[:, None, None] * GRADIENT), tolerance=FINE)
        steady = trajectory(crooked(), rc.LinearFlow(GRADIENT), 5.0, tolerance=FINE)
        for end, passed in enumerate([0.0, 0.5, 2.5, 4.25]):
            np.testing.assert_allclose(gentle.rotation(end), steady.rotation(passed), atol=1e-10)


class TestFrames:
    """Neither the axes of the lab nor those in which the spheres are given matter."""

    TURN = Rotation.random(random_state=11).as_matrix()

    def test_lab_axes(self):
        flow, times = rc.LinearFlow(GRADIENT), np.linspace(0, 10.0, 30)
        path = trajectory(crooked(), flow, 10.0, START, FINE)
        turned = trajectory(crooked(), flow.rotated(self.TURN), 10.0, self.TURN @ START, FINE)
        np.testing.assert_allclose(turned.rotation(times), self.TURN @ path.rotation(times), atol=1e-9)
        np.testing.assert_allclose(turned.strain_rate(times), path.strain_rate(times), atol=1e-9)

    def test_body_axes(self):
        flow, times, spheres = rc.LinearFlow(GRADIENT), np.linspace(0, 10.0, 30), crooked().spheres
        turned = rc.rigid_response(rc.Spheres(spheres.centers @ self.TURN.T, spheres.radii), rc.StokesianDynamics(2), 1)
        path = trajectory(crooked(), flow, 10.0, START, FINE)
        other = trajectory(turned, flow, 10.0, START @ self.TURN.T, FINE)
        np.testing.assert_allclose(other.rotation(times) @ self.TURN, path.rotation(times), atol=1e-9)


@cache
def integrated_otherwise(duration):
    """Rotations by SciPy's Adams and BDF integrator, for the matrix, from the response's motion."""

    def rate(_, entries):
        rotation = entries.reshape(3, 3)
        seen = rc.LinearFlow(rotation.T @ SHEAR.gradient @ rotation)
        return (rotation @ np.cross(crooked().motion(seen).angular_velocity, np.eye(3)).T).ravel()

    times = np.linspace(0, duration, 100)
    solution = solve_ivp(rate, (0, duration), START.ravel(), "LSODA", times, rtol=1e-12, atol=1e-13)
    return times, solution.y.T.reshape(-1, 3, 3)


class TestAccuracy:
    DURATION = 20.0

    def error(self, tolerance):
        times, rotations = integrated_otherwise(self.DURATION)
        path = trajectory(crooked(), SHEAR, self.DURATION, START, tolerance)
        return np.abs(path.rotation(times) - rotations).max()

    def test_default_tolerance(self):
        assert self.error(1e-8) < 1e-6

    def test_error_falls_in_proportion_to_the_tolerance(self):
        """Error per step of order eight and global error of order eight: slope one, also between the steps."""
        tolerances = 10.0 ** -np.arange(3, 10)
        slope, _ = np.polyfit(np.log(tolerances), np.log([self.error(each) for each in tolerances]), 1)
        assert 0.8 < slope < 1.2

    def test_steps_grow_with_the_eighth_root_of_the_tolerance(self):
        tolerances = 10.0 ** -np.arange(4, 13)
        steps = [len(trajectory(crooked(), SHEAR, 50.0, START, each).times) for each in tolerances]
        slope, _ = np.polyfit(np.log(tolerances), np.log(steps), 1)
        assert -1 / 7 < slope < -1 / 10
