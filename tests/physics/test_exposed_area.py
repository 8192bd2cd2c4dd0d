"""Exposed area: which part of a sphere's surface sees the fluid unobstructed, and the drag that goes with it.

A sphere of radius b at distance d shelters a cap of half-angle arcsin(b/d), the part (1 − sqrt(1 − b²/d²))/2 of the
surface. Rays on a spiral find a cap to about rays^(−3/4), the discrepancy of such points for caps (measured below);
closed forms are held to that, once per cap.
"""

from math import cos, pi, sqrt

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.hydrodynamics.exposed_area import exposed_fractions

from ..agreement.clusters import sticking_cluster

RAYS = 4096
ACCURACY = RAYS**-0.75  # 0.002
TURN = np.array([[2.0, -1, 2], [2, 2, -1], [-1, 2, 2]]) / 3


def fractions(centers, radii, rays=RAYS):
    """Of spheres turned so that no pair lies on an axis of the spiral."""
    return exposed_fractions(np.array(centers, dtype=float) @ TURN.T, np.array(radii, dtype=float), rays)


class TestClosedForms:
    def test_one_sphere_is_bare(self):
        assert fractions([[1, 2, 3]], [0.7]).tolist() == [1.0]

    def test_touching_doublet(self):
        """Half-angle 30°: (1 + cos 30°)/2 = 0.933."""
        np.testing.assert_allclose(fractions([[0, 0, 0], [0, 0, 2]], [1, 1]), (1 + cos(pi / 6)) / 2, atol=ACCURACY)

    @pytest.mark.parametrize(("a", "b"), [(1.0, 0.5), (1.0, 0.1), (0.3, 2.0)])
    def test_unequal_doublet(self, a, b):
        """Each is sheltered by the other's radius: sin of half-angle b/(a + b) on a, a/(a + b) on b."""
        exact = [(1 + sqrt(1 - (other / (a + b)) ** 2)) / 2 for other in (b, a)]
        np.testing.assert_allclose(fractions([[0, 0, 0], [a + b, 0, 0]], [a, b]), exact, atol=ACCURACY)

    def test_straight_trimer(self):
        """The middle has two caps; the ends have one, for the far sphere stands in the shadow of the near one."""
        end, middle = (1 + cos(pi / 6)) / 2, cos(pi / 6)
        ours = fractions([[0, -2, 0], [0, 0, 0], [0, 2, 0]], [1, 1, 1])
        np.testing.assert_allclose(ours, [end, middle, end], atol=2 * ACCURACY)

    def test_sphere_enclosed_by_twelve(self):
        """Twelve neighbours of a close packing, caps of 30° that just touch: 1 − 6 (1 − cos 30°) = 0.196 is left."""
        near = [[i, j, k] for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1) if abs(i) + abs(j) + abs(k) == 2]
        ours = fractions(np.vstack([np.zeros(3), sqrt(2) * np.array(near)]), np.ones(13))
        assert ours[0] == pytest.approx(1 - 6 * (1 - cos(pi / 6)), abs=12 * ACCURACY)
        assert np.all(ours[1:] > 0.5)

    def test_sphere_in_an_octahedral_hole(self):
        """Six large spheres around one of sqrt(2) − 1: caps of 45°, 1 − 3 (1 − cos 45°) = 0.121 is left."""
        around = sqrt(2) * np.vstack([np.eye(3), -np.eye(3)])
        ours = fractions(np.vstack([np.zeros(3), around]), [sqrt(2) - 1] + [1] * 6)
        assert ours[0] == pytest.approx(1 - 3 * (1 - cos(pi / 4)), abs=6 * ACCURACY)

    def test_far_spheres_are_bare(self):
        """What is sheltered falls like 1/4d²; at 1000 radii it is less than one ray."""
        distances = np.array([4.0, 8.0, 16.0])
        rays = 1_000_000
        sheltered = [1 - fractions([[0, 0, 0], [d, 0, 0]], [1, 1], rays)[0] for d in distances]
        np.testing.assert_allclose(sheltered, (1 - np.sqrt(1 - distances**-2)) / 2, atol=rays**-0.75)
        assert np.all(fractions([[0, 0, 0], [1000, 0, 0], [0, 1000, 700]], [1, 1, 1]) >= 1 - 2 / RAYS)

    @pytest.mark.parametrize("rays", [64, 1024, 16384])
    def test_error_falls_with_the_rays(self, rays):
        """Caps of all sizes anywhere on the sphere: 1.3 rays^(−3/4) at most, and a third of that as root mean square.

        Points at random would give sqrt(f (1 − f)/rays), at 16384 rays ten times as much.
        """
        random = np.random.default_rng(6)
        towards = random.normal(size=(100, 3))
        towards /= np.linalg.norm(towards, axis=1, keepdims=True)
        sines = random.uniform(0.05, 0.95, 100)
        ours = [
            exposed_fractions(np.array([[0.0, 0, 0], u / sine]), np.ones(2), rays)[0]
            for u, sine in zip(towards, sines, strict=True)
        ]
        errors = np.array(ours) - (1 + np.sqrt(1 - sines**2)) / 2
        assert np.abs(errors).max() < 1.3 * rays**-0.75
        assert np.sqrt(np.mean(errors**2)) < 0.43 * rays**-0.75


def by_casting(centers, radii, count, random):
    """Fraction (N,) of rays that escape: random points on each surface, roots of |p + t u − c|² = b² at t > 0."""
    escaped = []
    for i, (center, radius) in enumerate(zip(centers, radii, strict=True)):
        u = random.normal(size=(count, 3))
        u /= np.linalg.norm(u, axis=1, keepdims=True)
        free = np.ones(count, dtype=bool)
        for j, (other, size) in enumerate(zip(centers, radii, strict=True)):
            if i == j:
                continue
            start = center + radius * u - other
            half_b = np.einsum("pi,pi->p", start, u)
            discriminant = half_b**2 - (np.einsum("pi,pi->p", start, start) - size**2)
            hit = discriminant > 0
            hit[hit] = -half_b[hit] + np.sqrt(discriminant[hit]) > 0
            free &= ~hit
        escaped.append(free.mean())
    return np.array(escaped)


@pytest.mark.parametrize("cluster", [(7, 1, 1.0), (10, 2, (0.3, 1.4)), (25, 3, (0.5, 1.0))], ids=str)
def test_overlapping_caps_are_counted_once(cluster):
    """Against casting of random rays, whose standard error is sqrt(f (1 − f)/count) < 0.004; four of these."""
    centers, radii = sticking_cluster(*cluster)
    cast = by_casting(centers, radii, 20_000, np.random.default_rng(4))
    ours = exposed_fractions(centers, radii, RAYS)
    apart = np.linalg.norm(centers[:, None] - centers, axis=-1) + np.diag(np.full(len(radii), np.inf))
    summed = ((1 - np.sqrt(1 - (radii / apart) ** 2)) / 2).sum(axis=1)
    assert np.abs(1 - summed - cast).max() > 0.02  # the caps do overlap
    np.testing.assert_allclose(ours, cast, rtol=0, atol=4 * 0.0036 + 2 * ACCURACY)


class TestLoads:
    def test_are_the_exposed_fraction_of_free_draining(self):
        """Force, torque and stresslet of every sphere in every elementary flow, scaled by its own fraction."""
        spheres = rc.Spheres(*sticking_cluster(8, 5, (0.5, 1.2)))
        sheltered = rc.rigid_response(spheres, rc.ExposedArea(), viscosity=1.0)
        alone = rc.rigid_response(spheres, rc.FreeDraining(), viscosity=1.0)
        exposed = exposed_fractions(spheres.centers, spheres.radii, RAYS)
        np.testing.assert_allclose(
            sheltered.elementary_loads, exposed[:, None, None] * alone.elementary_loads, rtol=0, atol=1e-13 * 100
        )
        held = sheltered.held(rc.simple_shear(1.0)), alone.held(rc.simple_shear(1.0))
        np.testing.assert_allclose(held[0].force, exposed[:, None] * held[1].force, atol=1e-12)
        np.testing.assert_allclose(held[0].torque, exposed[:, None] * held[1].torque, atol=1e-12)

    def test_tension_of_the_doublet(self):
        """Both ends alike: 6π (1 + cos 30°)/2 per e_nn, where free draining has 6π and the fluid 38.4."""
        spheres = rc.Spheres(np.array([[0.0, 0, -1], [0, 0, 1]]), 1.0)
        response = rc.rigid_response(spheres, rc.ExposedArea(), viscosity=1.0)
        loads = response.loads(rc.LinearFlow(np.diag([-0.5, -0.5, 1.0])))
        tension = rc.contact_loads(rc.Aggregate.touching(spheres), loads).tension[0]
        assert tension == pytest.approx(6 * pi * (1 + cos(pi / 6)) / 2, rel=ACCURACY)


@pytest.mark.parametrize("rays", [0, -5, 2.5, "many"])
def test_number_of_rays(rays):
    with pytest.raises(ValueError, match=f"rays: expected an integer of at least 1, got {rays!r}"):
        rc.ExposedArea(rays)
