"""Numbers and flows in words."""

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.report.wording import flow_name, percent, written


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (131628.15, "1/s", "1.316 × 10⁵ 1/s"),
        (1715.2, "1/s", "1715 1/s"),
        (-2.5e-12, "", "−2.5 × 10⁻¹²"),
        (1.79e-8, "N", "17.9 nN"),
        (-4.5, "μGa²", "−4.5 μGa²"),
        (0.0, "1/s", "0 1/s"),
    ],
)
def test_written(value, unit, text):
    assert written(value, unit) == text


def test_percent():
    assert percent(0.02997) == "3 %"
    assert percent(0.0118) == "1.2 %"


@pytest.mark.parametrize(
    ("flow", "name"),
    [
        (rc.simple_shear(3.0), "simple shear"),
        (rc.uniaxial_extension(2.0), "uniaxial extension"),
        (rc.biaxial_extension(2.0), "biaxial extension"),
        (rc.planar_extension(2.0), "planar extension"),
        (rc.LinearFlow(np.diag([3.0, -1.0, -2.0])), "pure strain"),
        (rc.LinearFlow([[0.0, 2.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]]), "linear flow"),
    ],
)
def test_flows_are_known_in_any_orientation(flow, name):
    for rotation in rc.random_orientations(5, seed=1):
        assert flow_name(flow.rotated(rotation)) == name


def test_without_strain():
    assert flow_name(rc.LinearFlow(np.zeros((3, 3)))) == "liquid at rest"
    assert flow_name(rc.LinearFlow([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]])) == "rotation"
