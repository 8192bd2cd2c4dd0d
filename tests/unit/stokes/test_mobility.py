"""The mobility operator of many spheres: one matrix, its product, its lower orders, and what it is applied to."""

import numpy as np
import pytest
from scipy.integrate import lebedev_rule

from rheoclast.stokes import mobility as mobility_module
from rheoclast.stokes.basis import MultipoleBasis
from rheoclast.stokes.harmonics import real_harmonics
from rheoclast.stokes.mobility import Mobility
from rheoclast.vectors import elementary_velocities

from ...agreement.clusters import sticking_cluster

ORDER = 4
CLUSTERS = {
    "one sphere": sticking_cluster(1, 1, (0.7, 0.8)),
    "unequal doublet": sticking_cluster(2, 2, (0.2, 1.0)),
    "six polydisperse": sticking_cluster(6, 3, (0.4, 1.3)),
    "nine equal": sticking_cluster(9, 4),
}


@pytest.fixture(params=CLUSTERS)
def mobility(request):
    return Mobility(*CLUSTERS[request.param], MultipoleBasis(ORDER))


def flat(matrix):
    return matrix.reshape(matrix.shape[0] * matrix.shape[1], -1)


def test_matrix_is_symmetric(mobility):
    """To rounding: the two blocks of a pair are computed apart."""
    dense = flat(mobility.matrix())
    assert dense.shape == (dense.shape[0],) * 2
    np.testing.assert_allclose(dense, dense.T, rtol=0, atol=1e-14 * np.abs(dense).max())


def test_matrix_is_positive_definite(mobility):
    """No traction gives energy back. Rounding is 1e-15 of the largest eigenvalue, the least is far above it."""
    eigenvalues = np.linalg.eigvalsh(flat(mobility.matrix()))
    assert eigenvalues[0] > 1e-4 * eigenvalues[-1]


@pytest.mark.parametrize("chunk_bytes", [mobility_module.PAIR_CHUNK_BYTES, 1.0, 3 * 8 * 47**2])
def test_product_is_that_of_the_matrix(mobility, chunk_bytes, monkeypatch):
    """However many pairs are done at a time: all, one, or three."""
    dense = mobility.matrix()
    monkeypatch.setattr(mobility_module, "PAIR_CHUNK_BYTES", chunk_bytes)
    tractions = np.random.default_rng(5).normal(size=(len(mobility.radii), mobility.basis.size, 3))
    expected = np.einsum("aibj,jbk->iak", dense, tractions)
    np.testing.assert_allclose(mobility @ tractions, expected, rtol=0, atol=1e-13 * np.abs(expected).max())


@pytest.mark.parametrize("order", range(1, ORDER))
def test_lower_orders_are_leading_parts(mobility, order):
    """What the one factorization for all orders rests on."""
    lower = Mobility(mobility.centers, mobility.radii, MultipoleBasis(order))
    size = lower.basis.size
    np.testing.assert_allclose(lower.matrix(), mobility.matrix()[:size, :, :size], rtol=0, atol=1e-15)


def test_ambient_velocities_are_projections_over_each_surface(mobility):
    """∫ ψ(u) · flow(x + a u) dΩ by Lebedev's rule, exact for order 4 in a linear flow."""
    points, weights = lebedev_rule(9)
    u = points.T
    modes = np.concatenate(
        [np.einsum("pl,klm->pkm", real_harmonics(f.rank, u), f.components) for f in mobility.basis.families], axis=-1
    )
    for center, radius, ours in zip(mobility.centers, mobility.radii, mobility.ambient_velocities(), strict=True):
        flows = elementary_velocities(center + radius * u)
        expected = np.einsum("p,pci,pim->mc", weights, flows, modes)
        np.testing.assert_allclose(ours, expected, rtol=0, atol=1e-12 * np.abs(expected).max())


def test_moments_are_integrals_of_the_traction(mobility):
    """∫ f, ∫ a u × f and its strain components, with f dA = ψ dΩ; a lower order has fewer modes and the same rows."""
    tractions = np.random.default_rng(6).normal(size=(len(mobility.radii), mobility.basis.size, 2))
    points, weights = lebedev_rule(9)
    u = points.T
    modes = np.concatenate(
        [np.einsum("pl,klm->pkm", real_harmonics(f.rank, u), f.components) for f in mobility.basis.families], axis=-1
    )
    for order in (1, 2, ORDER):
        size = MultipoleBasis(order).size
        ours = mobility.moments(tractions[:, :size])
        for n, radius in enumerate(mobility.radii):
            lever = elementary_velocities(radius * u)
            force = modes[:, :, :size] @ tractions[n, :size]
            expected = np.einsum("p,pci,pik->ck", weights, lever, force)
            np.testing.assert_allclose(ours[n], expected, rtol=0, atol=1e-12 * np.abs(expected).max())


def test_progress_ends_at_one():
    steps = []
    Mobility(*CLUSTERS["nine equal"], MultipoleBasis(2)).matrix(lambda step, done: steps.append((step, done)))
    names, fractions = zip(*steps, strict=True)
    assert set(names) == {"pair mobilities"}
    assert list(fractions) == sorted(fractions)
    assert fractions[-1] == 1.0
