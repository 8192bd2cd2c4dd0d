"""Random orientations against the moments of the uniform distribution over rotations."""

import numpy as np
import pytest
from scipy import stats

import rheoclast as rc
from rheoclast.vectors import LEVI_CIVITA

COUNT = 20_000
DEVIATIONS = 5  # standard errors of a mean


@pytest.fixture(scope="module")
def rotations():
    return rc.random_orientations(COUNT, seed=11)


def assert_mean(samples, expected):
    """The mean over the first axis within some standard errors, component by component."""
    error = np.sqrt(np.var(samples, axis=0) / len(samples))
    assert (np.abs(samples.mean(axis=0) - expected) <= DEVIATIONS * error + 1e-12).all()


def test_proper_rotations(rotations):
    assert rotations.shape == (COUNT, 3, 3)
    np.testing.assert_allclose(
        rotations @ rotations.swapaxes(1, 2), np.broadcast_to(np.eye(3), (COUNT, 3, 3)), atol=1e-14
    )
    np.testing.assert_allclose(np.linalg.det(rotations), 1, rtol=1e-13)


def test_first_moment_vanishes(rotations):
    assert_mean(rotations, 0)


def test_second_moment_is_isotropic(rotations):
    """⟨R_ij R_kl⟩ = δ_ik δ_jl / 3."""
    samples = np.einsum("nij,nkl->nijkl", rotations, rotations)
    assert_mean(samples, np.einsum("ik,jl->ijkl", np.eye(3), np.eye(3)) / 3)


def test_third_moment_is_isotropic(rotations):
    """⟨R_ij R_kl R_mn⟩ = ε_ikm ε_jln / 6."""
    samples = np.einsum("nij,nkl,nmo->nijklmo", *[rotations[:4000]] * 3)
    assert_mean(samples, np.einsum("ikm,jlo->ijklmo", LEVI_CIVITA, LEVI_CIVITA) / 6)


def test_angle_of_rotation(rotations):
    """It has the density (1 − cos θ) / π, from 0 to π."""
    angle = np.arccos(np.clip((np.trace(rotations, axis1=1, axis2=2) - 1) / 2, -1, 1))
    assert stats.kstest(angle, lambda x: (x - np.sin(x)) / np.pi).pvalue > 1e-3


def test_no_direction_is_preferred(rotations):
    """Every axis of the aggregate points anywhere, its components uniform from −1 to 1; also before a further turn."""
    turn = rotations[7]
    for each in (rotations, turn @ rotations, rotations @ turn):
        for component in each.reshape(COUNT, 9).T:
            assert stats.kstest(component, stats.uniform(-1, 2).cdf).pvalue > 1e-4


def test_mean_square_load_over_orientations_is_that_of_the_closed_form():
    """⟨(A : R E Rᵀ)²⟩ = |A|² |E|² / 5 for any symmetric traceless A, with the flow turned by each rotation."""
    flow = rc.simple_shear(2.0)
    tensor = np.diag([1.0, 0.5, -1.5]) + 0.7 * np.array([[0, 1, 0], [1, 0, 0], [0, 0, 0]])
    samples = [np.sum(tensor * flow.rotated(each).strain_rate) ** 2 for each in rc.random_orientations(4000, seed=2)]
    assert_mean(np.array(samples), np.sum(tensor**2) * np.sum(flow.strain_rate**2) / 5)


def test_seed_decides():
    np.testing.assert_array_equal(rc.random_orientations(5, seed=3), rc.random_orientations(5, seed=3))
    np.testing.assert_array_equal(rc.random_orientations(9, seed=3)[:5], rc.random_orientations(5, seed=3))
    assert not np.allclose(rc.random_orientations(5, seed=3), rc.random_orientations(5, seed=4))
    with pytest.raises(ValueError, match="read-only"):
        rc.random_orientations(1, seed=3)[0] = 0


@pytest.mark.parametrize("count", [0, -2, 2.0, True, "3"])
def test_refused_counts(count):
    with pytest.raises(ValueError, match=rf"^count: expected an integer of at least 1, got {count!r}$"):
        rc.random_orientations(count, seed=1)


@pytest.mark.parametrize("seed", [-1, None, 1.0])
def test_refused_seeds(seed):
    with pytest.raises(ValueError, match=rf"^seed: expected an integer of at least 0, got {seed!r}$"):
        rc.random_orientations(2, seed)
