"""Real spherical harmonics: values, products with the unit vector, rotations, and the quadrature that makes them.

Rounding grows with the degree; up to degree 12 it stays below 1e-13 of values of order one, and 1e-12 is asked for.
Lebedev's points (SciPy) are the independent quadrature, without poles or azimuths of the package's own kind.
"""

from math import gamma, pi

import numpy as np
import pytest
from numpy.polynomial import Legendre
from scipy.integrate import lebedev_rule

from rheoclast.stokes.harmonics import quarter_turn, raising, real_harmonics, sphere_quadrature
from rheoclast.stokes.pair_kernels import LANES
from rheoclast.stokes.pair_kernels import rotations as transposed_rotations
from rheoclast.vectors import STRAIN_BASIS

DEGREES = (0, 1, 2, 3, 5, 8, 12)
HIGHEST = 12
POLES = np.array([[0.0, 0, 1], [0, 0, -1]])


def some_directions(count, seed):
    """Random unit vectors (P, 3), after the poles and the other axes."""
    random = np.random.default_rng(seed).normal(size=(count, 3))
    axes = np.vstack([POLES, [[1.0, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]]])
    return np.vstack([axes, random / np.linalg.norm(random, axis=1, keepdims=True)])


def rotations(degree, directions):
    """Matrices (P, 2n + 1, 2n + 1) that carry z to the directions (P, 3), one per lane of the compiled function."""
    size = 2 * degree + 1
    quarter = np.zeros((degree + 1, size, size))
    for each in range(degree + 1):
        quarter[each, : 2 * each + 1, : 2 * each + 1] = quarter_turn(each)
    lanes = np.resize(directions, (LANES, 3))
    found = transposed_rotations(*np.ascontiguousarray(lanes.T), quarter)[degree, :size, :size, : len(directions)]
    return found.transpose(2, 1, 0)


def close(ours, expected):
    np.testing.assert_allclose(ours, expected, rtol=0, atol=1e-12)


class TestValues:
    def test_orthonormal_up_to_degree_twelve(self):
        """All 169 at once, so that degrees and orders are checked against one another too."""
        points, weights = lebedev_rule(2 * HIGHEST + 1)
        values = np.hstack([real_harmonics(degree, points.T) for degree in range(HIGHEST + 1)])
        close(np.einsum("q,qa,qb->ab", weights, values, values), np.eye((HIGHEST + 1) ** 2))

    def test_degree_one_is_the_unit_vector(self):
        """sqrt(3/4π) (y, z, x): the order on which force, torque and strain components rest."""
        u = some_directions(20, 1)
        close(real_harmonics(1, u), np.sqrt(3 / (4 * pi)) * u[:, [1, 2, 0]])

    def test_degree_two_is_the_strain_basis(self):
        """sqrt(15/8π) u·B_k·u, ordered like `STRAIN_BASIS`."""
        u = some_directions(20, 2)
        close(real_harmonics(2, u), np.sqrt(15 / (8 * pi)) * np.einsum("pi,kij,pj->pk", u, STRAIN_BASIS, u))

    @pytest.mark.parametrize("degree", DEGREES)
    def test_addition_theorem(self, degree):
        """Σ_m Y_m(u) Y_m(v) = (2n + 1)/4π P_n(u·v), poles included."""
        u, v = some_directions(20, 3), some_directions(15, 4)
        expected = (2 * degree + 1) / (4 * pi) * Legendre.basis(degree)(np.clip(u @ v.T, -1, 1))
        close(real_harmonics(degree, u) @ real_harmonics(degree, v).T, expected)

    @pytest.mark.parametrize("tilt", [1e-3, 1e-6, 1e-8, 1e-12])
    def test_next_to_the_poles(self, tilt):
        """A polar angle from its cosine alone would lose half the digits here."""
        near = np.array([[np.sin(tilt), 0, np.cos(tilt)], [0.6 * np.sin(tilt), -0.8 * np.sin(tilt), -np.cos(tilt)]])
        close(real_harmonics(1, near), np.sqrt(3 / (4 * pi)) * near[:, [1, 2, 0]])

    @pytest.mark.parametrize("degree", DEGREES)
    def test_order_of_the_orders(self, degree):
        """A turn by α about z changes the azimuth: Y_{±m} mix as cos mα and sin mα, m from −n to n."""
        u, angle = some_directions(20, 5), 0.7
        turned = u @ np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]]).T
        phase = np.arange(-degree, degree + 1) * angle
        values = real_harmonics(degree, u)
        close(real_harmonics(degree, turned), np.cos(phase) * values - np.sin(phase) * values[:, ::-1])


class TestQuadrature:
    @pytest.mark.parametrize("degree", [0, 1, 4, 7, 12])
    def test_integrates_all_monomials_of_its_degree(self, degree):
        """∫ x^a y^b z^c = 2 Γ((a+1)/2) Γ((b+1)/2) Γ((c+1)/2) / Γ((a+b+c+3)/2) for even powers, zero otherwise."""
        directions, weights = sphere_quadrature(degree)
        for a in range(degree + 1):
            for b in range(degree + 1 - a):
                c = degree - a - b
                even = all(power % 2 == 0 for power in (a, b, c))
                exact = 2 * gamma((a + 1) / 2) * gamma((b + 1) / 2) * gamma((c + 1) / 2) / gamma((degree + 3) / 2)
                ours = weights @ np.prod(directions ** np.array([a, b, c]), axis=1)
                assert ours == pytest.approx(exact if even else 0.0, abs=1e-13), (a, b, c)

    def test_points_are_on_the_sphere_and_weights_positive(self):
        directions, weights = sphere_quadrature(9)
        close(np.linalg.norm(directions, axis=1), 1.0)
        assert np.all(weights > 0)


@pytest.mark.parametrize("degree", DEGREES)
def test_raising_splits_the_product_with_the_unit_vector(degree):
    """u_k Y_n = T_k(n) Y_{n+1} + T_k(n−1)ᵀ Y_{n−1}, point by point, so that nothing is left over."""
    u = some_directions(20, 6)
    product = u[:, :, None] * real_harmonics(degree, u)[:, None]
    parts = np.einsum("pa,kab->pkb", real_harmonics(degree + 1, u), raising(degree))
    if degree:
        parts = parts + np.einsum("pa,kba->pkb", real_harmonics(degree - 1, u), raising(degree - 1))
    close(parts, product)


class TestRotations:
    """Degree one is the rotation R itself; every other degree must carry its functions by that same R."""

    TARGETS = some_directions(12, 7)

    @pytest.fixture
    def turns(self):
        """R (P, 3, 3) in x, y, z from D of degree one, whose order is y, z, x."""
        to_xyz = [2, 0, 1]
        return rotations(1, self.TARGETS)[:, to_xyz][:, :, to_xyz]

    def test_degree_one_is_a_proper_rotation_that_carries_z_to_the_direction(self, turns):
        close(turns @ turns.transpose(0, 2, 1), np.broadcast_to(np.eye(3), turns.shape))
        close(np.linalg.det(turns), 1.0)
        close(turns[:, :, 2], self.TARGETS)

    @pytest.mark.parametrize("degree", DEGREES[1:])
    def test_orthogonal(self, degree):
        matrices = rotations(degree, self.TARGETS)
        close(matrices @ matrices.transpose(0, 2, 1), np.broadcast_to(np.eye(2 * degree + 1), matrices.shape))

    @pytest.mark.parametrize("degree", DEGREES[1:])
    def test_carries_functions(self, degree, turns):
        """Y_m(Rᵀu) = Σ_m' Y_m'(u) D_m'm for all u."""
        u = some_directions(20, 8)[6:]
        for turn, matrix in zip(turns, rotations(degree, self.TARGETS), strict=True):
            close(real_harmonics(degree, u @ turn), real_harmonics(degree, u) @ matrix)

    def test_z_to_itself_is_no_rotation(self):
        for degree in DEGREES[1:]:
            close(rotations(degree, POLES[:1])[0], np.eye(2 * degree + 1))

    @pytest.mark.parametrize("offset", [1e-9, 1e-300, -1e-300])
    def test_next_to_the_poles(self, offset):
        """Directions that rounding has moved off a pole still give rotations that carry z there."""
        near = POLES + np.array([offset, -offset, 0])
        close(rotations(1, near)[:, [2, 0, 1], 1], near)
        matrices = rotations(HIGHEST, near)
        close(matrices @ matrices.transpose(0, 2, 1), np.broadcast_to(np.eye(2 * HIGHEST + 1), matrices.shape))
