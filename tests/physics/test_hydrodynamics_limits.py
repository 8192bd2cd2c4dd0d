"""One sphere, and two far apart: exact laws, and corrections whose power of the distance is known by hand."""

from math import pi

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.vectors import strain_components, strain_tensor

RADIUS, VISCOSITY = 0.7e-6, 1.9e-3
PLACE = np.array([0.4e-6, -1.3e-6, 2.2e-6])
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
        scale = np.sqrt(np.outer(np.diag(expected), np.diag(expected)))
        np.testing.assert_allclose(lone.grand_resistance / scale, np.eye(11), atol=1e-13)

    def test_held_in_a_flow(self, lone):
        """Force 6πμa u(x), torque 8πμa³ ω."""
        held = lone.held(FLOW)
        np.testing.assert_allclose(held.force[0], 6 * pi * VISCOSITY * RADIUS * GRADIENT @ PLACE, rtol=1e-13)
        np.testing.assert_allclose(held.torque[0], 8 * pi * VISCOSITY * RADIUS**3 * FLOW.angular_velocity, rtol=1e-13)

    def test_free_sphere_follows_the_flow_without_load(self, lone):
        motion, loads = lone.motion(FLOW), lone.loads(FLOW)
        np.testing.assert_allclose(motion.velocity, GRADIENT @ PLACE, rtol=1e-13)
        np.testing.assert_allclose(motion.angular_velocity, FLOW.angular_velocity, rtol=1e-13)
        assert np.abs(loads.force).max() < 1e-13 * VISCOSITY * RADIUS**2
        assert np.abs(loads.torque).max() < 1e-13 * VISCOSITY * RADIUS**3

    def test_settles_at_the_stokes_velocity(self, lone):
        force = np.array([0.3, 2.0, -1.0])
        settling = lone.settling(force)
        np.testing.assert_allclose(settling.velocity, force / (6 * pi * VISCOSITY * RADIUS), rtol=1e-13)
        assert np.abs(settling.angular_velocity).max() < 1e-13 * np.abs(settling.velocity).max() / RADIUS
        np.testing.assert_allclose(settling.loads.force[0], -force, rtol=1e-13)

    def test_hydrodynamic_radius_is_the_radius(self, lone):
        assert lone.hydrodynamic_radius == pytest.approx(RADIUS, rel=1e-13, abs=0)

    def test_intrinsic_viscosity_of_einstein(self, lone):
        assert lone.intrinsic_viscosity == pytest.approx(5 / 2, rel=1e-13)


def test_one_sphere_at_order_one_has_drag_only():
    """Order 1 knows uniform tractions alone: 6πμa, and no torque or stresslet to resist with."""
    response = rc.rigid_response(rc.Spheres(PLACE[None], RADIUS), rc.StokesianDynamics(order=1), viscosity=VISCOSITY)
    expected = np.zeros((11, 11))
    expected[:3, :3] = 6 * pi * VISCOSITY * RADIUS * np.eye(3)
    np.testing.assert_allclose(response.grand_resistance, expected, rtol=1e-13, atol=1e-13 * expected.max())
    assert response.hydrodynamic_radius == pytest.approx(RADIUS, rel=1e-13, abs=0)


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
        """Drag per sphere over 6πμaU = 1/(1 + 3/4s + 1/2s³ − 3/4s⁴ + O(s⁻⁶)), kept from turning.

        The orders are read from s = 16 on: at 8 the terms left out, of either sign, are 3e-8 together.
        """
        mobility = np.array([12 * pi / response.resistance[0, 0] for response in far])
        errors = mobility - (1 + 3 / (4 * DISTANCES) + DISTANCES**-3 / 2 - 3 / 4 * DISTANCES**-4)
        assert np.all(observed_orders(errors)[1:] > 5.7)

    def test_tension_in_axial_strain(self, far):
        """Force along the axis in unit e_nn: 6π (s/2 − 5/2s² + 4/s⁴)/(1 − 3/2s + 1/s³ − 15/4s⁴) (1 + O(s⁻⁶)).

        s/2 is the slip of a free point; −5/2s² + 4/s⁴ is what the other's own stresslet 20/3 π takes from it, the
        second term by the sizes of both (1/10 + 1/6).
        """
        flow = rc.LinearFlow(np.diag([-0.5, -0.5, 1.0]))
        force = np.array([response.loads(flow).force[1, 2] for response in far])
        slip = DISTANCES / 2 - 5 / 2 * DISTANCES**-2 + 4 * DISTANCES**-4
        by_hand = 6 * pi * slip / (1 - 3 / (2 * DISTANCES) + DISTANCES**-3 - 15 / 4 * DISTANCES**-4)
        assert np.all(observed_orders(force / by_hand - 1)[1:] > 5.7)

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

    def test_deviation_of_axial_spin_beyond_order_two(self):
        """Order 3 adds the twist X_2, raised by 1/s⁴ and coming back with 1/s⁴: 1/(1 + 1/s³) + O(s⁻⁸)."""
        torque = np.array([pair(s, 3).resistance[5, 5] / (16 * pi) for s in DISTANCES[:3]])
        assert np.all(np.abs(observed_orders(torque - 1 / (1 + DISTANCES[:3] ** -3)) - 8) < 0.3)


class TestExactAtOrderTwo:
    """Two spheres on an axis share one mode alone in these two problems, so order 2 is two numbers at any distance."""

    SEPARATIONS = (2.0, 2.5, 4.0, 10.0)

    @pytest.mark.parametrize("s", SEPARATIONS)
    def test_spin_about_the_axis(self, s):
        """Torque per sphere over 8πμa³Ω = 1/(1 + 1/s³): a rotlet turns the fluid on its axis by L/8πr³, no more."""
        assert pair(s, 2).resistance[5, 5] / (16 * pi) == pytest.approx(1 / (1 + s**-3), rel=1e-13)

    @pytest.mark.parametrize("s", SEPARATIONS)
    def test_strain_across_the_axis(self, s):
        """In e_xy neither bears a force, and each stresslet over 20/3 πμa³ is 1/(1 + 2/s⁵).

        A stresslet S_xy strains the fluid on the z axis only by the sizes of both, (1/10 + 1/10) 12 S/8πr⁵, against
        its own 3 S/20π.
        """
        strain = rc.LinearFlow(np.array([[0, 1.0, 0], [1, 0, 0], [0, 0, 0]])).strain_rate
        response = pair(s, 2)
        stresslet = strain_tensor(response.grand_resistance[6:, 6:] @ strain_components(strain))
        assert stresslet[0, 1] / (40 / 3 * pi) == pytest.approx(1 / (1 + 2 * s**-5), rel=1e-13)

    @pytest.mark.parametrize("s", SEPARATIONS)
    def test_unequal_spin_about_the_axis(self, s):
        """Radii 1 and 0.4: torques L from L_a/a³ + L_b/r³ = 8πΩ and L_a/r³ + L_b/b³ = 8πΩ."""
        a, b = 1.0, 0.4
        torques = np.linalg.solve([[a**-3, s**-3], [s**-3, b**-3]], [8 * pi, 8 * pi])
        assert pair(s, 2, (a, b)).resistance[5, 5] == pytest.approx(torques.sum(), rel=1e-13)


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


def test_many_far_spheres_by_their_stokeslets():
    """Mean resistance of N spread spheres over 6πμaN = 1 − (1/N) Σ_{i≠j} a/r_ij + O(s⁻²).

    The stokeslet 3a/4r (1 + r̂r̂) has the mean a/r over directions of the force.
    """
    shape = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0.2], [-0.5, 0.3, 1], [0.2, -1, -0.4]])
    apart = np.linalg.norm(shape[:, None] - shape, axis=-1)
    near = np.sum(1 / apart[~np.eye(5, dtype=bool)]) / 5
    errors = []
    for distance in DISTANCES:
        response = rc.rigid_response(
            rc.Spheres(4 * distance * shape, 1.0), rc.StokesianDynamics(order=2), viscosity=1.0
        )
        errors.append(np.trace(response.resistance[:3, :3]) / (3 * 5 * 6 * pi) - 1 + near / (4 * distance))
    assert np.all(observed_orders(errors) > 1.8)
