"""The compiled equation against matrix exponentials of SciPy and the same scheme in NumPy."""

import numpy as np
import pytest
from scipy.linalg import expm

from rheoclast.histories import traceless
from rheoclast.turbulence._deformation_kernel import drift, exponential, follow, increment


def gradient(size, seed=1):
    return size * traceless(np.random.default_rng(seed).normal(size=(3, 3)))


def drift_by_definition(a, memory):
    """−A² + tr(A²)/tr(C⁻¹) C⁻¹ − tr(C⁻¹)/3 A with C = exp(γA) exp(γAᵀ), inverted by NumPy."""
    inverse = np.linalg.inv(expm(memory * a) @ expm(memory * a.T))
    return -a @ a + np.trace(a @ a) / np.trace(inverse) * inverse - np.trace(inverse) / 3 * a


@pytest.mark.parametrize("size", [0.0, 1e-3, 1.0, 10.0])
@pytest.mark.parametrize("seed", range(3))
def test_exponential_of_a_traceless_matrix(size, seed):
    a = gradient(size, seed)
    expected = expm(-0.3 * a)
    np.testing.assert_allclose(exponential(a, a @ a, -0.3), expected, rtol=0, atol=1e-12 * np.abs(expected).max())


@pytest.mark.parametrize("a", [np.diag([1.0, 1.0, -2.0]), np.eye(3, k=1), np.diag([1.0, -1.0], k=1)[:3, :3]])
def test_exponential_of_degenerate_matrices(a):
    """A double eigenvalue, and shears, which have no three eigenvectors."""
    a = np.array(a)
    np.testing.assert_allclose(exponential(a, a @ a, 1.5), expm(1.5 * a), rtol=1e-13, atol=1e-13)


@pytest.mark.parametrize("size", [0.1, 1.0, 10.0])
@pytest.mark.parametrize("seed", range(3))
def test_drift_by_definition(size, seed):
    a = gradient(size, seed)
    expected = drift_by_definition(a, 0.1)
    np.testing.assert_allclose(drift(a, 0.1), expected, rtol=0, atol=1e-12 * np.abs(expected).max())
    assert abs(np.trace(drift(a, 0.1))) < 1e-12 * np.abs(expected).max()


def test_noise_has_the_covariance_of_the_model():
    """Every one of the 81 covariances, within five standard errors of its mean over the sample."""
    random = np.random.default_rng(7)
    noise = np.array([increment(0.25, random) for _ in range(100_000)]).reshape(-1, 9)
    delta = np.eye(3)
    expected = 0.25 * (
        2 * np.einsum("ik,jl->ijkl", delta, delta)
        - 0.5 * np.einsum("ij,kl->ijkl", delta, delta)
        - 0.5 * np.einsum("il,jk->ijkl", delta, delta)
    ).reshape(9, 9)
    products = noise[:, :, None] * noise[:, None, :]
    error = products.std(axis=0) / np.sqrt(len(noise))
    assert (np.abs(products.mean(axis=0) - expected) < 5 * error).all()
    assert error.max() < 0.01 * expected.max()


def test_path_is_that_of_the_scheme_of_heun():
    """Predictor and corrector written out in NumPy with the same random numbers, three steps per instant."""
    start, step, memory = gradient(2.0), 0.02, 0.1
    path = np.empty((5, 3, 3))
    follow(start, memory, step, 3, np.random.default_rng(5), path)
    random, a, expected = np.random.default_rng(5), start, [start]
    for _ in range(4):
        for _ in range(3):
            noise = increment(step, random)
            predicted = a + step * drift_by_definition(a, memory) + noise
            a = a + step / 2 * (drift_by_definition(a, memory) + drift_by_definition(predicted, memory)) + noise
        expected.append(a)
    np.testing.assert_allclose(path, expected, rtol=0, atol=1e-12)
