"""Straight chains of 2 to 10 touching equal spheres: reference/chains.json, copied from the project's shared reference.

Its own words: "'order_2' is force-torque-stresslet from closed-form Faxén pair blocks, a second independent route, good
to the digits shown […]. Signs of shear and moment depend on the choice of axes: compare magnitudes. Straight chains.
Bonds in order from one end."
"""

import json
from math import pi
from pathlib import Path

import numpy as np
import pytest

import rheoclast as rc

CHAINS = json.loads((Path(__file__).parent / "reference" / "chains.json").read_text())["chains"]
TURN = np.array([[2.0, -1, 2], [2, 2, -1], [-1, 2, 2]]) / 3  # the chain lies along no axis of coordinates
ALONG = rc.LinearFlow(TURN @ np.diag([-0.5, -0.5, 1.0]) @ TURN.T)  # e_nn = 1
ACROSS = rc.LinearFlow(TURN @ np.array([[0.0, 0, 1], [0, 0, 0], [1, 0, 0]]) @ TURN.T)  # e_nt = 1


def measures(count, order):
    """The quantities of the file, by its definitions."""
    centers = np.zeros((count, 3))
    centers[:, 2] = 2.0 * np.arange(count)
    spheres = rc.Spheres(centers @ TURN.T, 1.0)
    response = rc.rigid_response(spheres, rc.StokesianDynamics(order=order), viscosity=1.0)
    aggregate = rc.Aggregate.touching(spheres)
    assert aggregate.pairs.tolist() == [[k, k + 1] for k in range(count - 1)]
    stretched, bent = (rc.contact_loads(aggregate, response.loads(flow)) for flow in (ALONG, ACROSS))
    across, normal = TURN[:, 0], TURN[:, 2]
    spin = np.einsum("ijk,jk->i", response.rotation_coupling, ACROSS.strain_rate)
    bretherton = spin @ np.cross(normal, across)
    return {
        "X_drag_per_sphere": normal @ response.resistance[:3, :3] @ normal / (6 * pi * count),
        "Y_drag_per_sphere": across @ response.resistance[:3, :3] @ across / (6 * pi * count),
        "R_h": response.hydrodynamic_radius,
        "r_e": np.sqrt((1 + bretherton) / (1 - bretherton)),
        "tension": stretched.tension,
        "shear_free": bent.shear,
        "moment_free": bent.bending,
    }


@pytest.fixture(scope="module", params=[2, 3, 4, 6, 8, 10])
def order_two(request):
    return measures(request.param, 2), CHAINS[str(request.param)]["order_2"]


NAMES = ["X_drag_per_sphere", "Y_drag_per_sphere", "R_h", "r_e", "tension", "shear_free", "moment_free"]


@pytest.mark.parametrize("name", NAMES)
def test_order_two(order_two, name):
    """Six digits; a moment that vanishes by symmetry does so to 1e-6 of the sphere's radius times the shear."""
    ours, expected = order_two
    assert set(NAMES) == set(expected)
    zero = 1e-6 * max(expected["shear_free"])
    assert np.shape(ours[name]) == np.shape(expected[name])
    np.testing.assert_allclose(
        np.abs(ours[name]), np.abs(expected[name]), rtol=1e-6, atol=zero * (name == "moment_free")
    )


def test_tension_is_a_pull(order_two):
    """Stretching the fluid along the chain pulls every contact apart: tension > 0."""
    assert np.all(order_two[0]["tension"] > 0)


@pytest.mark.parametrize("count", [3, 4])
def test_order_six_is_near_the_converged_value(count):
    """Order 6 errs by 0.13 % in the doublet's tension; half a per cent, with bending."""
    ours, expected = measures(count, 6), CHAINS[str(count)]["converged"]
    for name in NAMES:
        largest = np.max(np.abs(expected[name]))
        np.testing.assert_allclose(np.abs(ours[name]), np.abs(expected[name]), atol=5e-3 * largest, err_msg=name)
