"""Failure by tension."""

import numpy as np

import rheoclast as rc

from .cases import loads


def test_tension_over_tensile_strength():
    """Negative in compression, and of no other load."""
    carried = loads([3.0, -3.0, 0.0], [9.0, 0.0, 9.0], 9.0, -9.0)
    bonds = rc.Bonds(1, 1, 1, 1, tensile_strength=[2.0, 4.0, 5.0])
    np.testing.assert_allclose(rc.Tension().load_ratio(carried, bonds), [1.5, -0.75, 0], atol=1e-14)
