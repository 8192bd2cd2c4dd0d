"""Free draining: every sphere bears Stokes' drag and torque as if alone. All of it can be written down by hand."""

from math import pi

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.vectors import STRAIN_BASIS

VISCOSITY = 1.0
CENTERS = np.array([[1.0, 2.0, -1.0], [3.0, 2.0, -1.0], [3.0, 3.2, 0.6]])
RADII = np.array([1.2, 0.8, 1.2])
GRADIENT = np.array([[0.3, 1.1, -0.4], [0.2, -0.9, 0.7], [-1.3, 0.5, 0.6]])
FLOW = rc.LinearFlow(GRADIENT)
DRAG = 6 * pi * VISCOSITY * RADII
TWIST = 8 * pi * VISCOSITY * RADII**3


@pytest.fixture(scope="module")
def response():
    return rc.rigid_response(rc.Spheres(CENTERS, RADII), rc.FreeDraining(), viscosity=VISCOSITY)


def spin(gradient):
    return 0.5 * np.array(
        [gradient[2, 1] - gradient[1, 2], gradient[0, 2] - gradient[2, 0], gradient[1, 0] - gradient[0, 1]]
    )


def test_held(response):
    """F = 6πμa Γ·x and T = 8πμa³ ω on each."""
    held = response.held(FLOW)
    np.testing.assert_allclose(held.force, DRAG[:, None] * (CENTERS @ GRADIENT.T), rtol=1e-13)
    np.testing.assert_allclose(held.torque, TWIST[:, None] * spin(GRADIENT), rtol=1e-13)


def by_hand():
    """Velocity of the drag-weighted centre, that centre, and the angular velocity of the free trimer.

    About the centre of drag x_d the forces vanish if it moves with the fluid; the balance of torques is then
    Σ [T_i (ω − Ω) + D_i y_i × ((Γ − Ω×) y_i)] = 0 with y = x − x_d.
    """
    center = DRAG @ CENTERS / DRAG.sum()
    y = CENTERS - center
    inertia = sum(
        d * (r @ r * np.eye(3) - np.outer(r, r)) for d, r in zip(DRAG, y, strict=True)
    ) + TWIST.sum() * np.eye(3)
    turning = TWIST.sum() * spin(GRADIENT) + np.einsum("n,ni->i", DRAG, np.cross(y, y @ GRADIENT.T))
    return GRADIENT @ center, center, np.linalg.solve(inertia, turning)


def test_motion(response):
    velocity, center, angular_velocity = by_hand()
    motion = response.motion(FLOW)
    np.testing.assert_allclose(motion.angular_velocity, angular_velocity, rtol=1e-12)
    np.testing.assert_allclose(
        motion.velocity, velocity + np.cross(angular_velocity, response.center - center), rtol=1e-12
    )


def test_free_loads(response):
    velocity, center, angular_velocity = by_hand()
    loads = response.loads(FLOW)
    slip = CENTERS @ GRADIENT.T - velocity - np.cross(angular_velocity, CENTERS - center)
    scale = np.abs(DRAG[:, None] * slip).max()
    np.testing.assert_allclose(loads.force, DRAG[:, None] * slip, atol=1e-12 * scale)
    np.testing.assert_allclose(loads.torque, TWIST[:, None] * (spin(GRADIENT) - angular_velocity), atol=1e-12 * scale)


def test_resistance(response):
    """Translation Σ D, rotation about c Σ T + D (y² 1 − y y), coupling Σ D y×."""
    y = CENTERS - response.center
    cross = np.array([np.cross(r, np.eye(3)).T for r in y])  # cross[n] @ v = y_n × v
    expected = np.zeros((6, 6))
    expected[:3, :3] = DRAG.sum() * np.eye(3)
    expected[3:, :3] = np.einsum("n,nij->ij", DRAG, cross)
    expected[:3, 3:] = expected[3:, :3].T
    expected[3:, 3:] = TWIST.sum() * np.eye(3) - np.einsum("n,nij,njk->ik", DRAG, cross, cross)
    np.testing.assert_allclose(response.resistance, expected, atol=1e-12 * expected.max())


def test_stresslet_in_strain(response):
    """Levers of the drags and 20/3 πμa³ of each sphere: Σ D sym(y E·y) + 20/3 πμa³ E, held in strain about c."""
    y = CENTERS - response.center
    levers = np.einsum("n,ni,nj,kja,lia->kl", DRAG, y, y, STRAIN_BASIS, STRAIN_BASIS)
    expected = levers + 20 / 3 * pi * VISCOSITY * np.sum(RADII**3) * np.eye(5)
    np.testing.assert_allclose(response.grand_resistance[6:, 6:], expected, atol=1e-12 * expected.max())


def test_settling(response):
    """Pushed at the centre of drag it would fall straight; pushed at the centre of volume, the lever turns it."""
    force = np.array([0.5, 1.0, -2.0])
    drag_center = by_hand()[1]
    y = CENTERS - drag_center
    inertia = sum(
        d * (r @ r * np.eye(3) - np.outer(r, r)) for d, r in zip(DRAG, y, strict=True)
    ) + TWIST.sum() * np.eye(3)
    turning = np.linalg.solve(inertia, np.cross(response.center - drag_center, force))
    settling = response.settling(force)
    expected = force / DRAG.sum() + np.cross(turning, response.center - drag_center)
    np.testing.assert_allclose(settling.angular_velocity, turning, rtol=1e-11, atol=1e-15)
    np.testing.assert_allclose(settling.velocity, expected, rtol=1e-12)
    moved = expected + np.cross(turning, CENTERS - response.center)
    np.testing.assert_allclose(settling.loads.force, -DRAG[:, None] * moved, rtol=1e-11)
    np.testing.assert_allclose(settling.loads.torque, -TWIST[:, None] * turning, rtol=1e-11, atol=1e-14)


def test_hydrodynamic_radius_is_the_sum_of_radii(response):
    """The centre of mobility is the centre of drag, where the mobility is 1/Σ 6πμa."""
    assert response.hydrodynamic_radius == pytest.approx(RADII.sum(), rel=1e-12)


def test_doublet_tension():
    """Slip 1·e_nn at unit lever: 6π against 35.9 with interaction; B = 1/(1 + 16/3s²) with s = 2 is 3/7."""
    doublet = rc.Spheres(np.array([[0.0, 0, -1], [0, 0, 1]]), 1.0)
    response = rc.rigid_response(doublet, rc.FreeDraining(), viscosity=1.0)
    loads = response.loads(rc.LinearFlow(np.diag([-0.5, -0.5, 1.0])))
    carried = rc.contact_loads(rc.Aggregate.touching(doublet), loads)
    assert carried.tension[0] == pytest.approx(6 * pi, rel=1e-13)
    assert 2 * response.rotation_coupling[1, 0, 2] == pytest.approx(3 / 7, rel=1e-13)
