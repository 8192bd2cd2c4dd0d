"""Laws of isotropic turbulence that the modelled velocity gradients obey, and those that they must break.

Expected values are means over independent histories. The tolerance is five standard errors, found from the scatter
between histories (by the jackknife where the quantity is not a mean itself), and the standard error must be small
enough for the assertion to mean something. Gaussian gradients serve as control: what tells turbulence from noise must
vanish for them.
"""

import numpy as np
import pytest

from rheoclast.turbulence import gaussian_histories, kolmogorov_time, recent_deformation_histories
from rheoclast.turbulence._deformation_kernel import drift
from rheoclast.turbulence.gaussian import ROTATION_TIME, STRAIN_TIME
from rheoclast.turbulence.recent_deformation import MEAN_SQUARE_MAGNITUDE, MEMORY

DISSIPATION, VISCOSITY = 0.3, 2e-6
TAU = kolmogorov_time(DISSIPATION, VISCOSITY)


def sample(model, count, duration, step, seed=11):
    """Gradients (K, T, 3, 3) of independent histories in inverse Kolmogorov times; arguments in Kolmogorov times."""
    histories = model(count, duration * TAU, DISSIPATION, VISCOSITY, seed, step=step * TAU)
    return TAU * np.array([history.gradients for history in histories])


@pytest.fixture(scope="module")
def gaussian():
    return sample(gaussian_histories, 3000, 40.0, 1.0)


@pytest.fixture(scope="module")
def deformed():
    return sample(recent_deformation_histories, 2500, 40.0, 1.0)


def assert_mean(values, expected, resolution):
    """The mean over histories (K, T, ...) is what is expected, and known to better than `resolution`."""
    per_history = values.mean(axis=tuple(range(1, values.ndim - np.ndim(expected))))
    error = per_history.std(axis=0, ddof=1) / np.sqrt(len(per_history))
    assert (5 * error < resolution).all()
    assert (np.abs(per_history.mean(axis=0) - expected) <= 5 * error).all()


def jackknife(samples, statistic):
    """A statistic of the means over histories (K, m), and its standard error."""
    count = len(samples)
    without = statistic(((samples.sum(axis=0) - samples) / (count - 1)).T)
    return statistic(samples.mean(axis=0)), np.sqrt((count - 1) * without.var())


def parts(gradients):
    transposed = np.swapaxes(gradients, -1, -2)
    return (gradients + transposed) / 2, (gradients - transposed) / 2


def square(tensors):
    return np.sum(tensors**2, axis=(-1, -2))


def longitudinal(gradients):
    return np.diagonal(gradients, axis1=-2, axis2=-1)


def skewness(gradients):
    along = longitudinal(gradients)
    moments = np.stack([(along**n).mean(axis=(1, 2)) for n in (2, 3)], axis=1)
    return jackknife(moments, lambda m: m[1] / m[0] ** 1.5)


def alignments(gradients):
    """cos² (K, T, 3) between vorticity and the axes of strain, from compression to extension."""
    strain_rate, _ = parts(gradients)
    vorticity = np.stack(
        [gradients[..., k - 1, k - 2] - gradients[..., k - 2, k - 1] for k in range(3)], axis=-1
    )  # (∂u_z/∂y − ∂u_y/∂z, ...)
    axes = np.linalg.eigh(strain_rate)[1]
    return np.einsum("...i,...ij->...j", vorticity, axes) ** 2 / np.sum(vorticity**2, axis=-1)[..., None]


def strain_state(gradients):
    """s* = −3 √6 e1 e2 e3 / (E:E)^(3/2) of Lund and Rogers, from −1 in uniaxial to 1 in biaxial extension."""
    strain_rate, _ = parts(gradients)
    return -3 * np.sqrt(6) * np.linalg.det(strain_rate) / square(strain_rate) ** 1.5


def test_covariance_of_gaussian_gradients(gaussian):
    """⟨Γ_ij Γ_kl⟩ = ε/(30 ν) (4 δ_ik δ_jl − δ_ij δ_kl − δ_il δ_jk), all 81 of them."""
    delta = np.eye(3)
    expected = (
        4 * np.einsum("ik,jl->ijkl", delta, delta)
        - np.einsum("ij,kl->ijkl", delta, delta)
        - np.einsum("il,jk->ijkl", delta, delta)
    ) / 30
    flat = gaussian.reshape(*gaussian.shape[:2], 9)
    assert_mean(flat[..., :, None] * flat[..., None, :], expected.reshape(9, 9), resolution=0.01)


@pytest.mark.parametrize("instant", [0, 20, -1])
def test_dissipation_and_enstrophy_from_the_first_instant_on(gaussian, instant):
    """2 ν ⟨E:E⟩ = ε = 2 ν ⟨W:W⟩ in units of Kolmogorov: one half each, at any instant."""
    strain_rate, rotation_rate = parts(gaussian[:, instant : instant + 1 or None])
    assert_mean(square(strain_rate), 0.5, resolution=0.05)
    assert_mean(square(rotation_rate), 0.5, resolution=0.05)


@pytest.mark.parametrize("step", [0.5, 3.0])
def test_correlation_of_gaussian_gradients_decays_exponentially(step):
    """exp(−t/2.3) for the strain rate and exp(−t/7.2) for the rotation rate, whatever the step."""
    gradients = sample(gaussian_histories, 3000, 12.0, step)
    for part, time in zip(parts(gradients), (STRAIN_TIME, ROTATION_TIME), strict=True):
        for lag in (3.0, 6.0):
            shift = round(lag / step)
            products = np.sum(part[:, shift:] * part[:, :-shift], axis=(-1, -2))
            assert_mean(products, 0.5 * np.exp(-lag / time), resolution=0.05)


def test_gaussian_strain_and_rotation_are_independent(gaussian):
    strain_rate, rotation_rate = parts(gaussian)
    assert_mean((square(strain_rate) - 0.5) * (square(rotation_rate) - 0.5), 0.0, resolution=0.02)


def test_gaussian_gradients_do_not_tell_turbulence_from_its_mirror_image(gaussian):
    """No skewness, no preferred axis of vorticity, no preferred shape of strain, as many with R > 0 as with R < 0."""
    value, error = skewness(gaussian)
    assert abs(value) < 5 * error < 0.03
    assert_mean(alignments(gaussian), np.full(3, 1 / 3), resolution=0.01)
    assert_mean(strain_state(gaussian), 0.0, resolution=0.02)
    assert_mean(np.linalg.eigvalsh(parts(gaussian)[0])[..., 1], 0.0, resolution=0.01)
    assert_mean(np.sign(np.linalg.det(gaussian)), 0.0, resolution=0.04)


@pytest.mark.parametrize("instant", [0, 20, -1])
def test_dissipation_of_deformed_gradients_from_the_first_instant_on(deformed, instant):
    strain_rate, _ = parts(deformed[:, instant : instant + 1 or None])
    assert_mean(square(strain_rate), 0.5, resolution=0.06)


def test_mean_dissipation_of_deformed_gradients(deformed):
    """2 ν ⟨E:E⟩ = ε, which is what makes the model's unit of time seconds."""
    assert_mean(square(parts(deformed)[0]), 0.5, resolution=0.02)


def test_deformed_gradients_are_isotropic(deformed):
    """⟨Γ_ij Γ_kl⟩ = a δ_ik δ_jl + b δ_ij δ_kl + c δ_il δ_jk, a and c from strain and rotation, b from zero trace."""
    strain, rotation = (square(part).mean() for part in parts(deformed))
    a, c = strain / 10 + rotation / 6, strain / 10 - rotation / 6
    delta = np.eye(3)
    expected = (
        a * np.einsum("ik,jl->ijkl", delta, delta)
        - (a + c) / 3 * np.einsum("ij,kl->ijkl", delta, delta)
        + c * np.einsum("il,jk->ijkl", delta, delta)
    )
    flat = deformed.reshape(*deformed.shape[:2], 9)
    assert_mean(flat[..., :, None] * flat[..., None, :], expected.reshape(9, 9), resolution=0.02)


def test_random_force_feeds_what_the_drift_takes(deformed):
    """⟨2 A : drift⟩ = −15 in integral times: Itô's formula for ⟨A:A⟩ at rest, the noise having trace 18 − 3/2 − 3/2."""
    scale = np.sqrt(MEAN_SQUARE_MAGNITUDE)
    gradients = scale * deformed[:, ::5]
    power = [2 * np.sum(a * drift(a, MEMORY)) for a in gradients.reshape(-1, 3, 3)]
    assert_mean(np.reshape(power, gradients.shape[:2]), -15.0, resolution=1.0)


def test_longitudinal_gradients_are_skewed(deformed):
    """Between −0.5 and −0.3, as in experiments: stretching of vortices needs strong compressions."""
    value, error = skewness(deformed)
    assert -0.5 + 5 * error < value < -0.3 - 5 * error


def test_transverse_gradients_have_wider_tails_than_longitudinal_ones(deformed):
    """Flatness above the Gaussian three for both, and larger across than along."""
    across = deformed[..., ~np.eye(3, dtype=bool)]
    flatness = {}
    for name, values in {"along": longitudinal(deformed), "across": across}.items():
        moments = np.stack([(values**n).mean(axis=(1, 2)) for n in (2, 4)], axis=1)
        flatness[name] = jackknife(moments, lambda m: m[1] / m[0] ** 2)
    (along, along_error), (wide, wide_error) = flatness["along"], flatness["across"]
    assert along - 5 * along_error > 3
    assert wide - 5 * wide_error > along + 5 * along_error


def test_vorticity_prefers_the_intermediate_axis_of_strain(deformed):
    per_history = alignments(deformed).mean(axis=1)
    mean, error = per_history.mean(axis=0), per_history.std(axis=0) / np.sqrt(len(per_history))
    assert mean[1] - 5 * error[1] > max(1 / 3, mean[0] + 5 * error[0], mean[2] + 5 * error[2])
    assert mean[0] + 5 * error[0] < 1 / 3


def test_strain_prefers_two_stretching_axes(deformed):
    """The intermediate principal rate is positive on average, and so is s*."""
    for values in (np.linalg.eigvalsh(parts(deformed)[0])[..., 1], strain_state(deformed)):
        per_history = values.mean(axis=1)
        assert per_history.mean() > 5 * per_history.std() / np.sqrt(len(per_history))


def test_invariants_fill_a_teardrop(deformed):
    """Q = −½ tr Γ², R = −det Γ: most where vortices stretch (Q > 0 > R) or strain grows (R > 0 > Q).

    Below Vieillefosse's line 27/4 R² + Q³ = 0 the tail lies at R > 0.
    """
    q = -0.5 * np.einsum("...ij,...ji->...", deformed, deformed)
    r = -np.linalg.det(deformed)
    below = 27 / 4 * r**2 + q**3 < 0
    for excess in ((q * r < 0) - 0.5, (below & (r > 0)) * 1.0 - (below & (r < 0))):
        per_history = excess.mean(axis=1)
        assert per_history.mean() > 5 * per_history.std() / np.sqrt(len(per_history))


def integral_time(gradients):
    """∫ ⟨x(0)·x(t)⟩ dt / ⟨x·x⟩ over twelve Kolmogorov times, of gradients (K, T, 3, 3) at every half of one."""
    lags = 24
    start = gradients[:, : gradients.shape[1] - lags]
    shifted = [gradients[:, lag : lag + start.shape[1]] for lag in range(lags)]
    covariance = np.stack([np.sum(start * each, axis=(-1, -2)).mean(axis=1) for each in shifted], axis=1)
    return jackknife(covariance, lambda c: 0.5 * (c.sum(axis=0) - c[0] / 2) / c[0])


def test_deformed_strain_lasts_longer_and_rotation_shorter_than_in_turbulence():
    """Against 2.3 and 7.2 Kolmogorov times, which the Gaussian model takes from direct simulations."""
    strain, rotation = map(integral_time, parts(sample(recent_deformation_histories, 500, 60.0, 0.5)))
    for (time, error), expected in ((strain, 4.0), (rotation, 3.0)):
        assert 5 * error < 0.5
        assert abs(time - expected) < 0.3
    assert strain[0] > 1.5 * STRAIN_TIME
    assert rotation[0] < 0.5 * ROTATION_TIME
    control = integral_time(parts(sample(gaussian_histories, 500, 60.0, 0.5))[0])
    assert abs(control[0] - STRAIN_TIME) < 5 * control[1] + 0.02
