"""How fragments are pulled apart before the eye."""

import numpy as np
import pytest
from scipy.spatial.distance import cdist

from rheoclast import Spheres
from rheoclast.generation import random_packed_ball
from rheoclast.view.separation import GAP, TURN, separation

BALL = random_packed_ball(60, seed=2)
FACE = np.array([[0, 1], [0, 1], [0, 1]])


def octants(count):
    """Members of `count` fragments of the ball, cut by sphere index along random planes, the largest first."""
    rng = np.random.default_rng(count)
    seeds = rng.normal(size=(count, 3))
    nearest = (BALL.spheres.centers @ seeds.T).argmax(axis=1)
    return tuple(sorted((np.flatnonzero(nearest == k) for k in range(count)), key=lambda part: -len(part)))


def failed_between(members):
    number = np.empty(len(BALL), dtype=int)
    for k, part in enumerate(members):
        number[part] = k
    return BALL.pairs[np.ptp(number[BALL.pairs], axis=1) > 0]


@pytest.mark.parametrize("count", [2, 3, 6])
def test_no_fragment_hides_another_in_the_end(count):
    members, radii = octants(count), BALL.spheres.radii
    parting = separation(BALL.spheres.centers, radii, members, failed_between(members))
    flat = parting.moved(BALL.spheres.centers, np.arange(len(BALL)))[:, :2]
    gaps = cdist(flat, flat) - radii[:, None] - radii
    narrowest = min(gaps[np.ix_(a, b)].min() for k, a in enumerate(members) for b in members[:k])
    assert narrowest > 0.6 * GAP


@pytest.mark.parametrize("progress", [0.0, 0.4, 1.0])
def test_fragments_are_rigid(progress):
    members = octants(3)
    centers = BALL.spheres.centers
    moved = separation(centers, BALL.spheres.radii, members, failed_between(members)).moved(
        centers, np.arange(len(BALL)), progress
    )
    for part in members:
        assert cdist(moved[part], moved[part]) == pytest.approx(cdist(centers[part], centers[part]), abs=1e-9)
    assert (np.abs(moved - centers).max() < 1e-12) == (progress == 0)


def test_two_spheres_part_by_the_gap():
    pair = Spheres(np.array([[0.0, 0, 0], [2, 0, 0]]), 1.0)
    parting = separation(pair.centers, pair.radii, (np.array([0]), np.array([1])), np.array([[0, 1]]))
    first, second = parting.moved(pair.centers, np.arange(2))
    assert second - first == pytest.approx([2 + GAP, 0, 0], abs=0.05)


def test_faces_turn_to_the_viewer():
    centers = np.array([[0.0, 0, 0], [2, 0, 0]])
    parting = separation(centers, np.ones(2), (np.array([0]), np.array([1])), FACE)
    touching = np.array([[1.0, 0, 0], [1, 0, 0]])
    spheres = np.arange(2)
    arms = parting.moved(touching, spheres) - parting.moved(centers, spheres)
    assert arms == pytest.approx(np.array([[np.cos(TURN), 0, np.sin(TURN)], [-np.cos(TURN), 0, np.sin(TURN)]]))


def test_one_or_two_contacts_are_no_face():
    centers = np.array([[0.0, 0, 0], [2, 0, 0]])
    for count in (1, 2):
        parting = separation(centers, np.ones(2), (np.array([0]), np.array([1])), FACE[:count])
        assert not parting.turns.any()


@pytest.mark.parametrize("distance", [2.0, 7.0])
def test_fragments_one_behind_the_other_part_sideways(distance):
    centers = np.array([[0.0, 0, 0], [0, 0, distance]])
    parting = separation(centers, np.ones(2), (np.array([0]), np.array([1])), np.array([[0, 1]]))
    moved = parting.moved(centers, np.arange(2))
    assert moved[1, 0] - moved[0, 0] > 2
