"""Rings, beams and portals of spheres against the frames of the textbooks of structural analysis.

A row of equal spheres of radius a with bending stiffness k_b at each contact is a beam of bending stiffness
EI = 2 a k_b, flexible at the contacts only. The force method gives its redundants: where symmetry leaves one moment
alone, exactly for any number of spheres, and otherwise with an error of second order in spheres per member, both from
the sums that stand for integrals and from the normal and tangential springs. The closed forms (thin ring, closed
rectangular frame, two-bay frame, portal with fixed feet) are derived in the docstrings and are the classical ones.
"""

from itertools import pairwise

import numpy as np
import pytest

import rheoclast as rc

PULL = 3.0
X, Y, Z = np.eye(3)


def ring(count):
    """Regular polygon of touching unit spheres, the first on the x axis; contacts (k, k + 1) and (0, N − 1)."""
    angle = 2 * np.pi * np.arange(count) / count
    corners = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    return rc.Aggregate.touching(rc.Spheres(corners / np.sin(np.pi / count), 1.0))


def point_loads(aggregate, loads):
    """Forces on some of the spheres, none elsewhere, no torque."""
    force = np.zeros((len(aggregate), 3))
    for sphere, value in loads:
        force[sphere] += value
    return rc.SphereLoads(force, np.zeros_like(force))


def between(aggregate, carried, i, j):
    """Force and moment that sphere j exerts on sphere i at their contact, and the contact point."""
    (c,) = np.flatnonzero((aggregate.pairs == sorted((i, j))).all(axis=1))
    sign = 1.0 if i < j else -1.0
    return sign * carried.force[c], sign * carried.moment[c], aggregate.contact_points[c]


def section_moment(aggregate, carried, i, j):
    """Moment about the centre of sphere i of what j exerts on it: the beam's bending moment at that sphere."""
    force, moment, point = between(aggregate, carried, i, j)
    return moment + np.cross(point - aggregate.spheres.centers[i], force)


def assert_second_order(errors):
    """Twice as many spheres, a quarter of the error; the finest is within 1 %."""
    for coarse, fine in pairwise(np.abs(errors)):
        assert 3.5 < coarse / fine < 4.5
    assert abs(errors[-1]) < 0.01


def symmetric_stiffness(aggregate, seed, loads=2):
    """Random stiffness (4, C), equal where contacts are images of each other in the mirrors of the loaded ring."""
    points = aggregate.contact_points
    angle = np.arctan2(points[:, 1], points[:, 0]) % (2 * np.pi / loads)
    angle = np.minimum(angle, 2 * np.pi / loads - angle)
    rank = np.round(angle * len(points) / np.pi).astype(int)
    return 10 ** np.random.default_rng(seed).uniform(-1, 1, (4, rank.max() + 1))[:, rank]


def bonds_of(stiffness):
    return rc.Bonds(normal=stiffness[0], tangential=stiffness[1], bending=stiffness[2], twisting=stiffness[3])


@pytest.mark.parametrize(
    ("count", "loads"), [(6, 2), (8, 2), (10, 2), (12, 2), (6, 3), (9, 3), (12, 3), (8, 4), (12, 4), (12, 6)]
)
@pytest.mark.parametrize("uniform", [True, False], ids=["equal bonds", "symmetric bonds"])
def test_ring_under_equal_radial_forces_is_exact(count, loads, uniform):
    """Force method for m equal outward forces P at angles 2πk/m, for any number of spheres.

    Midway between two loads symmetry leaves no shear: the section carries the tension H = P / (2 sin π/m) along the
    tangent there, and a moment M. From it to the load the force is constant, so a contact at height h along the radius
    of the mid-section has the moment M + H (h_mid − h). The mid-section does not turn, and a unit M meets only the
    bending springs, hence Σ moment/k_b = 0 over the arc: moment = H (⟨h⟩ − h), ⟨h⟩ weighted by 1/k_b. Normal and
    tangential stiffness drop out.
    """
    aggregate = ring(count)
    stiffness = np.tile([[2.0], [0.7], [0.01], [0.02]], count)
    if not uniform:
        stiffness = symmetric_stiffness(aggregate, count + loads, loads)
    loaded = range(0, count, count // loads)
    pulls = [(k, PULL * aggregate.spheres.centers[k] / np.linalg.norm(aggregate.spheres.centers[k])) for k in loaded]
    carried = rc.contact_loads(aggregate, point_loads(aggregate, pulls), bonds_of(stiffness))

    tension = PULL / (2 * np.sin(np.pi / loads))
    size = PULL * np.linalg.norm(aggregate.spheres.centers[0])
    for start in loaded:
        middle = 2 * np.pi * start / count + np.pi / loads
        radial, tangential = np.cos(middle) * X + np.sin(middle) * Y, -np.sin(middle) * X + np.cos(middle) * Y
        arc = [(k, (k + 1) % count) for k in range(start, start + count // loads)]
        found = [between(aggregate, carried, i, j) for i, j in arc]
        height = np.array([point @ radial for _, _, point in found])
        contacts = [np.flatnonzero((aggregate.pairs == sorted(pair)).all(axis=1))[0] for pair in arc]
        mean = np.average(height, weights=1 / stiffness[2, contacts])
        for h, (force, moment, _) in zip(height, found, strict=True):
            np.testing.assert_allclose(force, tension * tangential, atol=1e-10 * PULL)
            np.testing.assert_allclose(moment, tension * (mean - h) * Z, atol=1e-10 * size)


@pytest.mark.parametrize("loads", [2, 3, 4])
@pytest.mark.parametrize("soft", [1.0, 1e-3], ids=["soft in bending", "stiff in bending"])
def test_ring_of_many_spheres_becomes_the_thin_ring(loads, soft):
    """Thin ring under m outward forces, α = π/m: P R/2 (1/α − cot α) at a load, P R/2 (1/α − 1/sin α) midway.

    For two forces P R/π = 0.318 P R and −P R (1/2 − 1/π) = −0.182 P R: they tighten the curve midway.
    """
    angle = np.pi / loads
    at_load, midway = 0.5 * (1 / angle - 1 / np.tan(angle)), 0.5 * (1 / angle - 1 / np.sin(angle))
    if loads == 2:
        assert at_load == pytest.approx(1 / np.pi)
        assert midway == pytest.approx(1 / np.pi - 1 / 2)
    errors = []
    for count in (24, 48, 96):
        aggregate = ring(count)
        radius = np.linalg.norm(aggregate.spheres.centers[0])
        pulls = [(k, PULL * aggregate.spheres.centers[k] / radius) for k in range(0, count, count // loads)]
        bonds = rc.Bonds(normal=1.0, tangential=0.5, bending=0.01 / soft, twisting=0.01 / soft)
        carried = rc.contact_loads(aggregate, point_loads(aggregate, pulls), bonds)
        middle = count // (2 * loads)
        errors.append(
            [
                section_moment(aggregate, carried, 0, 1)[2] / (PULL * radius) / at_load - 1,
                section_moment(aggregate, carried, middle, middle + 1)[2] / (PULL * radius) / midway - 1,
            ]
        )
    for column in np.transpose(errors):
        assert_second_order(column)


@pytest.mark.parametrize("count", [8, 12, 16, 20])
def test_ring_loaded_across_its_plane_twists(count):
    """Forces +P, −P, +P, −P across the plane at every quarter: symmetry alone settles bending and twisting.

    Each load is carried half and half: shear P/2. The mirror through a load forbids twisting there; the mirror at 45°,
    which reverses the loads, forbids bending there. So, for any springs of that symmetry, the bending moment at a load
    is P R/2, and the twisting moment of a contact at 45°, ρ from the middle of the ring, is P/2 (√2 R − ρ): in the
    limit P R/2 (√2 − 1).
    """
    aggregate, quarter = ring(count), count // 4
    radius = np.linalg.norm(aggregate.spheres.centers[0])
    loads = point_loads(aggregate, [(k * quarter, (-1) ** k * PULL * Z) for k in range(4)])
    carried = rc.contact_loads(aggregate, loads, bonds_of(symmetric_stiffness(aggregate, count, loads=4)))
    start = -0.5 * PULL * radius * X  # moment about sphere 0 of what sphere 1 exerts on it
    for k in range(quarter):
        force, moment, point = between(aggregate, carried, k, k + 1)
        np.testing.assert_allclose(force, -0.5 * PULL * Z, atol=1e-10 * PULL)
        expected = start + np.cross(radius * X - point, -0.5 * PULL * Z)
        np.testing.assert_allclose(moment, expected, atol=1e-10 * PULL * radius)
        (c,) = np.flatnonzero((aggregate.pairs == [k, k + 1]).all(axis=1))
        if 2 * k + 1 == quarter:  # this contact stands at 45°, at the foot of the edge's apothem
            twist = 0.5 * PULL * (np.sqrt(2) * radius - np.linalg.norm(point))
            assert carried.twisting[c] == pytest.approx(twist, rel=1e-9)
            assert carried.bending[c] < 1e-10 * PULL * radius


@pytest.mark.parametrize("method", ["statics", "springs"])
def test_three_point_bending_of_a_chain(method):
    """A beam on two supports with P in the middle: shear P/2, bending moment P x/2 up to P L/4 under the load."""
    half = 20
    centers = 2.0 * np.arange(2 * half + 1)[:, None] * X
    aggregate = rc.Aggregate.touching(rc.Spheres(centers, 1.0))
    loads = point_loads(aggregate, [(0, -PULL / 2 * Z), (half, PULL * Z), (2 * half, -PULL / 2 * Z)])
    bonds = rc.Bonds(normal=1.0, tangential=0.5, bending=0.01, twisting=0.01)
    carried = rc.contact_loads(aggregate, loads, bonds, method=method)
    length, place = 4.0 * half, aggregate.contact_points[:, 0]
    distance = np.minimum(place, length - place)  # from the nearer support
    np.testing.assert_allclose(carried.bending, PULL * distance / 2, atol=1e-9 * PULL * length)
    np.testing.assert_allclose(carried.shear, PULL / 2, rtol=1e-9)
    np.testing.assert_allclose(carried.tension, 0, atol=1e-9 * PULL)
    np.testing.assert_allclose(carried.twisting, 0, atol=1e-9 * PULL * length)
    middle = section_moment(aggregate, carried, half, half + 1)
    np.testing.assert_allclose(np.linalg.norm(middle), PULL * length / 4, rtol=1e-9)


class Lattice:
    """Frame of unit spheres on a square lattice of spacing 2, so that only neighbours along a member touch."""

    def __init__(self, members):
        sites = {}
        for (x0, y0), (x1, y1) in members:
            steps = abs(x1 - x0) + abs(y1 - y0)
            for k in range(steps + 1):
                site = (x0 + (x1 - x0) * k // steps, y0 + (y1 - y0) * k // steps)
                sites.setdefault(site, len(sites))
        self.sites = sites
        self.aggregate = rc.Aggregate.touching(rc.Spheres([[2.0 * x, 2.0 * y, 0] for x, y in sites], 1.0))

    def carried(self, loads, beam_over_column, bending=0.05):
        """Contact loads; contacts along x have `beam_over_column` times the bending stiffness of those along y."""
        along_x = np.abs(self.aggregate.normals[:, 0]) > 0.5
        bends = np.where(along_x, beam_over_column, 1.0) * bending
        bonds = rc.Bonds(normal=1.0, tangential=0.4, bending=bends, twisting=bending)
        placed = point_loads(self.aggregate, [(self.sites[site], force) for site, force in loads])
        return rc.contact_loads(self.aggregate, placed, bonds)

    def moment(self, carried, site, towards):
        """In-plane bending moment at the centre of a sphere, from its neighbour in the direction `towards`."""
        other = self.sites[site[0] + towards[0], site[1] + towards[1]]
        return section_moment(self.aggregate, carried, self.sites[site], other)[2]


@pytest.mark.parametrize(("wide", "high"), [(2, 2), (4, 3), (6, 2), (8, 11)])
@pytest.mark.parametrize("ratio", [1.0, 5.0])
def test_closed_rectangular_frame_is_exact(wide, high, ratio):
    """Frame L by H pulled apart by P at the middles of its beams: corner moment P L/8 / (1 + H EI_b / (L EI_c)).

    By symmetry a column carries P/2 and a constant moment M, a beam M − P s/2 at the distance s from the column. The
    section in the middle of the column does not turn: M H/2 / EI_c + (M L/2 − P L²/16) / EI_b = 0. The moment is linear
    along each member, so the sum over equally spaced contacts is the integral, and few spheres do.
    """
    frame = Lattice([((0, 0), (wide, 0)), ((0, high), (wide, high)), ((0, 0), (0, high)), ((wide, 0), (wide, high))])
    assert frame.aggregate.hyperstaticity == 6
    carried = frame.carried([((wide // 2, high), PULL * Y), ((wide // 2, 0), -PULL * Y)], ratio)
    length, height = 2.0 * wide, 2.0 * high
    corner = PULL * length / 8 / (1 + height * ratio / length)
    assert abs(frame.moment(carried, (0, 0), (0, 1))) == pytest.approx(corner, rel=1e-9)
    assert abs(frame.moment(carried, (0, 0), (1, 0))) == pytest.approx(corner, rel=1e-9)
    assert abs(frame.moment(carried, (wide // 2, 0), (1, 0))) == pytest.approx(PULL * length / 4 - corner, rel=1e-9)
    columns = np.abs(frame.aggregate.normals[:, 1]) > 0.5
    np.testing.assert_allclose(carried.tension[columns], PULL / 2, rtol=1e-9)
    np.testing.assert_allclose(carried.bending[columns], corner, rtol=1e-8)
    np.testing.assert_allclose(carried.shear[columns], 0, atol=1e-9 * PULL)


@pytest.mark.parametrize("ratio", [1.0, 3.0])
def test_frame_of_two_bays_converges(ratio):
    """Two bays, each of span l and height H, pulled apart by P at the middle of each of the four half-beams.

    Mirrors keep the middle joints from turning, and stiff columns keep all joints level: each half-beam is fixed at
    the middle joint and held at the corner by the column, which opposes 2 EI_c/H to equal and opposite turns of its
    ends. With s_b = 4 EI_b/l, s_c = 2 EI_c/H and the fixed-end moment P l/8, the corner has P l/8 · s_c/(s_b + s_c) and
    the beam at the middle joint P l/8 · (1 + ½ s_b/(s_b + s_c)).
    """
    errors = []
    for n in (4, 8, 16):
        span, high = 2 * n, 3 * n
        frame = Lattice(
            [((0, 0), (2 * span, 0)), ((0, high), (2 * span, high))]
            + [((x, 0), (x, high)) for x in (0, span, 2 * span)]
        )
        loads = [((x, y), (PULL if y else -PULL) * Y) for x in (n, span + n) for y in (0, high)]
        carried = frame.carried(loads, ratio)
        fixed_end = PULL * 2.0 * span / 8
        beam, column = 4 * ratio / (2.0 * span), 2 / (2.0 * high)
        corner = fixed_end * column / (beam + column)
        joint = fixed_end * (1 + 0.5 * beam / (beam + column))
        errors.append(
            [
                abs(frame.moment(carried, (0, 0), (0, 1))) / corner - 1,
                abs(frame.moment(carried, (span, 0), (1, 0))) / joint - 1,
            ]
        )
        assert abs(frame.moment(carried, (span, 0), (0, 1))) < 1e-9 * joint
    for column_of_errors in np.transpose(errors):
        assert_second_order(column_of_errors)


@pytest.mark.parametrize("ratio", [1.0, 0.25])
def test_swaying_portal_with_fixed_feet_converges(ratio):
    """Portal of span L and height H pushed sideways by P at the top, its feet fixed by mirroring it downwards.

    Joint: 6 EI_b θ/L + 4 EI_c θ/H = 6 EI_c ψ/H; storey: the four column moments sum to P H. With k = (EI_b/L)/(EI_c/H)
    each column has P H/2 · 3k/(6k + 1) at the top and P H/2 · (3k + 1)/(6k + 1) at the foot, of opposite turn.
    """
    errors = []
    for n in (4, 8, 16):
        wide, high = 3 * n, 2 * n
        frame = Lattice(
            [((0, -high), (wide, -high)), ((0, high), (wide, high))] + [((x, -high), (x, high)) for x in (0, wide)]
        )
        loads = [((x, y), PULL / 2 * X) for x in (0, wide) for y in (-high, high)]
        carried = frame.carried([*loads, ((0, 0), -PULL * X), ((wide, 0), -PULL * X)], ratio)
        k = ratio * high / wide
        unit = PULL * 2.0 * high / 2 / (6 * k + 1)
        for column in (0, wide):
            top = frame.moment(carried, (column, high), (0, -1))
            foot = frame.moment(carried, (column, 0), (0, 1))
            # both turn the column the same way round: together they balance the couple of the shear P/2 over H
            assert top + foot == pytest.approx(np.sign(foot) * PULL / 2 * 2.0 * high, rel=1e-9)
        errors.append([abs(top) / (unit * 3 * k) - 1, abs(foot) / (unit * (3 * k + 1)) - 1])
    for column_of_errors in np.transpose(errors):
        assert_second_order(column_of_errors)
