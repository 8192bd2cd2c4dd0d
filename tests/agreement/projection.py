"""Galerkin method of any order by quadrature over the spheres' surfaces.

Written from its definition and apart from the package: no rotation of pairs, no translation
formulas. The density a² · traction of each sphere is expanded in vector spherical harmonics of the unit direction u,

    W_n = ∇s Y + n Y u (n = 1 … p),   X_n = u × ∇s Y (n = 1 … p−1),   V_n = ∇s Y − (n+1) Y u (n = 1 … p−2),

and the velocity that it makes is projected on the same functions over every sphere.
"""

from math import factorial

import numpy as np
from numpy.polynomial import Legendre

from rheoclast.vectors import STRAIN_BASIS


def sphere_quadrature(nodes):
    """Directions (P, 3) and weights (P,): Gauss–Legendre in z, uniform around it; exact to degree 2·nodes − 1."""
    z, weight = np.polynomial.legendre.leggauss(nodes)
    azimuth = np.arange(2 * nodes) * np.pi / nodes
    across = np.sqrt(1 - z**2)[:, None]
    directions = np.stack(
        [across * np.cos(azimuth), across * np.sin(azimuth), np.broadcast_to(z[:, None], (nodes, 2 * nodes))], axis=-1
    )
    return directions.reshape(-1, 3), np.repeat(weight * np.pi / nodes, 2 * nodes)


def harmonic(degree, order, directions):
    """Real spherical harmonic Y (P,) and its surface gradient (P, 3), orthonormal on the unit sphere.

    Y = c · Re or Im (x + iy)^|m| · d^|m| P_n/dz^|m|, whose gradient in space is a polynomial; the part along the
    sphere is what remains without its radial component. No pole is special.
    """
    m = abs(order)
    norm = np.sqrt((2 * degree + 1) / (4 * np.pi) * factorial(degree - m) / factorial(degree + m) * (2 if m else 1))
    part = np.imag if order < 0 else np.real
    x, y, z = directions.T
    along_axis = Legendre.basis(degree).deriv(m) if m else Legendre.basis(degree)
    around = (x + 1j * y) ** m
    around_slope = m * (x + 1j * y) ** (m - 1) if m else np.zeros_like(around)
    value = norm * part(around) * along_axis(z)
    gradient = norm * np.stack(
        [
            part(around_slope) * along_axis(z),
            part(1j * around_slope) * along_axis(z),
            part(around) * along_axis.deriv()(z),
        ],
        axis=-1,
    )
    return value, gradient - directions * np.sum(gradient * directions, axis=-1, keepdims=True)


def families(degree, order, directions):
    """V, W, X (each (P, 3)) of one degree and order."""
    value, gradient = harmonic(degree, order, directions)
    radial = value[:, None] * directions
    return gradient - (degree + 1) * radial, gradient + degree * radial, np.cross(directions, gradient)


def modes(order):
    """(family, degree, m) of all modes of order p: 3 for p = 1, 3p² − 1 above."""
    highest = {"W": order, "X": order - 1, "V": order - 2}
    return [(f, n, m) for f, last in highest.items() for n in range(1, last + 1) for m in range(-n, n + 1)]


def densities(order, directions):
    """The modes as densities on the unit sphere, (M, P, 3)."""
    return np.array([families(n, m, directions)["VWX".index(f)] for f, n, m in modes(order)])


def velocities(order, points):
    """Velocity (M, P, 3), at points on or outside the unit sphere, of every mode as single layer there; viscosity 1."""
    distance = np.linalg.norm(points, axis=-1, keepdims=True)
    directions = points / distance
    fields = []
    for family, n, m in modes(order):
        v, w, x = families(n, m, directions)
        fields.append(
            {
                "V": n / ((2 * n + 1) * (2 * n + 3)) * distance ** -(n + 2) * v,
                "W": (n + 1) / ((2 * n + 1) * (2 * n - 1)) * distance**-n * w
                + n / (4 * n + 2) * (distance ** -(n + 2.0) - distance**-n) * v,
                "X": 1 / (2 * n + 1) * distance ** -(n + 1) * x,
            }[family]
        )
    return np.array(fields)


def block(order, vector, target_radius, source_radius, nodes):
    """(M, M): velocity of the source's modes projected on the target's; `vector` from source to target.

    The integrand is analytic up to the source's centre, so that the error falls like
    (target radius / distance)^(2 · nodes), times a power of `nodes`.
    """
    directions, weights = sphere_quadrature(nodes)
    fields = velocities(order, (vector + target_radius * directions) / source_radius)
    return np.einsum("kpi,p,lpi->kl", densities(order, directions), weights, fields, optimize=True) / source_radius


def grand_operator(order, centers, radii, nodes):
    """(N, M, N, M). Every pair is integrated over its smaller sphere, and transposed for the other (G is symmetric)."""
    count, size = len(centers), len(modes(order))
    operator = np.empty((count, size, count, size))
    for i in range(count):
        for j in range(count):
            if (radii[i], i) <= (radii[j], j):
                distance = 0 * centers[i] if i == j else centers[i] - centers[j]
                operator[i, :, j] = block(order, distance, radii[i], radii[j], nodes)
                operator[j, :, i] = operator[i, :, j].T
    return operator


def probes(order, radii, nodes=12):
    """(N, M, 11): modes projected on the unit translations, rotations and strains of each sphere."""
    directions, weights = sphere_quadrature(nodes)
    turning = np.cross(np.eye(3)[:, None], directions)
    straining = np.einsum("kij,pj->kpi", STRAIN_BASIS, directions)
    unit = np.broadcast_to(np.eye(3)[:, None], (3, len(directions), 3))
    shapes = np.concatenate([unit, turning, straining])
    projected = np.einsum("kpi,p,lpi->kl", densities(order, directions), weights, shapes)
    scale = np.repeat([0, 1], [3, 8])
    return np.array([projected * radius**scale for radius in radii])
