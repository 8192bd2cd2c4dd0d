"""Failure by rolling."""

import numpy as np

import rheoclast as rc

from .cases import loads


def test_bending_moment_over_bending_strength():
    """Whatever its direction across the normal, and of no other load."""
    bonds = rc.Bonds(1, 1, 1, 1, bending_strength=[2.0, 4.0, 5.0])
    for seed in range(3):
        carried = loads([9.0, -9.0, 9.0], 9.0, [3.0, 3.0, 0.0], -9.0, seed)
        np.testing.assert_allclose(rc.Rolling().load_ratio(carried, bonds), [1.5, 0.75, 0], atol=1e-14)
