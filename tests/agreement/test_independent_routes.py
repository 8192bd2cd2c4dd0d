"""The routes that the package is measured against, by themselves: no package result enters here.

They would be worth nothing if they shared an error, so each is checked against the definition it claims to implement.
"""

import json
from math import pi
from pathlib import Path

import numpy as np
import pytest
from scipy.special import sph_harm_y

from . import faxen, projection
from .clusters import sticking_cluster
from .elementary import STRAIN_BASIS, eleven_problems

DOUBLET = np.array([[0.0, 0, -1], [0, 0, 1]])
REFERENCE = json.loads((Path(__file__).parents[1] / "published" / "reference" / "doublet.json").read_text())


def oseen(vector):
    distance = np.linalg.norm(vector, axis=-1)[..., None, None]
    return np.eye(3) / distance + vector[..., :, None] * vector[..., None, :] / distance**3


def laplacian_of_oseen(vector):
    distance = np.linalg.norm(vector)
    return 2 * np.eye(3) / distance**3 - 6 * np.outer(vector, vector) / distance**5


def central_difference(function, vector, step=1e-3):
    """Derivative along each axis, appended as last axis; fourth order in the step."""
    slopes = [
        (8 * (function(vector + e) - function(vector - e)) - function(vector + 2 * e) + function(vector - 2 * e)) / 12
        for e in step * np.eye(3)
    ]
    return np.stack(slopes, axis=-1) / step


VECTOR = np.array([1.3, -1.1, 1.9])


def test_tensors_of_order_zero_are_the_oseen_tensor_and_its_laplacian():
    np.testing.assert_allclose(faxen.oseen_derivative(0, VECTOR), oseen(VECTOR), rtol=1e-13)
    np.testing.assert_allclose(faxen.oseen_laplacian_derivative(0, VECTOR), laplacian_of_oseen(VECTOR), rtol=1e-13)


@pytest.mark.parametrize("tensor", [faxen.oseen_derivative, faxen.oseen_laplacian_derivative])
@pytest.mark.parametrize("order", [1, 2])
def test_tensor_derivatives_match_finite_differences(tensor, order):
    """Step 1e-3: truncation 1e-12 and rounding 1e-13 of the value."""
    differences = central_difference(lambda x: tensor(order - 1, x), VECTOR)
    np.testing.assert_allclose(tensor(order, VECTOR), differences, atol=1e-10)


def test_laplacian_tensors_are_traces_of_higher_derivatives():
    for order in (0, 1):
        traced = np.trace(faxen.oseen_derivative(order + 2, VECTOR), axis1=-1, axis2=-2)
        np.testing.assert_allclose(faxen.oseen_laplacian_derivative(order, VECTOR), traced, atol=1e-13)


def single_layers(points, tractions, radius, nodes):
    """Velocities (K, P, 3) of tractions (K, Q, 3) on a sphere at the origin, by the Oseen surface integral itself.

    `tractions` is a function of the directions (Q, 3). At s radii from the centre they err like s^(−2 nodes).
    """
    directions, weights = projection.sphere_quadrature(nodes)
    kernel = oseen(points[:, None] - radius * directions)
    return np.einsum("pqij,kqj,q->kpi", kernel, tractions(directions), weights * radius**2, optimize=True) / (8 * pi)


def test_faxen_pair_block_averages_the_oseen_integral_over_the_target():
    """Pair blocks by Faxén equal surface averages of the flow of force, torque and stresslet tractions.

    The tractions are F/4πa², 3 L×u/8πa³, 3 S·u/4πa³; the averages ⟨v⟩, 3/2b ⟨u×v⟩, 3/b ⟨sym u v⟩ give back U, Ω and E
    of any motion U + Ω×bu + E·bu. Unequal spheres 0.7 and 1.1 at distance 2.6, so that no radius can hide behind the
    other; the nearest point is 2.1 source radii away: 2.1^-48 = 3e-16.
    """
    source, target, vector = 0.7, 1.1, 2.6 * np.array([2.0, -1, 2]) / 3

    def tractions(u):
        pushing = np.broadcast_to(np.eye(3)[:, None], (3, len(u), 3)) / (4 * pi * source**2)
        turning = 3 * np.cross(np.eye(3)[:, None], u) / (8 * pi * source**3)
        straining = 3 * np.einsum("kij,pj->kpi", STRAIN_BASIS, u) / (4 * pi * source**3)
        return np.concatenate([pushing, turning, straining])

    directions, weights = projection.sphere_quadrature(24)
    velocity = single_layers(vector + target * directions, tractions, source, nodes=24)
    mean = weights / (4 * pi)
    averages = np.vstack(
        [
            np.einsum("p,kpi->ik", mean, velocity),
            1.5 / target * np.einsum("p,kpi->ik", mean, np.cross(directions, velocity)),
            3 / target * np.einsum("p,sij,pi,kpj->sk", mean, STRAIN_BASIS, directions, velocity),
        ]
    )
    np.testing.assert_allclose(faxen.pair_block(vector, target, source), averages, atol=1e-12)


def test_harmonics_are_those_of_scipy():
    """Real combinations of SciPy's complex harmonics, up to the sign (−1)^m of its phase convention."""
    directions, _ = projection.sphere_quadrature(5)
    theta, phi = np.arccos(directions[:, 2]), np.arctan2(directions[:, 1], directions[:, 0])
    for n in range(1, 6):
        for m in range(-n, n + 1):
            complex_value = (-1) ** m * sph_harm_y(n, abs(m), theta, phi) * (np.sqrt(2) if m else 1)
            expected = complex_value.imag if m < 0 else complex_value.real
            np.testing.assert_allclose(projection.harmonic(n, m, directions)[0], expected, atol=1e-13)


def test_surface_gradients_match_differences_along_the_sphere():
    """Differences of Y(x/|x|) in space are the surface gradient; the poles are among the points."""
    points = np.array([[0, 0, 1.0], [0, 0, -1], [1, 0, 0], [0.6, 0.48, 0.64]])
    for n in range(1, 5):
        for m in range(-n, n + 1):
            for point in points:

                def value(x, n=n, m=m):
                    return projection.harmonic(n, m, (x / np.linalg.norm(x))[None])[0][0]

                gradient = projection.harmonic(n, m, point[None])[1][0]
                np.testing.assert_allclose(gradient, central_difference(value, point), atol=1e-10)


def test_vector_harmonics_are_orthogonal_with_the_stated_norms():
    directions, weights = projection.sphere_quadrature(12)
    norms = {"V": lambda n: (n + 1) * (2 * n + 1), "W": lambda n: n * (2 * n + 1), "X": lambda n: n * (n + 1)}
    shapes = projection.densities(4, directions)
    products = np.einsum("kpi,p,lpi->kl", shapes, weights, shapes)
    expected = np.diag([norms[family](n) for family, n, _ in projection.modes(4)])
    np.testing.assert_allclose(products, expected, atol=1e-12)


@pytest.mark.parametrize("distance", [1.6, 2.5])
def test_exterior_fields_are_single_layers(distance):
    """The three exterior fields of the hierarchy against the Oseen surface integral of their tractions."""
    points = distance * np.array([[0.6, 0.48, 0.64], [-0.8, 0.36, 0.48], [0, 0, 1]])
    direct = single_layers(points, lambda u: projection.densities(4, u), 1.0, nodes=40)
    np.testing.assert_allclose(projection.velocities(4, points), direct, atol=1e-12)


def test_projection_converges_geometrically_and_either_sphere_serves():
    """The quadrature error falls like (target radius / distance)^(2 nodes), and the blocks are reciprocal."""
    vector = 3 * np.array([2.0, -1, 2]) / 3
    exact = projection.block(4, vector, 1.0, 2.0, 40)
    errors = [np.abs(projection.block(4, vector, 1.0, 2.0, nodes) - exact).max() for nodes in (8, 12, 16, 24)]
    assert errors[1] < errors[0] / 3**6  # (1/3)^8 per four nodes, less a power of the nodes
    assert errors[2] < errors[1] / 3**6
    assert errors[3] < 1e-12
    np.testing.assert_allclose(projection.block(4, -vector, 2.0, 1.0, 80), exact.T, atol=1e-12)


@pytest.mark.parametrize("radii", [1.0, (0.5, 1.0)])
def test_quadrature_meets_faxen_at_order_two(radii):
    """Twenty nodes: (1/2)^40 = 1e-12 for equal spheres, less for unequal ones."""
    centers, radii = sticking_cluster(5, 3, radii)
    closed = eleven_problems(faxen.grand_mobility(centers, radii), faxen.probes(5), centers, radii)
    operator = projection.grand_operator(2, centers, radii, nodes=24)
    projected = eleven_problems(operator, projection.probes(2, radii), centers, radii)
    np.testing.assert_allclose(projected.held, closed.held, atol=1e-11 * np.abs(closed.held).max())


def test_faxen_route_gives_the_published_doublet():
    """Order 2 of doublet.json ("a second independent route, good to the digits shown"; its S values to 1e-5)."""
    doublet = eleven_problems(faxen.grand_mobility(DOUBLET, np.ones(2)), faxen.probes(2), DOUBLET, np.ones(2))
    grand, expected = doublet.grand_resistance, REFERENCE["order_2"]
    axial, transverse = np.diag([-0.5, -0.5, 1]), np.array([[0, 0, 1], [0, 0, 0], [1.0, 0, 0]])
    axial_load, transverse_load = (
        doublet.table @ (STRAIN_BASIS.reshape(5, 9) @ e.ravel()) for e in (axial, transverse)
    )
    spin = np.einsum("ijk,jk->i", doublet.couplings[1], transverse)[1]
    ours = {
        "X_drag": grand[2, 2] / (12 * pi),
        "Y_drag": grand[0, 0] / (12 * pi),
        "X_rot": grand[5, 5] / (16 * pi),
        "Y_rot": grand[3, 3] / (8 * pi),
        "c_n": axial_load[1, 2],
        "c_t": abs(transverse_load[1, 0]),
        "B_jeffery": spin,
        "r_e": np.sqrt((1 + spin) / (1 - spin)),
    }
    for name, value in ours.items():
        assert value == pytest.approx(expected[name], rel=2e-9), name
    stresslet = np.einsum("kij,kl,lmn->ijmn", STRAIN_BASIS, doublet.free_stresslet, STRAIN_BASIS)
    assert np.einsum("ijmn,mn->ij", stresslet, axial)[2, 2] == pytest.approx(expected["S_axi"], rel=1e-5)
    assert np.einsum("ijmn,mn->ij", stresslet, transverse)[0, 2] == pytest.approx(expected["S_xz"], rel=1e-5)


def test_quadrature_route_gives_the_orders_of_the_theory_notes():
    """Doublet tension per unit e_nn at orders 2 to 8, to the digits of an independent Galerkin solver."""
    printed = {2: 35.9039, 3: 37.784, 4: 38.378, 5: 38.494, 6: 38.480, 8: 38.433}
    strain = STRAIN_BASIS.reshape(5, 9) @ np.diag([-0.5, -0.5, 1]).ravel()
    for order, tension in printed.items():
        operator = projection.grand_operator(order, DOUBLET, np.ones(2), nodes=30)
        doublet = eleven_problems(operator, projection.probes(order, np.ones(2)), DOUBLET, np.ones(2))
        assert (doublet.table @ strain)[1, 2] == pytest.approx(tension, abs=6e-4), order
