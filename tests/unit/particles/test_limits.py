import re

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import rheoclast as rc


def pair(distance):
    return rc.Spheres([[0.0, 0.0, 0.0], [distance, 0.0, 0.0]], 1.0, overlap_tolerance=0.1)


def test_default_tolerance_is_a_thousandth_of_the_mean_radius():
    assert len(rc.Aggregate.touching(pair(2.00099)).pairs) == 1
    with pytest.raises(rc.GeometryError, match="2 parts"):
        rc.Aggregate.touching(pair(2.00101))
    rc.Spheres([[0, 0, 0], [1.99901, 0, 0]], 1.0)
    with pytest.raises(rc.GeometryError, match="overlap"):
        rc.Spheres([[0, 0, 0], [1.99899, 0, 0]], 1.0)


def test_exact_touch_is_contact_at_zero_tolerance():
    assert len(rc.Aggregate.touching(pair(2.0), tolerance=0.0).pairs) == 1


def test_near_coincidence_is_an_overlap_and_not_a_duplicate():
    with pytest.raises(rc.GeometryError, match=r"overlap: distance 0\.1 < 2"):
        rc.Spheres([[0, 0, 0], [0.1, 0, 0]], 1.0)


@pytest.mark.parametrize("part", ["force", "torque"])
def test_a_millionth_out_of_balance_is_refused(part):
    force = np.array([[-1.0, 0, 0], [1.0, 0, 0]])
    torque = np.array([[0, -1.0, 0], [0, 1.0, 0]])
    (force if part == "force" else torque)[0] *= 1 + 1e-6
    with pytest.raises(ValueError, match=f"total {part} of zero"):
        rc.contact_loads(rc.Aggregate.touching(pair(2.0)), rc.SphereLoads(force, torque))


def test_torque_out_of_balance_is_refused_far_from_the_origin():
    far = rc.Spheres([[1e5, 0, 0], [1e5 + 2, 0, 0]], 1.0)
    torque = [[0, -1.0, 0], [0, 1.0 + 1e-4, 0]]
    with pytest.raises(ValueError, match="total torque of zero"):
        rc.contact_loads(rc.Aggregate.touching(far), rc.SphereLoads([[-1.0, 0, 0], [1.0, 0, 0]], torque))


ABSURD = [(0.0, 1e60, "radii"), (0.0, 1e-60, "radii"), (1e60, 1.0, "centers")]


def test_turned_and_scaled_spheres_stay_valid():
    """An overlap of just the tolerance does not become too large by rounding."""
    spheres = rc.Spheres([[0, 0, 0], [1.999, 0, 0]], 1.0)
    for seed in range(50):
        turned = spheres.rotated(Rotation.random(random_state=seed))
        assert len(rc.Aggregate.touching(turned.scaled(1.7e-6 * (seed + 1))).pairs) == 1


def test_spheres_at_one_place_are_refused_whatever_the_tolerance():
    with pytest.raises(rc.GeometryError, match="at the same place"):
        rc.Spheres([[0, 0, 0], [0, 0, 0]], 1.0, overlap_tolerance=5)


@pytest.mark.parametrize(("centers", "radius", "name"), ABSURD)
def test_absurd_lengths_are_refused(centers, radius, name):
    message = rf"^{name}\[.*\]: expected a length between 1e-50 and 1e50, got 1e[+-]60; check the unit$"
    with pytest.raises(ValueError, match=message):
        rc.Spheres([[centers, 0, 0]], radius)


def test_advised_overlap_tolerance_suffices():
    with pytest.raises(rc.GeometryError) as refusal:
        rc.Spheres([[0, 0, 0], [1.99899, 0, 0]], 1.0)
    advised = float(re.search(r"at least ([\d.e-]+)\)", str(refusal.value))[1])
    rc.Spheres([[0, 0, 0], [1.99899, 0, 0]], 1.0, overlap_tolerance=advised)
