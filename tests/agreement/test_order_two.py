"""Order 2 of Stokesian dynamics ↔ Faxén's laws in closed form, all eleven problems of random clusters.

Both routes are exact up to rounding. The condition number of the mobility is below 10³ in radii, so that 1e-10 of the
largest entry leaves four decades above rounding and none for a wrong coefficient.
"""

import numpy as np
import pytest

import rheoclast as rc

from . import faxen
from .clusters import sticking_cluster, traceless_gradient
from .elementary import eleven_problems

CASES = {
    "doublet": (2, 1, 1.0),
    "unequal doublet": (2, 2, (0.5, 1.5)),
    "seven equal": (7, 3, 1.0),
    "nine polydisperse": (9, 4, (0.4, 1.3)),
    "twelve equal": (12, 5, 0.8),
}


def close(ours, reference, scale=None):
    """Equal to 1e-10 of `scale`: the largest entry, unless symmetry can make all entries vanish."""
    scale = np.abs(reference).max() if scale is None else scale
    np.testing.assert_allclose(ours, reference, rtol=0, atol=1e-10 * scale)


@pytest.fixture(scope="module", params=CASES)
def routes(request):
    """The package's response and the closed-form route on one cluster."""
    centers, radii = sticking_cluster(*CASES[request.param])
    reference = eleven_problems(faxen.grand_mobility(centers, radii), faxen.probes(len(radii)), centers, radii)
    return rc.rigid_response(rc.Spheres(centers, radii), rc.StokesianDynamics(order=2), viscosity=1.0), reference


def test_center(routes):
    close(routes[0].center, routes[1].center)


def test_grand_resistance(routes):
    """Block by block, so that the small blocks count as much as the large."""
    response, reference = routes
    parts = (slice(0, 3), slice(3, 6), slice(6, 11))
    for rows in parts:
        for columns in parts:
            scale = np.sqrt(np.abs(np.diag(reference.grand_resistance)[rows]).max())
            scale *= np.sqrt(np.abs(np.diag(reference.grand_resistance)[columns]).max())
            difference = response.grand_resistance[rows, columns] - reference.grand_resistance[rows, columns]
            assert np.abs(difference).max() < 1e-10 * scale


def test_resistance_and_mobility(routes):
    response, reference = routes
    close(response.resistance, reference.grand_resistance[:6, :6])
    close(response.mobility, np.linalg.inv(reference.grand_resistance[:6, :6]))


def test_table_and_strain_loads(routes):
    response, reference = routes
    close(response.table, reference.table)
    close(response.strain_loads.force, np.moveaxis(reference.table[:, :3], 2, 0))
    close(response.strain_loads.torque, np.moveaxis(reference.table[:, 3:], 2, 0))


def ambient_at_center(response, gradient):
    """Velocity, angular velocity and strain components of the flow at the centre, (11,)."""
    spin = 0.5 * np.array(
        [gradient[2, 1] - gradient[1, 2], gradient[0, 2] - gradient[2, 0], gradient[1, 0] - gradient[0, 1]]
    )
    strain = rc.vectors.strain_components((gradient + gradient.T) / 2)
    return np.concatenate([gradient @ response.center, spin, strain])


def test_motion_and_couplings(routes):
    response, reference = routes
    close(response.translation_coupling, reference.couplings[0], scale=response.spheres.radii.max())
    close(response.rotation_coupling, reference.couplings[1])
    gradient = traceless_gradient(11)
    ambient = ambient_at_center(response, gradient)
    motion = response.motion(rc.LinearFlow(gradient))
    expected = ambient[:6] + reference.slip @ ambient[6:]
    close(motion.velocity, expected[:3])
    close(motion.angular_velocity, expected[3:])


def test_free_and_held_loads(routes):
    response, reference = routes
    gradient = traceless_gradient(12)
    ambient = ambient_at_center(response, gradient)
    free, held = response.loads(rc.LinearFlow(gradient)), response.held(rc.LinearFlow(gradient))
    close(np.hstack([free.force, free.torque]), reference.table @ ambient[6:])
    close(np.hstack([held.force, held.torque]), (reference.held @ ambient)[:, :6])


def test_settling(routes):
    response, reference = routes
    force = np.array([0.3, -1.2, 0.7])
    settling = response.settling(force)
    motion = np.linalg.inv(reference.grand_resistance[:6, :6])[:, :3] @ force
    close(settling.velocity, motion[:3])
    close(settling.angular_velocity, motion[3:], scale=np.linalg.norm(motion[:3]))
    loads = -(reference.held[:, :6, :6] @ motion)
    close(np.hstack([settling.loads.force, settling.loads.torque]), loads)


def test_scalars(routes):
    response, reference = routes
    assert response.hydrodynamic_radius == pytest.approx(reference.hydrodynamic_radius, rel=1e-10)
    radii = response.spheres.radii
    assert response.intrinsic_viscosity == pytest.approx(reference.intrinsic_viscosity(radii), rel=1e-10)
