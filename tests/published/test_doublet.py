"""Two touching equal spheres: reference/doublet.json, copied from the project's shared reference.

Its own words: "Touching equal spheres, radius 1, viscosity 1. Computed by an independent Galerkin multipole solver […];
'converged' is its largest L, 'order_2' is force-torque-stresslet from closed-form Faxén pair blocks, a second
independent route, good to the digits shown (eta_free, S_axi and S_xz to about 1e-5). Signs of shear and moment depend
on the choice of axes: compare magnitudes."
"""

import json
import re
from math import pi
from pathlib import Path

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.vectors import strain_components, strain_tensor

REFERENCE = json.loads((Path(__file__).parent / "reference" / "doublet.json").read_text())
DOUBLET = rc.Spheres(np.array([[0.0, 0, -1], [0, 0, 1]]), 1.0)
ALONG = rc.LinearFlow(np.diag([-0.5, -0.5, 1.0]))  # e_nn = 1
ACROSS = rc.LinearFlow(np.array([[0.0, 0, 1], [0, 0, 0], [1, 0, 0]]))  # e_xz = 1 with n along z
ROUGH = {"S_axi": 1e-5, "S_xz": 1e-5}


def free_stresslet(response, flow):
    """Stresslet (3, 3) of the force- and torque-free aggregate."""
    grand = response.grand_resistance
    free = grand[6:, 6:] - grand[6:, :6] @ np.linalg.solve(grand[:6, :6], grand[:6, 6:])
    return strain_tensor(free @ strain_components(flow.strain_rate))


def measures(order):
    """The quantities of the file, by its definitions."""
    response = rc.rigid_response(DOUBLET, rc.StokesianDynamics(order=order), viscosity=1.0)
    aggregate = rc.Aggregate.touching(DOUBLET)
    resistance = response.resistance
    bretherton = float(np.einsum("jk,jk", response.rotation_coupling[1], ACROSS.strain_rate))
    return {
        "X_drag": resistance[2, 2] / 2 / (6 * pi),
        "Y_drag": resistance[0, 0] / 2 / (6 * pi),
        "X_rot": resistance[5, 5] / 2 / (8 * pi),
        "Y_rot": resistance[3, 3] / (8 * pi),
        "c_n": rc.contact_loads(aggregate, response.loads(ALONG)).tension[0],
        "c_t": rc.contact_loads(aggregate, response.loads(ACROSS)).shear[0],
        "B_jeffery": bretherton,
        "r_e": np.sqrt((1 + bretherton) / (1 - bretherton)),
        "S_axi": free_stresslet(response, ALONG)[2, 2],
        "S_xz": free_stresslet(response, ACROSS)[0, 2],
    }


@pytest.fixture(scope="module")
def order_two():
    return measures(2)


@pytest.fixture(scope="module")
def order_eight():
    return measures(8)


@pytest.mark.parametrize("name", REFERENCE["order_2"])
def test_order_two(order_two, name):
    assert abs(order_two[name]) == pytest.approx(REFERENCE["order_2"][name], rel=ROUGH.get(name, 1e-6))


def test_tension_at_order_two_in_eight_digits(order_two):
    """The number by which the method is known: 35.903916 μ a² e_nn, positive when the doublet is pulled apart."""
    assert order_two["c_n"] == pytest.approx(35.903916, abs=5e-7)


def test_contact_force_is_along_the_axis_and_without_moment():
    """By symmetry the doublet's one contact carries no moment in either strain, and no shear in the axial one."""
    response = rc.rigid_response(DOUBLET, rc.StokesianDynamics(order=2), viscosity=1.0)
    aggregate = rc.Aggregate.touching(DOUBLET)
    for flow in (ALONG, ACROSS):
        assert np.abs(rc.contact_loads(aggregate, response.loads(flow)).moment).max() < 1e-12
    assert rc.contact_loads(aggregate, response.loads(ALONG)).shear[0] < 1e-12


@pytest.mark.parametrize("name", REFERENCE["converged"])
def test_order_eight_is_near_the_converged_value(order_eight, name):
    """An independent Galerkin solver gives +0.01 % for the tension at order 8; drags, spins and stresslets feel less.

    The shear converges more slowly, and like the tension not from one side: the projection by quadrature of
    tests/agreement, which knows nothing of the package, has it 0.40 % above at order 6, 0.14 % above at order 8 and
    0.04 % below at order 12.
    """
    tolerance = 1.5e-3 if name == "c_t" else 2e-4
    assert abs(order_eight[name]) == pytest.approx(REFERENCE["converged"][name], rel=tolerance)


def test_tension_of_every_order():
    """Doublet tension by an independent Galerkin solver, to its digits."""
    printed = {2: 35.9039, 3: 37.784, 4: 38.378, 5: 38.494, 6: 38.480, 8: 38.433}
    aggregate = rc.Aggregate.touching(DOUBLET)
    for order, tension in printed.items():
        response = rc.rigid_response(DOUBLET, rc.StokesianDynamics(order=order), viscosity=1.0)
        assert rc.contact_loads(aggregate, response.loads(ALONG)).tension[0] == pytest.approx(tension, abs=6e-4)


def test_axial_drag_of_nir_and_acrivos(order_eight):
    """Nir & Acrivos (1973), table 2, as quoted in the reference file, in the digits of the table."""
    printed = re.search(r"\((\d\.\d{3})/12", REFERENCE["printed"]["X_drag"])
    assert order_eight["X_drag"] == pytest.approx(float(printed[1]) / 12, abs=2e-4)  # 7.740 and 7.742 as converged


def test_largest_tension_in_simple_shear():
    """c_n/2 per unit shear rate, when the axis lies along the direction of stretching, (x + y)/√2 in u = (y, 0, 0)."""
    axis = np.array([1.0, 1, 0]) / np.sqrt(2)
    spheres = rc.Spheres(np.array([-axis, axis]), 1.0)
    response = rc.rigid_response(spheres, rc.StokesianDynamics(order=2), viscosity=1.0)
    carried = rc.contact_loads(rc.Aggregate.touching(spheres), response.loads(rc.simple_shear(1.0)))
    assert carried.tension[0] == pytest.approx(REFERENCE["order_2"]["c_n"] / 2, rel=1e-8)
