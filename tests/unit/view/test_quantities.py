"""Numbers as an engineer writes them."""

import numpy as np
import pytest

from rheoclast.view.quantities import prefixed, quoted, round_down, round_up, symmetric_limit


@pytest.mark.parametrize(
    ("size", "shown"),
    [
        (2e-15, "fN"),
        (3.2e-12, "pN"),
        (9.99e-10, "pN"),
        (1e-9, "nN"),
        (5e-7, "nN"),
        (4e-6, "µN"),
        (0.02, "mN"),
        (7, "N"),
    ],
)
def test_prefix_leaves_between_one_and_a_thousand(size, shown):
    divisor, unit = prefixed(size, "N")
    assert unit == shown
    assert 1 <= size / divisor * (1 + 1e-9) < 1000


@pytest.mark.parametrize("unit", [None, "", "1/s"])
def test_units_without_a_letter_take_no_prefix(unit):
    assert prefixed(3e-9, unit) == (1.0, unit or "")


def test_sizes_beyond_the_prefixes_keep_the_last_one():
    assert prefixed(1e-30, "N") == (1e-18, "aN")
    assert prefixed(0.0, "N") == (1.0, "N")


@pytest.mark.parametrize(
    ("value", "unit", "shown"),
    [
        (1.234e-9, "N", "1.23 nN"),
        (-4e-12, "N", "−4 pN"),
        (0.0, "N", "0 N"),
        (999.96e-9, "m", "1 µm"),
        (2e-17, "N m", "20 aN m"),
        (2000.0, None, "2000"),
        (0.5, None, "0.5"),
    ],
)
def test_quoted_values(value, unit, shown):
    assert quoted(value, unit) == shown


@pytest.mark.parametrize(("value", "up", "down"), [(1.0, 1, 1), (1.1, 1.2, 1), (3.3e-9, 4e-9, 2e-9), (8.1, 10, 5)])
def test_round_numbers_enclose_the_value(value, up, down):
    assert round_up(value) == pytest.approx(up)
    assert round_down(value) == pytest.approx(down)


def test_limit_is_the_largest_magnitude_made_round():
    assert symmetric_limit(np.array([-2.9, 1.0, 0.3])) == pytest.approx(3)


def test_limit_ignores_a_few_outliers():
    values = np.append(np.linspace(-1, 1, 200), 50.0)
    assert symmetric_limit(values) == pytest.approx(1)


@pytest.mark.parametrize("values", [[], [0.0, 0.0]])
def test_limit_of_nothing_is_one(values):
    assert symmetric_limit(np.array(values)) == 1
