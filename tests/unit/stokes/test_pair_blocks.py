"""Mobility blocks of pairs of spheres, element by element. Blocks are of order one or smaller; rounding is 1e-15."""

import numpy as np
import pytest

from rheoclast.stokes.basis import MultipoleBasis
from rheoclast.stokes.pair_blocks import PairCoefficients

from ...agreement import projection

BASIS = MultipoleBasis(4)
PAIRS = PairCoefficients.of(BASIS)
SEPARATIONS = np.array([[0, 0, 2.1], [0, 0, -2.1], [2.3, 0, 0], [0, -2.5, 0], [1.2, -1.5, 0.9], [-0.3, 2, -1.7]])
RADII_I = np.array([1.0, 1.0, 0.7, 1.3, 1.0, 0.4])
RADII_J = np.array([1.0, 1.0, 1.6, 0.6, 1.0, 2.0])

SQUARE = {"V": lambda n: (n + 1) * (2 * n + 1), "W": lambda n: n * (2 * n + 1), "X": lambda n: n * (n + 1)}
NAMED = projection.modes(4)
NORM = np.sqrt([SQUARE[kind](n) for kind, n, _ in NAMED])
PLACE = [NAMED.index((f.kind, f.degree, m)) for f in BASIS.families for m in range(-f.degree, f.degree + 1)]


def blocks(separations=SEPARATIONS, radii_i=RADII_I, radii_j=RADII_J):
    return PAIRS.blocks(separations, radii_i, radii_j)


def pairs_of_families():
    named = list(zip(BASIS.families, BASIS.slices, strict=True))
    return [
        pytest.param(f, g, rows, columns, id=f"{f.kind}{f.degree}-{g.kind}{g.degree}")
        for f, rows in named
        for g, columns in named
    ]


@pytest.mark.parametrize("pair", range(len(SEPARATIONS)))
def test_against_quadrature(pair):
    """Projection of the source's exterior flow on the target's modes, which knows neither rotations nor derivatives.

    Integrated over the smaller sphere, 40 nodes leave (smaller radius / distance)^80.
    """
    separation, a_i, a_j = SEPARATIONS[pair], RADII_I[pair], RADII_J[pair]
    if a_i <= a_j:
        theirs = projection.block(4, separation, a_i, a_j, nodes=40)
    else:
        theirs = projection.block(4, -separation, a_j, a_i, nodes=40).T
    expected = (theirs / NORM[:, None] / NORM)[np.ix_(PLACE, PLACE)]
    np.testing.assert_allclose(blocks()[pair], expected, rtol=0, atol=1e-13)


def test_symmetric_under_exchange():
    """Reciprocity: what i does to j is the transpose of what j does to i, for unequal spheres too."""
    exchanged = blocks(-SEPARATIONS, RADII_J, RADII_I)
    np.testing.assert_allclose(exchanged.transpose(0, 2, 1), blocks(), rtol=0, atol=1e-14)


@pytest.mark.parametrize("scale", [1e-3, 7.0])
def test_mobility_is_one_over_length(scale):
    scaled = blocks(scale * SEPARATIONS, scale * RADII_I, scale * RADII_J)
    np.testing.assert_allclose(scale * scaled, blocks(), rtol=0, atol=1e-14)


@pytest.mark.parametrize(("family", "other", "rows", "columns"), pairs_of_families())
def test_decay_with_distance(family, other, rows, columns):
    """Families of ranks l and l' meet like r^−(l + l' + 1), with corrections (a/r)²; V meets W alone.

    V makes a potential flow, ∇(Y/r^(n+1)); around another sphere that is a sum of W. From 100 to 200 radii the
    corrections are below l² 1e-4.
    """
    direction = np.array([2.0, -1, 2]) / 3
    near, far = blocks(np.array([100 * direction, 200 * direction]), np.ones(2), np.full(2, 0.8))
    strength = np.linalg.norm(near[rows, columns]), np.linalg.norm(far[rows, columns])
    if "V" in (family.kind, other.kind) and "W" not in (family.kind, other.kind):
        assert strength[0] < 1e-14 * 100.0 ** -(family.rank + other.rank + 1)
        assert np.abs(blocks()[:, rows, columns]).max() < 1e-15
    else:
        assert strength[0] > 0
        assert np.log2(strength[0] / strength[1]) == pytest.approx(family.rank + other.rank + 1, abs=1e-3)


def test_only_equal_orders_meet_on_the_axis():
    """Pair along z: no element between m and m' ≠ m, none between cos mφ and sin mφ but for X with V or W."""
    block = blocks(np.array([[0, 0, 2.0]]), np.ones(1), np.ones(1))[0]
    m = np.concatenate([np.arange(-f.degree, f.degree + 1) for f in BASIS.families])
    assert np.abs(block[np.abs(m)[:, None] != np.abs(m)]).max() < 1e-15
    swirling = np.concatenate([np.full(f.size, f.kind == "X") for f in BASIS.families])
    alike = swirling[:, None] == swirling
    assert np.abs(block[alike & (m[:, None] != m)]).max() < 1e-15
    assert np.abs(block[~alike & (m[:, None] != -m)]).max() < 1e-15
    assert np.abs(block[~alike]).max() > 1e-3


def test_a_tiny_sphere_feels_the_flow_at_its_centre():
    """Rows of its force modes, which are the unit vectors (y, z, x)/√4π: √4π times the other's velocity there.

    What is left out is O(a²) = 1e-12.
    """
    centre = np.array([1.2, -1.5, 0.9])
    block = blocks(centre[None], np.array([1e-6]), np.array([1.0]))[0]
    velocity = projection.velocities(4, centre[None])[:, 0]
    expected = np.sqrt(4 * np.pi) * (velocity / NORM[:, None])[PLACE].T[[1, 2, 0]]
    np.testing.assert_allclose(block[:3], expected, rtol=0, atol=1e-11)
