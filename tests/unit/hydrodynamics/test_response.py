"""Settling of unequal spheres, the centre of mobility, warnings and coarser orders."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import rheoclast as rc

MODELS = [rc.FreeDraining(), rc.StokesianDynamics(2), rc.StokesianDynamics(3)]


def crooked(unit=1.0):
    """Four unequal spheres in a bent chain, far from the origin."""
    radii = np.array([1.0, 0.6, 1.4, 0.8])
    turns = Rotation.random(3, random_state=3).as_matrix()[:, :, 0]
    turns[1:] = [[0.8, 0.6, 0], [0, 0.6, 0.8]]
    centers = np.cumsum(np.vstack([[5, -3, 2], (radii[1:] + radii[:-1])[:, None] * turns]), axis=0)
    return rc.Spheres(unit * centers, unit * radii)


@pytest.mark.parametrize("model", MODELS, ids=str)
def test_weight_is_shared_by_volume(model):
    spheres = crooked(1e-6)
    force = np.array([1e-12, -2e-12, 3e-12])
    settling = rc.rigid_response(spheres, model, 1e-3).settling(force)
    share = spheres.radii[:, None] ** 3 / np.sum(spheres.radii**3) * force
    np.testing.assert_allclose(settling.net_loads.force - settling.loads.force, share, rtol=1e-10)
    rc.contact_loads(rc.Aggregate.touching(spheres), settling.net_loads)  # they balance


@pytest.mark.parametrize("model", MODELS, ids=str)
def test_coupling_is_symmetric_at_the_center_of_mobility(model):
    response = rc.rigid_response(crooked(1e-6), model, 1e-3)
    arm = response.center_of_mobility - response.center
    turning, mixed = response.mobility[3:, 3:], response.mobility[3:, :3]
    at_center = mixed + turning @ np.cross(arm, np.eye(3)).T  # a force f there turns as f and arm × f at the centre
    assert np.linalg.norm(arm) > 1e-9
    assert np.linalg.norm(mixed - mixed.T) > 1e-3 * np.linalg.norm(mixed)
    np.testing.assert_allclose(at_center, at_center.T, rtol=0, atol=1e-9 * np.abs(mixed).max())


def test_motion_at_a_point():
    response = rc.rigid_response(crooked(), rc.FreeDraining(), 1.0)
    motion, point = response.motion(rc.simple_shear(1.0)), np.array([1.0, 2.0, 3.0])
    x, w = point - motion.center, motion.angular_velocity
    spin = [w[1] * x[2] - w[2] * x[1], w[2] * x[0] - w[0] * x[2], w[0] * x[1] - w[1] * x[0]]
    np.testing.assert_allclose(motion.at(point), motion.velocity + spin)


@pytest.mark.parametrize("viscosity", [1e-3, 2.0])
def test_forgotten_unit_of_length_is_warned_of(viscosity):
    with pytest.warns(rc.UnitWarning, match="radii up to 1.4 m exceed 1 mm"):
        rc.rigid_response(crooked(), rc.FreeDraining(), viscosity)


def test_coarser_responses_are_those_of_the_lower_orders():
    response = rc.rigid_response(crooked(), rc.StokesianDynamics(3), 1.0)
    for order in (2, 1):
        response = response.coarser
        alone = rc.rigid_response(crooked(), rc.StokesianDynamics(order), 1.0)
        np.testing.assert_allclose(response.elementary_loads, alone.elementary_loads, rtol=0, atol=1e-9)
    assert response.coarser is None


def test_tensors_cannot_be_changed():
    response = rc.rigid_response(crooked(), rc.FreeDraining(), 1.0)
    for name in ("grand_resistance", "resistance", "mobility", "rotation_coupling", "translation_coupling"):
        with pytest.raises(ValueError, match="read-only"):
            getattr(response, name)[...] = 0


def test_an_aggregate_is_not_spheres():
    trimer = rc.Aggregate.touching(crooked())
    with pytest.raises(TypeError, match=r"^spheres: expected Spheres, got Aggregate; .* take aggregate.spheres"):
        rc.rigid_response(trimer, rc.FreeDraining(), 1.0)
    with pytest.raises(TypeError, match=r"^model: expected HydrodynamicModel, got the class FreeDraining; for"):
        rc.rigid_response(trimer.spheres, rc.FreeDraining, 1.0)
