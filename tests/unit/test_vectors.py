"""Vector and tensor algebra against its definitions."""

from itertools import permutations

import numpy as np
import pytest

from rheoclast.vectors import LEVI_CIVITA, STRAIN_BASIS, cross_matrix, strain_components, strain_tensor


def test_levi_civita_is_the_sign_of_the_permutation():
    """Six entries, each the determinant of its permutation matrix; all others zero."""
    expected = np.zeros((3, 3, 3))
    for order in permutations(range(3)):
        expected[order] = round(np.linalg.det(np.eye(3)[list(order)]))
    np.testing.assert_array_equal(LEVI_CIVITA, expected)


def test_strain_basis_is_orthonormal_symmetric_and_traceless():
    """B_k : B_l is the identity, so components and tensors have the same norm."""
    gram = np.array([[np.sum(first * second) for second in STRAIN_BASIS] for first in STRAIN_BASIS])
    np.testing.assert_allclose(gram, np.eye(5), atol=1e-15)
    for tensor in STRAIN_BASIS:
        np.testing.assert_array_equal(tensor, tensor.T)
        assert abs(np.trace(tensor)) < 1e-15


def test_strain_basis_is_ordered_like_harmonics_of_degree_two():
    """r̂·B_k·r̂ is proportional, with a positive factor, to xy, yz, 2zz − xx − yy, zx, xx − yy."""
    x, y, z = np.random.default_rng(1).normal(size=(3, 50))
    harmonics = np.array([x * y, y * z, 2 * z * z - x * x - y * y, z * x, x * x - y * y])
    points = np.stack([x, y, z], axis=1)
    forms = np.einsum("pi,kij,pj->kp", points, STRAIN_BASIS, points)
    ratio = forms / harmonics
    assert (ratio > 0).all()
    np.testing.assert_allclose(ratio, np.broadcast_to(ratio[:, :1], ratio.shape), rtol=1e-10)


def test_components_and_tensors_are_inverse():
    """E = Σ e_k B_k and e_k = B_k : E, for batches of any shape."""
    components = np.random.default_rng(2).normal(size=(4, 3, 5))
    tensors = strain_tensor(components)
    assert tensors.shape == (4, 3, 3, 3)
    by_sum = sum(components[..., k, None, None] * STRAIN_BASIS[k] for k in range(5))
    np.testing.assert_allclose(tensors, by_sum, atol=1e-15)
    np.testing.assert_allclose(strain_components(tensors), components, atol=1e-14)


def test_components_ignore_trace_and_rotation():
    """Of any (3, 3) tensor only the symmetric traceless part is seen."""
    gradient = np.random.default_rng(3).normal(size=(3, 3))
    symmetric = (gradient + gradient.T) / 2
    deviator = symmetric - np.trace(symmetric) / 3 * np.eye(3)
    np.testing.assert_allclose(strain_tensor(strain_components(gradient)), deviator, atol=1e-14)


def test_cross_matrix_by_definition():
    """cross_matrix(v) @ w = v × w for every pair of a batch."""
    v, w = np.random.default_rng(4).normal(size=(2, 6, 2, 3))
    np.testing.assert_allclose(np.einsum("...ij,...j->...i", cross_matrix(v), w), np.cross(v, w), atol=1e-15)
    np.testing.assert_array_equal(cross_matrix(np.array([0.0, 0.0, 1.0])) @ [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])


@pytest.mark.parametrize("constant", [LEVI_CIVITA, STRAIN_BASIS])
def test_constants_cannot_be_changed(constant):
    """A caller cannot change a module-wide constant by accident."""
    with pytest.raises(ValueError, match="read-only"):
        constant[0] = 0.0
