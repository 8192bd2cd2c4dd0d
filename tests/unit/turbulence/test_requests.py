"""What is asked of a model: instants, units, independent random numbers, refusals."""

import numpy as np
import pytest

from rheoclast.turbulence._requests import Request, kolmogorov_time


def request(**changed):
    given = {"count": 2, "duration": 3.0, "dissipation": 0.25, "kinematic_viscosity": 1.0, "seed": 1, "step": 0.5}
    return Request.checked(**(given | changed))


def test_kolmogorov_time_is_the_root_of_viscosity_over_dissipation():
    assert kolmogorov_time(dissipation=1e-2, kinematic_viscosity=1e-6) == pytest.approx(0.01, rel=1e-15)


def test_instants_are_in_kolmogorov_times():
    """One Kolmogorov time is 2 s here."""
    assert request().unit == 2.0
    np.testing.assert_allclose(request().instants, [0, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5])
    assert request().step == 0.25


@pytest.mark.parametrize(("step", "steps"), [(0.7, 5), (3.0, 1), (4.0, 1), (0.3, 10), (0.1, 30), (None, 15)])
def test_a_step_is_shortened_to_fit(step, steps):
    """Three times 0.1 is more than 0.3 by rounding, which must not cost a step; the default is a tenth of 2 s."""
    assert len(request(step=step).instants) == steps + 1
    assert request(step=step).instants[-1] == 1.5


def test_a_history_is_in_si_units():
    history = request().history(np.tile(np.diag([1.0, 1.0, -2.0]), (7, 1, 1)))
    np.testing.assert_allclose(history.times, [0, 0.5, 1, 1.5, 2, 2.5, 3])
    np.testing.assert_allclose(history.gradients[3], np.diag([0.5, 0.5, -1.0]))


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"count": 0}, "count: expected an integer of at least 1, got 0"),
        ({"duration": 0.0}, "duration: expected a positive number, got 0"),
        ({"dissipation": -1.0}, "dissipation: expected a positive number, got -1"),
        ({"kinematic_viscosity": np.nan}, "kinematic_viscosity: expected a finite number, got nan"),
        ({"seed": -1}, "seed: expected an integer of at least 0, got -1"),
        ({"duration": 1e9, "step": 1.0}, r"step, duration, count: expected at most 1e\+08 instants in all, got 2e\+09"),
        ({"step": 1e-320}, r"step, duration, count: expected at most 1e\+08 instants in all, got inf; make the histor"),
        ({"step": 0.0}, "step: expected a positive number, got 0"),
    ],
)
def test_bad_requests(changed, message):
    with pytest.raises(ValueError, match=message):
        request(**changed)
