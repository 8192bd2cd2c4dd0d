"""Brownian walks: returns from outside, and where diffusing spheres arrive, by potential theory."""

import numpy as np
import pytest

from rheoclast.generation._clusters import cluster
from rheoclast.generation._diffusive_deposition import diffusively_deposited
from rheoclast.generation._joining import diffusive_join
from rheoclast.generation._walks import returned, walked


def within_errors(sample, expected, errors=4):
    """Whether a mean is within so many of its standard errors."""
    return abs(np.mean(sample) - expected) < errors * np.std(sample) / np.sqrt(len(sample))


@pytest.mark.parametrize("distance", [1.01, 1.5, 20.0])
def test_returning_paths_follow_the_poisson_kernel(distance):
    """The mean of the Legendre polynomial P_l of the angle is (R/r)^l, as 1/r^(l + 1) is harmonic outside."""
    rng, start = np.random.default_rng(1), np.array([0, 0, 3.0 * distance])
    places = np.array([returned(start, 3.0 * distance, 3.0, rng) for _ in range(4000)])
    np.testing.assert_allclose(np.linalg.norm(places, axis=1), 3.0, rtol=1e-12)
    cosine = places[:, 2] / 3
    assert within_errors(cosine, 1 / distance)
    assert within_errors(1.5 * cosine**2 - 0.5, 1 / distance**2)
    assert within_errors(places[:, 0], 0)


def test_some_paths_never_come_back():
    """A step of length s from the launch sphere ends outside; the share R / r returns, others are lost."""
    rng, place = np.random.default_rng(2), np.array([1.0, 0, 0])
    outcomes = [walked(place, 40.0, 1.0, rng) for _ in range(6000)]
    back = np.array([came for came, _ in outcomes])
    # Mean of 1 / r over a sphere of radius 40 about the start: 1/40 at any point within it.
    assert within_errors(back, 1 / 40)
    assert all(np.linalg.norm(end) <= 1 + 1e-12 for came, end in outcomes if came)
    came, end = walked(np.zeros(3), 0.5, 1.0, rng)
    assert came
    assert np.linalg.norm(end) == pytest.approx(0.5, rel=1e-12)


def arrivals(method, samples):
    """Places where spheres of radius √2 − 1 touch a doublet of unit spheres at z = ±1."""
    rng, radii = np.random.default_rng(3), np.array([1.0, 1.0, np.sqrt(2) - 1])
    doublet, lone = cluster(np.array([[0, 0, -1.0], [0, 0, 1.0]]), radii[:2]), cluster(np.zeros((1, 3)), radii[2:])
    for _ in range(samples):
        if method == "cells":
            centers = diffusively_deposited(radii, rng)
        else:
            joined = diffusive_join(doublet, lone, rng)
            centers = joined.centers[np.argsort(-joined.radii)]
        axis = (centers[1] - centers[0]) / 2
        offset = centers[2] - centers[:2].mean(axis=0)
        yield offset @ axis


@pytest.mark.parametrize("method", ["cells", "tree of balls"])
def test_arrivals_at_a_doublet_follow_the_charge_on_a_conductor(method):
    """The centre arrives at two spheres of radius √2 that cut at right angles, with the density of induced charge.

    That has the moments of three charges (J. C. Maxwell, Treatise on Electricity and Magnetism, art. 168): √2 at either
    centre z = ±1 and −1 midway. As |x − c|² = 2 on the surface, z² − ρ²/2 = 3/2 z² − |z| − 1/2 there.
    """
    height = np.array(list(arrivals(method, 4000)))
    assert within_errors(height, 0)
    assert within_errors(1.5 * height**2 - np.abs(height) - 0.5, 2 * np.sqrt(2) / (2 * np.sqrt(2) - 1))
