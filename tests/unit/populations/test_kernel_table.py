"""One row per entry, every column as described."""

import numpy as np
import pytest

from rheoclast.populations.breakage_rate import poisson_rate
from rheoclast.populations.fragment_distribution import fragment_distribution
from rheoclast.populations.kernel_table import KERNEL_COLUMNS, KernelEntry, kernel_table

FRAGMENTS = fragment_distribution([[1, 99], [50, 50], [20, 30, 50]])
FULL = KernelEntry(300, 1e-5, 0.1, poisson_rate(7, 20.0), 0.4, FRAGMENTS)
BARE = KernelEntry(120.5, 5e-6, 0.2, poisson_rate(0, 3.0))


def test_columns():
    table = kernel_table([FULL, BARE])
    assert list(table) == list(KERNEL_COLUMNS)
    assert all(values.shape == (2,) for values in table.values())
    for name, expected in {
        "spheres": [300, 120.5],
        "radius_of_gyration": [1e-5, 5e-6],
        "dissipation": [0.1, 0.2],
        "rate": [0.35, 0],
        "rate_low": [FULL.rate.interval[0], 0],
        "rate_high": [FULL.rate.interval[1], BARE.rate.interval[1]],
        "failures": [7, 0],
        "time": [20, 3],
        "critical_dissipation": [0.4, np.nan],
        "mean_fragments": [7 / 3, np.nan],
        "second_moment": [(0.01**2 + 0.99**2 + 0.5 + 0.04 + 0.09 + 0.25) / 3, np.nan],
        "erosive_share": [1 / 7, np.nan],
    }.items():
        np.testing.assert_allclose(table[name], expected, err_msg=name)


def test_refused():
    with pytest.raises(ValueError, match="entries: expected at least one, got none"):
        kernel_table([])
    with pytest.raises(TypeError, match=r"entries\[1\]: expected KernelEntry, got dict"):
        kernel_table([BARE, {}])
    with pytest.raises(ValueError, match="dissipation: expected a positive number, got 0"):
        KernelEntry(1, 1, 0, poisson_rate(1, 1.0))
    with pytest.raises(ValueError, match="critical_dissipation: expected a positive number, got -1"):
        KernelEntry(1, 1, 1, poisson_rate(1, 1.0), -1)
    with pytest.raises(TypeError, match="rate: expected EventRate, got float; make one with breakage_rate"):
        KernelEntry(1, 1, 1, 0.3)
    with pytest.raises(TypeError, match="fragments: expected FragmentDistribution, got list; make one with"):
        KernelEntry(1, 1, 1, poisson_rate(1, 1.0), 1, [1, 2])
