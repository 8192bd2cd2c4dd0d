"""The modes of traction on a sphere: which there are, what they look like, and what flow each makes by itself."""

from math import pi

import numpy as np
import pytest
from scipy.integrate import lebedev_rule

from rheoclast.stokes.basis import Family, MultipoleBasis
from rheoclast.stokes.harmonics import real_harmonics
from rheoclast.vectors import STRAIN_BASIS

DIRECTIONS = np.random.default_rng(1).normal(size=(6, 3))
DIRECTIONS /= np.linalg.norm(DIRECTIONS, axis=1, keepdims=True)
FAMILIES = [Family(kind, degree) for kind in ("V", "X", "W") for degree in (1, 2, 3, 6)]


def modes(basis, directions):
    """All modes at unit vectors, (P, 3, M)."""
    return np.concatenate([values(family, directions) for family in basis.families], axis=-1)


def values(family, directions):
    """The modes of one family at unit vectors, (P, 3, 2n + 1)."""
    return np.einsum("pl,klm->pkm", real_harmonics(family.rank, directions), family.components)


class TestModes:
    @pytest.mark.parametrize("order", range(1, 13))
    def test_count(self, order):
        """3 for order 1, 3p² − 1 above: 11, 26, 47, 74, 107."""
        assert MultipoleBasis(order).size == (3 if order == 1 else 3 * order**2 - 1)

    @pytest.mark.parametrize("order", range(1, 7))
    def test_degrees(self, order):
        """W up to p, X up to p − 1, V up to p − 2, each once."""
        found = sorted(MultipoleBasis(order).families)
        highest = {"W": order, "X": order - 1, "V": order - 2}
        assert found == sorted((kind, n) for kind, last in highest.items() for n in range(1, last + 1))

    @pytest.mark.parametrize("order", range(1, 7))
    def test_lower_orders_come_first(self, order):
        """Whatever belongs to a mode stands at the same place in every higher order: lower orders are leading parts."""
        basis, higher = MultipoleBasis(order), MultipoleBasis(order + 1)
        assert higher.families[: len(basis.families)] == basis.families
        assert higher.slices[: len(basis.slices)] == basis.slices
        np.testing.assert_array_equal(higher.rank[: basis.size], basis.rank)
        np.testing.assert_array_equal(higher.self_mobility[: basis.size], basis.self_mobility)
        np.testing.assert_array_equal(higher.elementary_projections[:, : basis.size], basis.elementary_projections)
        assert np.all(higher.rank[basis.size :] == order)
        assert np.all(basis.rank < order)

    def test_slices_cover_all_modes_once(self):
        basis = MultipoleBasis(5)
        covered = np.concatenate([np.arange(basis.size)[where] for where in basis.slices])
        np.testing.assert_array_equal(covered, np.arange(basis.size))

    def test_orthonormal(self):
        """Order 6: components of degree 5 at most, products of degree 10; Lebedev's rule of degree 13."""
        points, weights = lebedev_rule(13)
        shapes = modes(MultipoleBasis(6), points.T)
        products = np.einsum("q,qka,qkb->ab", weights, shapes, shapes)
        np.testing.assert_allclose(products, np.eye(107), rtol=0, atol=1e-12)

    @pytest.mark.parametrize("family", FAMILIES, ids=str)
    def test_definition(self, family):
        """W = ∇s Y + n Y u, X = u × ∇s Y, V = ∇s Y − (n + 1) Y u, over their norms, by differences of Y(x/|x|).

        Fourth order with step 1e-3: truncation below n⁵ 1e-12, rounding 1e-13 / 1e-3.
        """

        def harmonic(x):
            return real_harmonics(family.degree, x / np.linalg.norm(x, axis=1, keepdims=True))

        step = 1e-3
        ahead, behind, far_ahead, far_behind = (
            np.stack([harmonic(DIRECTIONS + size * step * e) for e in np.eye(3)], axis=1) for size in (1, -1, 2, -2)
        )
        gradient = (8 * (ahead - behind) - far_ahead + far_behind) / (12 * step)
        radial = DIRECTIONS[:, :, None] * harmonic(DIRECTIONS)[:, None]
        n = family.degree
        defined, square = {
            "W": (gradient + n * radial, n * (2 * n + 1)),
            "X": (np.cross(DIRECTIONS[:, :, None], gradient, axis=1), n * (n + 1)),
            "V": (gradient - (n + 1) * radial, (n + 1) * (2 * n + 1)),
        }[family.kind]
        np.testing.assert_allclose(values(family, DIRECTIONS), defined / np.sqrt(square), rtol=0, atol=2e-8)


class TestOneSphere:
    @pytest.mark.parametrize("family", FAMILIES, ids=str)
    def test_self_mobility_is_the_single_layer_on_the_sphere_itself(self, family):
        """(1/8π) ∫ (1 + r̂r̂)/r ψ(u') dΩ' = self_mobility ψ(u), for u on the surface.

        With u as pole of the integration r = 2 sin(θ/2) and sin θ dθ / r = cos(θ/2) dθ: the singularity is gone and
        what is left is smooth in θ, so that 40 Gauss points are exact to rounding.
        """
        nodes, gauss = np.polynomial.legendre.leggauss(40)
        polar = pi / 2 * (nodes + 1)
        azimuth = 2 * pi * np.arange(24) / 24
        weight = np.outer(pi / 2 * gauss * np.cos(polar / 2), np.full(24, 2 * pi / 24)).ravel()
        local = np.stack(
            [
                np.outer(np.sin(polar), np.cos(azimuth)).ravel(),
                np.outer(np.sin(polar), np.sin(azimuth)).ravel(),
                np.repeat(np.cos(polar), 24),
            ],
            axis=1,
        )
        for u in DIRECTIONS:
            frame = np.linalg.svd(u[None])[2]
            others = local[:, 0:1] * frame[1] + local[:, 1:2] * frame[2] + local[:, 2:] * u
            density = values(family, others)
            between = u - others
            along = between / np.linalg.norm(between, axis=1, keepdims=True)
            velocity = np.einsum("q,qkm->km", weight, density)
            velocity += np.einsum("q,qk,qj,qjm->km", weight, along, along, density)
            expected = family.self_mobility * values(family, u[None])[0]
            np.testing.assert_allclose(velocity / (8 * pi), expected, rtol=0, atol=1e-12)

    def test_laws_of_stokes_and_einstein(self):
        """Forces, torques and stresslets of a held sphere in the elementary flows: 6π, 8π, 20π/3, and no other."""
        basis = MultipoleBasis(3)
        unit = basis.elementary_projections
        held = unit / basis.self_mobility @ unit.T
        exact = pi * np.diag(np.repeat([6, 8, 20 / 3], [3, 3, 5]))
        np.testing.assert_allclose(held, exact, rtol=0, atol=1e-12)

    @pytest.mark.parametrize("order", [1, 2, 4])
    def test_elementary_projections(self, order):
        """∫ ψ · (e_k, e_k × u, B_k·u) by Lebedev's rule; above order 2 they have no further parts."""
        points, weights = lebedev_rule(9)
        u = points.T
        streams = np.broadcast_to(np.eye(3), (len(u), 3, 3))
        turning = np.cross(np.eye(3), u[:, None])
        straining = np.einsum("kij,pj->pki", STRAIN_BASIS, u)
        flows = np.concatenate([streams, turning, straining], axis=1)
        basis = MultipoleBasis(order)
        expected = np.einsum("p,pki,pim->km", weights, flows, modes(basis, u))
        np.testing.assert_allclose(basis.elementary_projections, expected, rtol=0, atol=1e-12)
        assert not basis.elementary_projections[:, 11:].any()


@pytest.mark.parametrize("order", [0, -1, 2.5, 2.0, float("nan"), "high", "2", None, True])
def test_order_must_be_a_whole_number_of_at_least_one(order):
    """The message shows what came."""
    with pytest.raises(ValueError, match=rf"order: expected an integer of at least 1, got {order!r}"):
        MultipoleBasis(order)


def test_order_may_be_an_integer_of_numpy():
    assert MultipoleBasis(np.int64(3)).size == 26
