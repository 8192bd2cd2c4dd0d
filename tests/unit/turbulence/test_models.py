"""The registry: no model is missing from it, and all keep the common promises."""

import inspect

import numpy as np
import pytest

from rheoclast import turbulence
from rheoclast.histories import GradientHistory

DISSIPATION, VISCOSITY = 1e-2, 1e-6
KOLMOGOROV_TIME = 1e-2


def made(name, count=2, duration=0.1, seed=3, **more):
    request = {"dissipation": DISSIPATION, "kinematic_viscosity": VISCOSITY} | more
    return turbulence.TURBULENCE_MODELS[name](count, duration, seed=seed, **request)


def test_all_models_are_registered():
    models = {
        getattr(turbulence, name)
        for name in turbulence.__all__
        if inspect.isfunction(getattr(turbulence, name)) and name.endswith("_histories")
    }
    assert set(turbulence.TURBULENCE_MODELS.values()) == models
    for name, model in turbulence.TURBULENCE_MODELS.items():
        assert f"{name.replace('-', '_')}_histories" == model.__name__


@pytest.mark.parametrize("name", turbulence.TURBULENCE_MODELS)
class TestEveryModel:
    def test_histories_span_the_duration(self, name):
        histories = made(name, count=3, duration=0.1)
        assert len(histories) == 3
        for history in histories:
            assert isinstance(history, GradientHistory)
            np.testing.assert_allclose(history.times, np.linspace(0, 0.1, 101), rtol=1e-12)
            assert np.abs(np.trace(history.gradients, axis1=1, axis2=2)).max() < 1e-12 / KOLMOGOROV_TIME

    def test_seed_decides_and_count_adds(self, name):
        once, more, other = made(name), made(name, count=3), made(name, seed=4)
        for k in range(2):
            np.testing.assert_array_equal(once[k].gradients, more[k].gradients)
        everyone = [history.gradients[0, 0, 1] for history in (*more, *other)]
        assert len(set(everyone)) == 5

    def test_kolmogorov_units_are_the_only_ones(self, name):
        """The same seed in a liquid three times as viscous, dissipating twelve times as much: twice as fast."""
        slow = made(name, duration=0.1)
        fast = made(name, duration=0.05, dissipation=12 * DISSIPATION, kinematic_viscosity=3 * VISCOSITY)
        for one, other in zip(slow, fast, strict=True):
            np.testing.assert_allclose(other.times, one.times / 2, rtol=1e-12)
            np.testing.assert_allclose(other.gradients, 2 * one.gradients, rtol=1e-7, atol=1e-7 / KOLMOGOROV_TIME)

    def test_bad_requests_are_refused(self, name):
        with pytest.raises(ValueError, match="dissipation: expected a positive number, got 0"):
            made(name, dissipation=0.0)
