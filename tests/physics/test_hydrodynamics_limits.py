"""One sphere, and two far apart: exact laws, and corrections whose power of the distance is known by hand."""

from math import pi

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.vectors import strain_components, strain_tensor

RADIUS, VISCOSITY = 0.7, 1.9
PLACE = np.array([0.4, -1.3, 2.2])
GRADIENT = np.array([[0.3, 1.1, -0.4], [0.2, -0.9, 0.7], [-1.3, 0.5, 0.6]])
FLOW = rc.LinearFlow(GRADIENT)
ORDERS = [2, 3, 4, 6]
COMPLETE = [rc.FreeDraining(), *(rc.StokesianDynamics(order=order) for order in ORDERS)]


@pytest.fixture(params=COMPLETE, ids=str)
def lone(request):
    return rc.rigid_response(rc.Spheres(PLACE[None], RADIUS), request.param, viscosity=VISCOSITY)


class TestOneSphere:
    """Every model with force, torque and stresslet is exact for one sphere."""

    def test_resistances_of_stokes(self, lone):
        """6πμa, 8πμa³ and 20/3 πμa³, and nothing couples."""
        translation, rotation, strain = 6 * RADIUS, 8 * RADIUS**3, 20 / 3 * RADIUS**3
        expected = pi * VISCOSITY * np.diag(np.repeat([translation, rotation, strain], [3, 3, 5]))
        np.testing.assert_allclose(lone.grand_resistance, expected, rtol=1e-13, atol=1e-13 * expected.max())

    def test_held_in_a_flow(self, lone):
        """Force 6πμa u(x), torque 8πμa³ ω."""
        held = lone.held(FLOW)
        np.testing.assert_allclose(held.force[0], 6 * pi * VISCOSITY * RADIUS * GRADIENT @ PLACE, rtol=1e-13)
        np.testing.assert_allclose(held.torque[0], 8 * pi * VISCOSITY * RADIUS**3 * FLOW.angular_velocity, rtol=1e-13)

    def test_free_sphere_follows_the_flow_without_load(self, lone):
        motion, loads = lone.motion(FLOW), lone.loads(FLOW)
        np.testing.assert_allclose(motion.velocity, GRADIENT @ PLACE, rtol=1e-13)
        np.testing.assert_allclose(motion.angular_velocity, FLOW.angular_velocity, rtol=1e-13)
        assert np.abs(loads.force).max() < 1e-13
        assert np.abs(loads.torque).max() < 1e-13

    def test_settles_at_the_stokes_velocity(self, lone):
        force = np.array([0.3, 2.0, -1.0])
        settling = lone.settling(force)
        np.testing.assert_allclose(settling.velocity, force / (6 * pi * VISCOSITY * RADIUS), rtol=1e-13)
        assert np.abs(settling.angular_velocity).max() < 1e-14
        np.testing.assert_allclose(settling.loads.force[0], -force, rtol=1e-13)

    def test_hydrodynamic_radius_is_the_radius(self, lone):
        assert lone.hydrodynamic_radius == pytest.approx(RADIUS, rel=1e-13)

    def test_intrinsic_viscosity_of_einstein(self, lone):
        assert lone.intrinsic_viscosity == pytest.approx(5 / 2, rel=1e-13)


def test_one_sphere_at_order_one_has_drag_only():
    """Order 1 knows uniform tractions alone: 6πμa, and no torque or stresslet to resist with."""
    response = rc.rigid_response(rc.Spheres(PLACE[None], RADIUS), rc.StokesianDynamics(order=1), viscosity=VISCOSITY)
    expected = np.zeros((11, 11))
    expected[:3, :3] = 6 * pi * VISCOSITY * RADIUS * np.eye(3)
    np.testing.assert_allclose(response.grand_resistance, expected, rtol=1e-13, atol=1e-13 * expected.max())
    assert response.hydrodynamic_radius == pytest.approx(RADIUS, rel=1e-13)


DISTANCES = np.array([8.0, 16, 32, 64])


def pair(distance, order, radii=(1.0, 1.0)):
    """Two spheres at `distance` on the z axis, rigidly joined across it; viscosity 1."""
    spheres = rc.Spheres(np.array([[0, 0, -distance / 2], [0, 0, distance / 2]]), np.array(radii))
    return rc.rigid_response(spheres, rc.StokesianDynamics(order=order), viscosity=1.0)


def observed_orders(errors):
    """Exponents with which the errors fall between successive distances."""
    return -np.diff(np.log2(np.abs(errors)))


@pytest.fixture(params=[2, 3])
def far(request):
    """Responses at all distances."""
    return [pair(distance, request.param) for distance in DISTANCES]


class TestTwoSpheresFarApart:
    """Equal spheres, s = distance / a. What the hand calculation leaves out must fall by the power that it leaves out.

    A stokeslet F has 1/s and 1/s³ (Faxén); it strains the other sphere, whose stresslet 5/3 a³F/r² comes back with
    1/s⁴, as does the torque a³F/r² that keeps the other from spinning. The next corrections are of order 1/s⁶.
    """

    def test_axial_drag(self, far):
        """Drag per sphere over 6πμaU = 1/(1 + 3/2s − 1/s³ − 15/4s⁴ + O(s⁻⁶))."""
        mobility = np.array([12 * pi / response.resistance[2, 2] for response in far])
        errors = mobility - (1 + 3 / (2 * DISTANCES) - DISTANCES**-3 - 15 / 4 * DISTANCES**-4)
        assert np.all(observed_orders(errors) > 5.7)

    def test_transverse_drag(self, far):
        """Drag per sphere over 6πμaU = 1/(1 + 3/4s + 1/2s³ − 3/4s⁴ + O(s⁻⁶)), kept from turning."""
        mobility = np.array([12 * pi / response.resistance[0, 0] for response in far])
        errors = mobility - (1 + 3 / (4 * DISTANCES) + DISTANCES**-3 / 2 - 3 / 4 * DISTANCES**-4)
        assert np.all(observed_orders(errors) > 5.7)

    def test_axial_spin(self, far):
        """Torque per sphere over 8πμa³Ω = 1/(1 + 1/s³) at order 2, exactly: a rotlet on its axis only turns fluid."""
        torque = np.array([response.resistance[5, 5] / (16 * pi) for response in far])
        errors = torque - 1 / (1 + DISTANCES**-3)
        assert np.all(np.abs(errors[1:]) < 1e-12)
        assert abs(errors[0]) < 0.01 * DISTANCES[0] ** -6

    def test_tension_in_axial_strain(self, far):
        """Force on a sphere along the axis in unit e_nn: 6π (s/2 − 5/2s²)/(1 − 3/2s + 1/s³ − 15/4s⁴), to O(s⁻⁵).

        s/2 is the slip of a free point; 5/2s² is what the other sphere's own stresslet 20/3 π takes from it.
        """
        flow = rc.LinearFlow(np.diag([-0.5, -0.5, 1.0]))
        force = np.array([response.loads(flow).force[1, 2] for response in far])
        slip = DISTANCES / 2 - 5 / 2 * DISTANCES**-2
        by_hand = 6 * pi * slip / (1 - 3 / (2 * DISTANCES) + DISTANCES**-3 - 15 / 4 * DISTANCES**-4)
        assert np.all(observed_orders(force / by_hand - 1) > 4.7)

    def test_turns_like_a_rod_far_apart(self, far):
        """Bretherton constant 1 − 16/3s²: two drags 6π at s/2 follow the strain, two torques 8π hold back."""
        spin = np.array([2 * response.rotation_coupling[1, 0, 2] for response in far])
        errors = (1 - spin) / (16 / (3 * DISTANCES**2)) - 1
        assert np.all(np.abs(observed_orders(errors) - 1) < 0.2)  # the first interaction, a stokeslet's 1/s
        assert np.abs(errors[-1]) < 2 / DISTANCES[-1]

    def test_axial_stresslet_and_intrinsic_viscosity(self, far):
        """A far dumbbell's viscosity is that of its pull, [η] = 3/40 s² (1 + 3/2s + O(s⁻²)), 5/2 being lost in it."""
        ratio = np.array([response.intrinsic_viscosity for response in far]) / (3 / 40 * DISTANCES**2)
        assert np.all(observed_orders(ratio - 1 - 3 / (2 * DISTANCES)) > 1.8)

    def test_loads_of_a_held_pair_are_those_of_single_spheres(self, far):
        """Held in a flow, each bears Stokes' force and torque, the relative correction being 1/s."""
        error = []
        for response in far:
            held, points = response.held(FLOW), response.spheres.centers
            single = 6 * pi * FLOW.velocity(points)
            error.append(np.abs(held.force - single).max() / np.abs(single).max())
        assert np.all(np.abs(observed_orders(error) - 1) < 0.15)

    def test_strain_of_far_spheres_is_that_of_single_ones(self, far):
        """Their own stresslets, without the lever of the forces, would be 20/3 π each: by shape alone xy strain has no lever.

        In e_xy, across the axis, no force acts on either sphere; the correction is that of two stresslets, 1/s³.
        """
        flow = rc.LinearFlow(np.array([[0, 1.0, 0], [1, 0, 0], [0, 0, 0]]))
        components = strain_components(flow.strain_rate)
        stresslet = [strain_tensor(response.grand_resistance[6:, 6:] @ components)[0, 1] for response in far]
        assert np.all(np.abs(observed_orders(np.array(stresslet) / (40 / 3 * pi) - 1) - 3) < 0.3)


def test_unequal_spheres_far_apart():
    """Axial force on each of radii a, b moving alike: leading Stokeslets, F_a (1/6πa) + F_b/(4πr) = U, to O(r⁻³).

    The Faxén terms, (a² + b²)/r³, and the stresslets, b³/r⁴, are what is left out.
    """
    a, b = 0.6, 1.7
    errors = []
    for distance in DISTANCES:
        response = pair(distance, 2, (a, b))
        settling = response.settling(np.array([0.0, 0, 1]))
        forces = -settling.loads.force[:, 2] / settling.velocity[2]
        exchange = 1 / (4 * pi * distance)
        by_hand = np.linalg.solve([[1 / (6 * pi * a), exchange], [exchange, 1 / (6 * pi * b)]], [1, 1])
        errors.append(np.abs(forces / by_hand - 1).max())
    assert np.all(observed_orders(errors) > 2.7)


def test_many_far_spheres_settle_as_single_ones():
    """Spread out, mobility falls to that of five independent drags, the correction being the sum of stokeslets 1/s."""
    shape = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0.2], [-0.5, 0.3, 1], [0.2, -1, -0.4]])
    errors = []
    for distance in DISTANCES:
        response = rc.rigid_response(rc.Spheres(2 * distance * shape, 1.0), rc.StokesianDynamics(order=2), viscosity=1.0)
        errors.append(1 - np.trace(response.resistance[:3, :3]) / (3 * 5 * 6 * pi))
    assert np.all(np.abs(observed_orders(errors) - 1) < 0.1)
