"""Regular clusters of touching equal spheres: reference/clusters.json, copied from the project's shared reference.

It says: "'order_2' is force-torque-stresslet from closed-form Faxén pair blocks, a second independent route, good
to the digits shown (eta_free […] to about 1e-5). […] Regular clusters; centres are obvious from the name." Rt and Rr
are the "principal translational resistances / (6 pi)" and the "principal rotational resistances about the centre
/ (8 pi)".
"""

import json
from math import pi
from pathlib import Path

import numpy as np
import pytest

import rheoclast as rc

CLUSTERS = json.loads((Path(__file__).parent / "reference" / "clusters.json").read_text())["clusters"]


def ring(count):
    """Regular polygon of side 2."""
    angle = 2 * pi * np.arange(count) / count
    return np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1) / np.sin(pi / count)


CORNERS = np.array([[x, y, z] for x in (-1.0, 1) for y in (-1.0, 1) for z in (-1.0, 1)])
CENTERS = {
    "triangle3": ring(3),
    "square4": ring(4),
    "tetra4": np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) / np.sqrt(2),
    "octa6": np.sqrt(2) * np.vstack([np.eye(3), -np.eye(3)]),
    "hexring6": ring(6),
    "cube8": CORNERS,
}


def measures(name, order):
    response = rc.rigid_response(rc.Spheres(CENTERS[name], 1.0), rc.StokesianDynamics(order=order), viscosity=1.0)
    return {
        "Rh": response.hydrodynamic_radius,
        "Rt": np.linalg.eigvalsh(response.resistance[:3, :3]) / (6 * pi),
        "Rr": np.linalg.eigvalsh(response.resistance[3:, 3:]) / (8 * pi),
        "eta_free": response.intrinsic_viscosity,
    }


@pytest.mark.parametrize("name", CLUSTERS)
def test_order_two(name):
    ours, expected = measures(name, 2), CLUSTERS[name]["order_2"]
    assert set(ours) == set(expected)
    for quantity, value in expected.items():
        tolerance = 1e-5 if quantity == "eta_free" else 1e-6
        np.testing.assert_allclose(ours[quantity], value, rtol=tolerance, err_msg=quantity)


@pytest.mark.parametrize("name", ["triangle3", "tetra4"])
def test_order_five_is_near_the_converged_value(name):
    """Whole-cluster quantities forget the contacts: order 5 is within 0.2 %, where order 2 is not within 0.3 %."""
    near, far, expected = measures(name, 5), measures(name, 2), CLUSTERS[name]["converged"]
    for quantity, value in expected.items():
        np.testing.assert_allclose(near[quantity], value, rtol=2e-3, err_msg=quantity)
        assert np.all(np.abs(np.divide(far[quantity], value) - 1) > 3e-3)
