"""Chains: their angles by definition, known curves, and chains that run into themselves."""

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.generation.chains import bent_chain, straight_chain
from rheoclast.generation.rings import ring
from rheoclast.particles.morphology import mean_coordination


@pytest.mark.parametrize(("count", "radius"), [(1, 1.0), (2, 3e-7), (500, 1.0)])
def test_straight_chain(assert_exactly_touching, count, radius):
    """Along x, in order, two radii apart."""
    chain = straight_chain(count, radius)
    assert_exactly_touching(chain, count, radius)
    np.testing.assert_allclose(chain.spheres.centers[:, 1:], 0, atol=1e-15 * radius)
    np.testing.assert_allclose(np.diff(chain.spheres.centers[:, 0]), 2 * radius, rtol=1e-12)
    assert chain.is_tree


@pytest.mark.parametrize(("bend", "torsion"), [(0.3, 0.0), (0.5, 0.4), (1.5, -0.9), (2.0, np.pi), (0.02, 3.0)])
def test_angles_are_those_asked_for(assert_exactly_touching, bend, torsion):
    """Successive links enclose the bend; the normals of successive planes the torsion, right-handed about the link."""
    chain = bent_chain(10, 2e-6, bend=bend, torsion=torsion)
    assert_exactly_touching(chain, 10, 2e-6)
    links = np.diff(chain.spheres.centers, axis=0) / 4e-6
    np.testing.assert_allclose(np.arccos(np.sum(links[1:] * links[:-1], axis=1)), bend, rtol=1e-6)
    normals = np.cross(links[:-1], links[1:]) / np.sin(bend)
    sine = np.sum(np.cross(normals[:-1], normals[1:]) * links[1:-1], axis=1)
    cosine = np.sum(normals[:-1] * normals[1:], axis=1)
    np.testing.assert_allclose(np.cos(np.arctan2(sine, cosine) - torsion), 1, atol=1e-12)


def test_contacts_of_an_open_chain_join_successors():
    """And no others."""
    chain = bent_chain(30, bend=0.5, torsion=0.4)
    assert chain.pairs.tolist() == [[k, k + 1] for k in range(29)]


@pytest.mark.parametrize("count", [3, 6, 40])
def test_closing_bend_makes_a_ring(count):
    """2π/N: the last touches the first, and the spheres lie as in a ring, turned about z."""
    chain, circle = bent_chain(count, bend=2 * np.pi / count), ring(count)
    assert [0, count - 1] in chain.pairs.tolist()
    assert len(chain.pairs) == count
    for k in range(count):
        np.testing.assert_allclose(
            np.linalg.norm(chain.spheres.centers - chain.spheres.centers[0], axis=1)[k],
            np.linalg.norm(circle.spheres.centers - circle.spheres.centers[0], axis=1)[k],
            atol=1e-9,
        )


def test_zig_zag_goes_straight_on_average():
    """Torsion π: every second sphere lies on a straight line, 4 cos(bend/2) radii apart."""
    centers = bent_chain(21, bend=1.2, torsion=np.pi).spheres.centers
    steps = np.diff(centers[::2], axis=0)
    np.testing.assert_allclose(steps, np.broadcast_to(steps[0], steps.shape), atol=1e-12)
    assert np.linalg.norm(steps[0]) == pytest.approx(4 * np.cos(0.6), rel=1e-12)


def test_helix_of_tetrahedra():
    """Bend 2π/3 and the torsion arccos(1/3) of the Boerdijk-Coxeter helix: spheres touch the third before too."""
    helix = bent_chain(20, bend=2 * np.pi / 3, torsion=np.arccos(1 / 3))
    assert len(helix.pairs) == 19 + 18 + 17
    assert mean_coordination(helix) == pytest.approx(2 * 54 / 20, rel=1e-15)


def test_a_chain_that_runs_into_itself_is_refused():
    """With the spheres that overlap and what to change."""
    with pytest.raises(
        rc.GeometryError,
        match=r"runs into itself: spheres \d+ and \d+ overlap: distance .* < 2 sphere radii; take fewer spheres",
    ):
        bent_chain(9, bend=2 * np.pi / 7.5)
    assert len(bent_chain(7, bend=2 * np.pi / 7.5)) == 7
    with pytest.raises(rc.GeometryError, match=r"runs into itself: spheres 0 and 3 overlap: distance .* < 2"):
        bent_chain(4, bend=2 * np.pi / 3)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"count": 0, "bend": 0.1}, "count: expected an integer of at least 1, got 0"),
        ({"count": 2.0, "bend": 0.1}, "count: expected an integer of at least 1, got 2.0"),
        ({"count": 4, "bend": -0.1}, "bend: expected zero or a positive number, got -0.1"),
        ({"count": 4, "bend": 2.2}, "bend: expected an angle from 0 to 2π/3 rad = 2.0944, .* got 2.2"),
        ({"count": 4, "bend": 0.1, "torsion": np.inf}, "torsion: expected a finite number, got inf"),
        ({"count": 4, "bend": 0.1, "radius": 0}, "radius: expected a positive number, got 0"),
    ],
)
def test_bad_requests_are_refused(arguments, message):
    """In one sentence."""
    with pytest.raises(ValueError, match=message):
        bent_chain(**arguments)
