"""Orientations of an aggregate in a flow."""

from __future__ import annotations

from scipy.spatial.transform import Rotation

from rheoclast import _checks
from rheoclast._checks import FloatArray


def random_orientations(count: int, seed: int) -> FloatArray:
    """Rotation matrices (count, 3, 3), uniform over SO(3), the same for the same seed.

    ``flow.rotated(matrix)`` is the flow as an aggregate in that orientation meets it.

    Parameters
    ----------
    count
        At least 1.
    seed
        Not negative. More orientations of the same seed begin with the same ones.

    Raises
    ------
    ValueError
        If the count or the seed is no such integer.
    """
    count = _checks.whole_number("count", count, 1)
    return _checks.frozen(Rotation.random(count, rng=_checks.seeded(seed)).as_matrix())
