"""No slip, as the Galerkin method of order 2 defines it: over every sphere's surface the fluid moves with the sphere.

The package says which force and torque each sphere bears. Here its traction is F/4πa² + 3 L×n/8πa³ + 3 S·n/4πa³, with
the stresslets S, which nothing in the package shows, found from the condition that no sphere is strained on average.
Then the disturbance plus the ambient flow must average to the sphere's velocity and spin: that is left to test.
"""

from functools import cache
from math import pi

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.vectors import STRAIN_BASIS, strain_components

CENTERS = np.array([[0.3, -0.7, 1.1], [2.3, -0.7, 1.1], [2.3, 0.86, 2.27], [0.3, -0.7, -0.4]])
SPHERES = {
    "trimer": rc.Spheres(CENTERS[:3], np.array([1.0, 1.0, 0.95])),
    "unequal": rc.Spheres(CENTERS, np.array([1.0, 1.0, 0.95, 0.5])),
}
FLOW = rc.LinearFlow(np.array([[0.3, 1.1, -0.4], [0.2, -0.9, 0.7], [-1.3, 0.5, 0.6]]))


@cache
def sphere_quadrature(nodes):
    """Gauss–Legendre by uniform: directions (P, 3) and weights (P,) of a mean over the sphere."""
    z, weight = np.polynomial.legendre.leggauss(nodes)
    azimuth = np.arange(2 * nodes) * pi / nodes
    across = np.sqrt(1 - z**2)
    directions = np.array(
        [[rho * np.cos(p), rho * np.sin(p), height] for rho, height in zip(across, z, strict=True) for p in azimuth]
    )
    return directions, np.repeat(weight, 2 * nodes) / (4 * nodes)


def disturbance(points, radius, force, torque, stresslet):
    """Flow (P, 3) at `points`, from the centre of one sphere, of its loads on the fluid; viscosity 1.

    Stokeslet and stresslet with the terms of the sphere's size: F/8πr (1 + a²/3r²) + …, L×r/8πr³,
    3 r (r·S·r)/8πr⁵ (1 − a²/r²) + 6 a² S·r/40πr⁵.
    """
    r2 = np.sum(points**2, axis=1, keepdims=True)
    r = np.sqrt(r2)
    stokeslet = (1 + radius**2 / (3 * r2)) * force + (1 - radius**2 / r2) * points * (points @ force)[:, None] / r2
    strained = points @ stresslet
    along = np.sum(points * strained, axis=1, keepdims=True)
    straining = 3 * points * along / r**5 * (1 - radius**2 / r2) + 6 / 5 * radius**2 * strained / r**5
    return (stokeslet / r + np.cross(torque, points) / r**3 + straining) / (8 * pi)


def pressure(points, force, stresslet):
    """Pressure (P,) of the same: F·r/4πr³ + 3 r·S·r/4πr⁵; viscosity 1."""
    r = np.linalg.norm(points, axis=1)
    return (points @ force / r**3 + 3 * np.sum(points * (points @ stresslet), axis=1) / r**5) / (4 * pi)


LOADS = {
    "force": (np.array([0.3, -1, 2]), np.zeros(3), np.zeros((3, 3))),
    "torque": (np.zeros(3), np.array([1.0, 0.4, -2]), np.zeros((3, 3))),
    "stresslet": (np.zeros(3), np.zeros(3), np.array([[0.4, 1, -0.5], [1, -1.1, 0.3], [-0.5, 0.3, 0.7]])),
}


@pytest.mark.parametrize("name", LOADS)
class TestFieldOfOneSphere:
    """The field that the averages below rest on, against what it is defined by."""

    RADIUS = 0.8
    POINTS = np.array([[1.1, -0.7, 0.9], [-1.5, 0.4, 0.2], [0.1, 1.3, 1.0]])

    def test_is_the_oseen_integral_of_the_traction(self, name):
        """Points at 1.6 radii or more: 1.6^-80 of the quadrature's error is left."""
        force, torque, stresslet = LOADS[name]
        n, mean = sphere_quadrature(40)
        a = self.RADIUS
        traction = (
            force / (4 * pi * a**2) + 3 * np.cross(torque, n) / (8 * pi * a**3) + 3 * n @ stresslet / (4 * pi * a**3)
        )
        apart = self.POINTS[:, None] - a * n
        r = np.linalg.norm(apart, axis=-1)
        weights = 4 * pi * a**2 * mean
        direct = np.einsum("q,pq,qi->pi", weights, 1 / r, traction)
        direct += np.einsum("q,pq,pqi,pqj,qj->pi", weights, r**-3, apart, apart, traction, optimize=True)
        ours = disturbance(self.POINTS, a, force, torque, stresslet)
        np.testing.assert_allclose(ours, direct / (8 * pi), atol=1e-13)

    def test_on_the_sphere_is_a_rigid_motion_and_a_strain(self, name):
        """U = F/6πa, Ω = L/8πa³, E = 3S/20πa³ pointwise on the surface."""
        force, torque, stresslet = LOADS[name]
        a = self.RADIUS
        points = a * sphere_quadrature(6)[0]
        spin, strain = torque / (8 * pi * a**3), 3 * stresslet / (20 * pi * a**3)
        expected = force / (6 * pi * a) + np.cross(spin, points) + points @ strain
        np.testing.assert_allclose(disturbance(points, a, force, torque, stresslet), expected, atol=1e-14)

    def test_is_divergence_free_and_obeys_the_stokes_equation(self, name):
        """∇·u = 0 and ∇²u = ∇p by central differences.

        Second order: errors fall by four when the step is halved, until nothing but the residual would be left.
        """
        force, torque, stresslet = LOADS[name]
        unit = np.eye(3)

        def u(points):
            return disturbance(points, self.RADIUS, force, torque, stresslet)

        def residuals(h):
            ahead, behind = (np.array([u(self.POINTS + sign * h * e) for e in unit]) for sign in (1, -1))
            divergence = np.einsum("kpk->p", ahead - behind) / (2 * h)
            laplacian = (ahead + behind - 2 * u(self.POINTS)).sum(axis=0) / h**2
            p = [
                pressure(self.POINTS + h * e, force, stresslet) - pressure(self.POINTS - h * e, force, stresslet)
                for e in unit
            ]
            return np.abs(divergence).max(), np.abs(laplacian - np.array(p).T / (2 * h)).max()

        coarse, fine = np.array(residuals(0.02)), np.array(residuals(0.01))
        assert np.all(fine < 1e-3)
        assert np.all((fine < coarse / 3.9) | (coarse < 1e-12))  # a rotlet's divergence vanishes to rounding at once


def surface_averages(spheres, force, torque, stresslet):
    """Mean velocity, angular velocity and strain components (N, 11) of every surface in the flow of all loads.

    ⟨u⟩, 3/2a ⟨n×u⟩ and 3/a ⟨sym n u⟩. A sphere's centre is at least two of the other's radii from it, or three for
    the smaller: 40 nodes leave (2/3)^80 = 1e-14 at worst.
    """
    n, mean = sphere_quadrature(40)
    averages = []
    for center, radius in zip(spheres.centers, spheres.radii, strict=True):
        surface = center + radius * n
        u = sum(
            disturbance(surface - spheres.centers[j], spheres.radii[j], force[j], torque[j], stresslet[j])
            for j in range(len(spheres))
        )
        strain = 3 / radius * np.einsum("p,pi,pj->ij", mean, n, u)
        averages.append(np.concatenate([mean @ u, 1.5 / radius * mean @ np.cross(n, u), strain_components(strain)]))
    return np.array(averages)


def stresslets_without_strain(spheres, force, torque, ambient_strain):
    """The stresslets (N, 3, 3) on the fluid for which no surface is strained on average, the loads being given."""
    count = len(spheres)
    none = np.zeros((count, 3))
    response = np.empty((count, 5, count, 5))
    for j in range(count):
        for k in range(5):
            unit = np.zeros((count, 3, 3))
            unit[j] = STRAIN_BASIS[k]
            response[:, :, j, k] = surface_averages(spheres, none, none, unit)[:, 6:]
    strained = surface_averages(spheres, force, torque, np.zeros((count, 3, 3)))[:, 6:] + ambient_strain
    components = -np.linalg.solve(response.reshape(5 * count, 5 * count), strained.ravel()).reshape(count, 5)
    return np.einsum("nk,kij->nij", components, STRAIN_BASIS)


def check(response, loads, velocity, angular_velocity, gradient):
    """Averages of disturbance + ambient equal the rigid motion on every sphere; returns the whole stresslet on it."""
    spheres = response.spheres
    force, torque = -loads.force, -loads.torque  # of the spheres on the fluid
    strain = strain_components((gradient + gradient.T) / 2)
    stresslet = stresslets_without_strain(spheres, force, torque, strain)
    averages = surface_averages(spheres, force, torque, stresslet)
    spin = 0.5 * np.array(
        [gradient[2, 1] - gradient[1, 2], gradient[0, 2] - gradient[2, 0], gradient[1, 0] - gradient[0, 1]]
    )
    moved = velocity + np.cross(angular_velocity, spheres.centers - response.center)
    tolerance = 1e-11 * max(np.abs(averages).max(), 1.0)
    np.testing.assert_allclose(averages[:, :3] + spheres.centers @ gradient.T, moved, atol=tolerance)
    np.testing.assert_allclose(averages[:, 3:6] + spin, np.tile(angular_velocity, (len(spheres), 1)), atol=tolerance)
    lever = np.einsum("ni,nj->ij", spheres.centers - response.center, loads.force)
    return strain_components(lever - stresslet.sum(axis=0))


@pytest.fixture(params=SPHERES)
def response(request):
    return rc.rigid_response(SPHERES[request.param], rc.StokesianDynamics(order=2), viscosity=1.0)


def test_free_aggregate(response):
    motion = response.motion(FLOW)
    stresslet = check(response, response.loads(FLOW), motion.velocity, motion.angular_velocity, FLOW.gradient)
    grand = response.grand_resistance
    free = grand[6:, 6:] - grand[6:, :6] @ response.mobility @ grand[:6, 6:]
    np.testing.assert_allclose(
        stresslet, free @ strain_components(FLOW.strain_rate), atol=1e-10 * np.abs(stresslet).max()
    )


def test_held_aggregate(response):
    stresslet = check(response, response.held(FLOW), np.zeros(3), np.zeros(3), FLOW.gradient)
    components = strain_components(FLOW.strain_rate)
    ambient = np.concatenate([FLOW.velocity(response.center), FLOW.angular_velocity, components])
    np.testing.assert_allclose(stresslet, response.grand_resistance[6:] @ ambient, atol=1e-10 * np.abs(stresslet).max())


def test_settling_aggregate(response):
    settling = response.settling(np.array([1.0, -2, 0.5]))
    stresslet = check(response, settling.loads, settling.velocity, settling.angular_velocity, np.zeros((3, 3)))
    moving = np.concatenate([settling.velocity, settling.angular_velocity])
    np.testing.assert_allclose(
        stresslet, -response.grand_resistance[6:, :6] @ moving, atol=1e-10 * np.abs(stresslet).max()
    )
