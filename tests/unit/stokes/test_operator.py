"""The operator: its product, its matrix in pieces, and the thread guard of the dense solver."""

import numpy as np
import pytest
from scipy.sparse.linalg import LinearOperator, cg
from threadpoolctl import threadpool_info

from rheoclast._threads import one_blas_thread
from rheoclast.stokes import dense as dense_module
from rheoclast.stokes.basis import MultipoleBasis
from rheoclast.stokes.mobility import Mobility

CENTERS = np.array([[0, 0, 0], [2.1, 0.3, -0.2], [-1.4, 2.2, 1.0], [0.5, -1.8, 2.6], [3.0, 3.0, 0.1]])
RADII = np.array([1.0, 0.7, 1.3, 0.9, 0.5])


def operator(order):
    return Mobility(CENTERS, RADII, MultipoleBasis(order))


@pytest.mark.parametrize("order", [1, 2, 3, 4])
def test_product_is_that_with_the_matrix(order):
    mobility = operator(order)
    tractions = np.random.default_rng(order).normal(size=(5, mobility.basis.size, 3))
    expected = np.einsum("aibj,jbk->iak", mobility.matrix(), tractions)
    np.testing.assert_allclose(mobility @ tractions, expected, rtol=0, atol=1e-13 * np.abs(expected).max())


def test_conjugate_gradients_can_replace_the_dense_solver():
    mobility = operator(3)
    velocities = mobility.ambient_velocities()
    shape = (5, mobility.basis.size, 1)
    product = LinearOperator(
        (np.prod(shape),) * 2, matvec=lambda x: (mobility @ np.reshape(x, shape)).ravel(), dtype=float
    )
    dense = dense_module.DenseCholesky().solve(mobility, velocities)[-1].tractions
    for k in range(11):
        iterated, failed = cg(product, velocities[:, :, k].ravel(), rtol=1e-12)
        assert not failed
        np.testing.assert_allclose(iterated.reshape(shape[:2]), dense[:, :, k], rtol=0, atol=1e-9 * np.abs(dense).max())


@pytest.mark.parametrize(("size", "served"), [(1_100, False), (3_300, True), (15_000, True), (16_000, False)])
def test_one_thread_where_threads_crash_or_do_not_pay(size, served):
    assert dense_module.threads_serve(size) == served


def test_one_blas_thread():
    def threads():
        return {pool["num_threads"] for pool in threadpool_info() if pool["user_api"] == "blas"}

    before = threads()
    with one_blas_thread():
        assert threads() == {1}
    with one_blas_thread(when=False):
        assert threads() == before
    assert threads() == before
