"""From which side an aggregate is seen."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from rheoclast import Spheres
from rheoclast.view.projection import principal_axes, view_axes

BENT = Spheres(np.array([[0.0, 0, 0], [2, 0, 0], [4, 0, 0], [6, 0, 0], [6, 2, 0], [6, 2, 2]]), 1.0)


@pytest.mark.parametrize("direction", [None, (1, 0, 0), (0, 0, 1), (0, 0, -1), (0.3, -2, 0.4)])
def test_view_is_a_rotation(direction):
    axes = view_axes(BENT, direction)
    assert axes @ axes.T == pytest.approx(np.eye(3), abs=1e-12)
    assert np.linalg.det(axes) == pytest.approx(1)


def test_view_along_z_has_x_to_the_right_and_y_upwards():
    assert view_axes(BENT, (0, 0, 2)) == pytest.approx(np.eye(3))


def test_view_from_the_side_has_z_upwards():
    right, up, toward = view_axes(BENT, (1, 0, 0))
    assert right == pytest.approx([0, 1, 0])
    assert up == pytest.approx([0, 0, 1])
    assert toward == pytest.approx([1, 0, 0])


def test_default_view_is_the_broadest():
    extents = (BENT.centers @ view_axes(BENT).T).var(axis=0)
    assert extents[0] > extents[1] > extents[2]


@pytest.mark.parametrize("seed", range(5))
def test_default_view_turns_with_the_aggregate(seed):
    rotation = Rotation.random(rng=np.random.default_rng(seed)).as_matrix()
    turned = Spheres(BENT.centers @ rotation.T + [3.0, -2, 5], 1.0)
    assert view_axes(turned) @ rotation == pytest.approx(view_axes(BENT), abs=1e-4)


def test_symmetric_bodies_are_seen_along_the_axes_of_coordinates():
    chain = Spheres(np.array([[0.0, 0, 0], [2, 0, 0], [4, 0, 0]]), 1.0)
    assert view_axes(chain) == pytest.approx(np.eye(3), abs=1e-9)
    assert view_axes(Spheres(np.zeros((1, 3)), 1.0)) == pytest.approx(np.eye(3))


def test_principal_axes_are_sorted_and_true():
    tensor = np.array([[1.0, 2, 0], [2, -3, 1], [0, 1, 2]])
    values, vectors = principal_axes(tensor)
    assert values == pytest.approx(np.linalg.eigvalsh(tensor)[::-1], abs=1e-9)
    assert vectors @ tensor @ vectors.T == pytest.approx(np.diag(values), abs=1e-4)


def test_principal_values_of_nothing_are_zero():
    assert (principal_axes(np.zeros((3, 3)))[0] == 0).all()


def test_zero_direction_is_refused():
    with pytest.raises(ValueError, match=r"view_direction: expected a direction \(x, y, z\), got zeros"):
        view_axes(BENT, (0, 0, 0))
