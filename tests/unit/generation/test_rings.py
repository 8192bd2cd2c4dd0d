"""Rings and crosses."""

import numpy as np
import pytest

from rheoclast.generation.rings import cross, ring
from rheoclast.particles.morphology import coordination_distribution, coordination_numbers, loops


@pytest.mark.parametrize("count", [3, 4, 7, 200])
def test_ring_is_one_loop_in_a_plane(assert_exactly_touching, count):
    """Every sphere touches two; they lie on one circle in z = 0, the first on x."""
    circle = ring(count, 1e-7)
    assert_exactly_touching(circle, count, 1e-7)
    assert set(coordination_numbers(circle)) == {2}
    assert loops(circle) == 1
    centers = circle.spheres.centers / 1e-7
    np.testing.assert_allclose(centers[:, 2], 0, atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(centers, axis=1), np.linalg.norm(centers[0]), rtol=1e-12)
    np.testing.assert_allclose(centers[0, 1], 0, atol=1e-12)
    assert centers[0, 0] > 0


@pytest.mark.parametrize(("arm", "arms"), [(1, 4), (5, 4), (1, 6), (4, 6)])
def test_cross_has_arms_of_equal_length(assert_exactly_touching, arm, arms):
    """A tree with one centre, `arms` ends and the rest in between; sphere 0 is the centre, the first arm on +x."""
    star = cross(arm, 2.0, arms=arms)
    assert_exactly_touching(star, 1 + arm * arms, 2.0)
    assert star.is_tree
    share = coordination_distribution(star) * len(star)
    assert share[1] == pytest.approx(arms)
    assert share[2] == pytest.approx(arms * (arm - 1))
    assert coordination_numbers(star)[0] == arms
    np.testing.assert_allclose(star.spheres.centers[0], 0, atol=1e-12)
    np.testing.assert_allclose(star.spheres.centers[1 : arm + 1, 0], 4.0 * np.arange(1, arm + 1), rtol=1e-12)
    flat = np.abs(star.spheres.centers[:, 2]).max() < 1e-12
    assert flat == (arms == 4)


@pytest.mark.parametrize(
    ("request_", "message"),
    [
        (lambda: ring(2), "count: expected an integer of at least 3, got 2"),
        (lambda: cross(0), "arm: expected an integer of at least 1, got 0"),
        (lambda: cross(3, arms=5), r"arms: expected 4 \(in a plane\) or 6 \(in space\), got 5"),
        (lambda: ring(True), "count: expected an integer of at least 3, got True"),
    ],
)
def test_bad_requests_are_refused(request_, message):
    """In one sentence."""
    with pytest.raises(ValueError, match=message):
        request_()
