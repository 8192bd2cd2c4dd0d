"""Failure by twisting."""

import numpy as np

import rheoclast as rc

from .cases import loads


def test_size_of_the_twisting_moment_over_twisting_strength():
    """Either way round, and of no other load."""
    carried = loads([9.0, -9.0, 9.0], 9.0, 9.0, [3.0, -3.0, 0.0])
    bonds = rc.Bonds(1, 1, 1, 1, twisting_strength=[2.0, 4.0, 5.0])
    np.testing.assert_allclose(rc.Twisting().load_ratio(carried, bonds), [1.5, 0.75, 0], atol=1e-14)
