"""Stokesian dynamics of orders 1 to 4 ↔ Galerkin projection by quadrature over the spheres' surfaces.

Each pair is integrated over its smaller sphere, which sees the other's centre at two of its radii or more, so that the
quadrature errs like 2^(−2 nodes) times a power of the nodes. Against 60 nodes, the loads at order 4 of the worst
cluster here move by 5e-5 with 10 nodes, 1e-9 with 20, 2e-14 with 30. With 40 the routes must meet to
1e-10 of the largest load.
"""

from math import pi

import numpy as np
import pytest

import rheoclast as rc

from . import projection
from .clusters import sticking_cluster
from .elementary import eleven_problems

TURN = np.array([[2.0, -1, 2], [2, 2, -1], [-1, 2, 2]]) / 3  # a rotation: no axis of any cluster lies along x, y or z

CLUSTERS = {
    "doublet": (np.array([[0.0, 0, 0], [0, 0, 2]]), np.ones(2)),
    "turned doublet": (np.array([[0.0, 0, 0], [0, 0, 2]]) @ TURN.T, np.ones(2)),
    "unequal doublet": (np.array([[0.0, 0, 0], [0, 0, 1.5]]) @ TURN.T, np.array([0.5, 1.0])),
    "very unequal doublet": (np.array([[0.0, 0, 0], [0, 0, 1.2]]) @ TURN.T, np.array([0.2, 1.0])),
    "bent trimer": (np.array([[2.0, 0, 0], [0, 0, 0], [-0.4, 0.0, np.sqrt(3.84)]]) @ TURN.T, np.ones(3)),
    "polydisperse five": sticking_cluster(5, 6, (0.5, 1.0)),
}


def close(ours, reference, scale=None):
    scale = np.abs(reference).max() if scale is None else scale
    np.testing.assert_allclose(ours, reference, rtol=0, atol=1e-10 * scale)


@pytest.fixture(scope="module", params=[(name, order) for name in CLUSTERS for order in (1, 2, 3, 4)], ids=str)
def routes(request):
    name, order = request.param
    centers, radii = CLUSTERS[name]
    operator = projection.grand_operator(order, centers, radii, nodes=40)
    reference = eleven_problems(operator, projection.probes(order, radii), centers, radii)
    response = rc.rigid_response(rc.Spheres(centers, radii), rc.StokesianDynamics(order=order), viscosity=1.0)
    return response, reference, order


def test_quadrature_has_converged():
    """What the tolerance rests on: geometric, ten more nodes gaining 2^-20 = 1e-6 less a power of the nodes."""
    centers, radii = CLUSTERS["bent trimer"]

    def table(nodes):
        operator = projection.grand_operator(4, centers, radii, nodes)
        return eleven_problems(operator, projection.probes(4, radii), centers, radii).table

    settled = table(40)
    error = [np.abs(table(nodes) - settled).max() / np.abs(settled).max() for nodes in (10, 20, 30)]
    assert error[1] < 1e-4 * error[0]
    assert error[2] < 1e-12


def test_loads_of_the_free_aggregate(routes):
    response, reference, _ = routes
    close(response.table, reference.table)


def test_order_one_has_forces_and_no_torques(routes):
    response, _, order = routes
    largest = np.abs(response.table[:, :3]).max()
    if order == 1:
        assert np.abs(response.table[:, 3:]).max() < 1e-12 * largest
    else:
        assert np.abs(response.table[:, 3:]).max() > 1e-3 * largest


def test_grand_resistance(routes):
    response, reference, _ = routes
    close(response.grand_resistance, reference.grand_resistance)


def test_scalars(routes):
    response, reference, _ = routes
    radii = response.spheres.radii
    assert response.intrinsic_viscosity == pytest.approx(reference.intrinsic_viscosity(radii), rel=1e-10)


@pytest.mark.parametrize("order", [6, 9])
@pytest.mark.parametrize("name", ["turned doublet", "unequal doublet"])
def test_high_orders(name, order):
    """The same at orders whose modes nobody writes out (107 and above per sphere)."""
    centers, radii = CLUSTERS[name]
    operator = projection.grand_operator(order, centers, radii, nodes=40)
    reference = eleven_problems(operator, projection.probes(order, radii), centers, radii)
    response = rc.rigid_response(rc.Spheres(centers, radii), rc.StokesianDynamics(order=order), viscosity=1.0)
    close(response.table, reference.table)
    close(response.grand_resistance, reference.grand_resistance)


def test_resistance_of_a_bent_trimer_at_order_one_by_hand():
    """Order 1 is the Rotne–Prager level: mobility δ/6π on a sphere, (1 + ∇²/3) G / 8π between equal ones.

    With r = 2: 1/8πr [(1 + 2/3r²) 1 + (1 − 2/r²) r̂r̂]. Forces on a rigid body solve the 9 × 9 system.
    """
    centers, radii = CLUSTERS["bent trimer"]
    mobility = np.zeros((3, 3, 3, 3))
    for i in range(3):
        for j in range(3):
            vector = centers[i] - centers[j]
            r = np.linalg.norm(vector)
            pair = (1 + 2 / (3 * r**2)) * np.eye(3) + (1 - 2 / r**2) * np.outer(vector, vector) / r**2 if i != j else 0
            mobility[i, :, j] = np.eye(3) / (6 * pi) if i == j else pair / (8 * pi * r)
    offsets = centers - centers.mean(axis=0)
    motion = np.concatenate(
        [np.tile(np.eye(3), (3, 1)), np.vstack([np.cross(np.eye(3), d).T for d in offsets])], axis=1
    )
    resistance = motion.T @ np.linalg.solve(mobility.reshape(9, 9), motion)
    response = rc.rigid_response(rc.Spheres(centers, radii), rc.StokesianDynamics(order=1), viscosity=1.0)
    close(response.resistance, resistance)
