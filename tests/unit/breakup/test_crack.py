"""Breakup of small aggregates, by hand and by definition."""

import inspect

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.generation import cluster_cluster, cross, lattice_ball, random_packed_ball, ring, straight_chain

STIFFNESS = (1.0, 0.8, 6e-3, 8e-3)
LOOSE = 1e-20  # as good as no stiffness
TRIANGLE = np.array([[0, 0, 0], [2, 0, 0], [1, np.sqrt(3), 0]])
TETRAHEDRON = np.vstack([TRIANGLE, [1, 1 / np.sqrt(3), np.sqrt(8 / 3)]])
TWO_TETRAHEDRA = np.vstack([TETRAHEDRON, TETRAHEDRON * [1, 1, -1] - [0, 0, 2]])
ALONG_X = rc.LinearFlow(np.diag([1.0, -0.5, -0.5]))
SPIN = rc.LinearFlow([[0, -1.0, 0], [1.0, 0, 0], [0, 0, 0]])
DRAG = 6 * np.pi  # of a sphere, which drains freely
ASKEW = rc.random_orientations(1, seed=8)[0]


def touching(centers):
    return rc.Aggregate.touching(rc.Spheres(centers, 1.0))


def response_of(aggregate, model=None):
    return rc.rigid_response(aggregate.spheres, model or rc.FreeDraining(), viscosity=1.0)


def broken(aggregate, flow, rule="weakest", criterion=rc.EVERY_LIMIT, up_to=np.inf, **strength):
    bonds = rc.Bonds(*STIFFNESS, **(strength or {"tensile_strength": 2.0}))
    return rc.break_up(aggregate, response_of(aggregate), bonds, flow, rule=rule, criterion=criterion, up_to=up_to)


def contact_of(aggregate, first, second):
    return int(np.flatnonzero((aggregate.pairs == [first, second]).all(axis=1))[0])


def flawed(aggregate, contact, share=0.1, strength=2.0):
    """Strengths, equal but for one."""
    values = np.full(len(aggregate.pairs), strength)
    values[contact] *= share
    return values


class TestChain:
    """In extension along a chain of free-draining spheres the tension is largest in the middle.

    Ten spheres at x = ±1 … ±9: contact k carries 6π Σ x of the spheres beyond, 9, 16, 21, 24, 25, 24 … per unit rate.
    """

    def test_breaks_in_the_middle_at_the_rate_of_stokes_drag(self):
        breakup = broken(straight_chain(10), ALONG_X)
        (failure,) = breakup.failures
        assert failure.pair == (4, 5)
        assert failure.criterion == "tension"
        assert failure.radial_position == pytest.approx(0, abs=1e-12)
        assert failure.depth == 1
        assert failure.rate == pytest.approx(ALONG_X.rate * 2.0 / (DRAG * 25), rel=1e-9)
        assert failure.margin == pytest.approx(1 / 25)
        assert failure.rivals is None
        assert breakup.is_single_bond
        assert [len(fragment) for fragment in breakup.fragments] == [5, 5]

    def test_rate_of_the_flow_does_not_matter(self):
        slow, fast = (broken(straight_chain(6), ALONG_X.scaled(factor)) for factor in (1e-3, 1e6))
        assert slow.breakup_rate == pytest.approx(fast.breakup_rate, rel=1e-12)

    def test_stronger_contact_sends_the_failure_elsewhere(self):
        breakup = broken(straight_chain(10), ALONG_X, tensile_strength=flawed(straight_chain(10), 4, share=10))
        assert breakup.failures[0].pair in ((3, 4), (5, 6))
        assert breakup.failures[0].margin == pytest.approx(0, abs=1e-9)

    def test_a_flaw_at_the_end_cuts_off_one_sphere(self):
        """A tenth of the strength against 9/25 of the load."""
        breakup = broken(straight_chain(10), ALONG_X, tensile_strength=flawed(straight_chain(10), 0))
        assert breakup.failures[0].rate == pytest.approx(ALONG_X.rate * 0.2 / (DRAG * 9), rel=1e-9)
        assert [spheres.tolist() for spheres in breakup.spheres] == [list(range(1, 10)), [0]]
        assert len(breakup.fragments[1].pairs) == 0

    def test_strength_as_the_tension_lets_every_contact_fail_at_once(self):
        beyond = np.array([9, 16, 21, 24, 25, 24, 21, 16, 9.0])
        breakup = broken(straight_chain(10), ALONG_X, "overloaded", tensile_strength=beyond)
        assert sorted(failure.contact for failure in breakup.failures) == list(range(9))
        assert [len(fragment) for fragment in breakup.fragments] == [1] * 10
        np.testing.assert_allclose([failure.rate for failure in breakup.failures], ALONG_X.rate / DRAG, rtol=1e-9)

    def test_two_failures_at_once_make_three_fragments(self):
        strength = np.array([2.0, 9, 16, 9, 9, 9, 16, 9, 2])  # 9/2 and 21/16 of the load come first
        breakup = broken(straight_chain(10), ALONG_X, "overloaded", tensile_strength=strength)
        assert [spheres.tolist() for spheres in breakup.spheres] == [list(range(1, 9)), [0], [9]]
        assert breakup.outcome == "crack"

    def test_compression_breaks_nothing(self):
        breakup = broken(straight_chain(6), rc.LinearFlow(np.diag([-1.0, 0.5, 0.5])))
        assert breakup.outcome == "whole"
        assert breakup.failures == ()
        assert breakup.initiation_rate == breakup.breakup_rate == np.inf
        assert len(breakup.fragments[0]) == 6


class TestDoublet:
    """Two free-draining spheres at an angle θ to the axis of planar extension, along n.

    The tension is 6π cos 2θ. Across n, rotation with 3/7 of n × E·n leaves 4/7 of the drag, 6π · 4/7 sin 2θ.
    """

    @staticmethod
    def at(degrees):
        angle = np.deg2rad(degrees)
        n = np.array([np.cos(angle), np.sin(angle), 0])
        return touching(np.array([-n, n])), DRAG * np.cos(2 * angle), DRAG * 4 / 7 * np.sin(2 * angle)

    @pytest.mark.parametrize("degrees", [10, 30, 60, 80])
    def test_slides_under_tension_and_compression_alike_without_friction(self, degrees):
        doublet, _, shear = self.at(degrees)
        breakup = broken(doublet, rc.planar_extension(1.0), criterion=rc.Sliding(), shear_strength=3.0)
        assert breakup.breakup_rate == pytest.approx(3.0 / shear, rel=1e-9)
        assert breakup.failures[0].criterion == "sliding"
        assert breakup.failures[0].margin == 1

    @pytest.mark.parametrize("degrees", [10, 30, 60, 80])
    @pytest.mark.parametrize("friction", [0.3, 0.8])
    def test_slides_at_the_limit_of_coulomb(self, degrees, friction):
        """λ shear = S − μ λ tension; at 80° compression holds it however fast the flow."""
        doublet, tension, shear = self.at(degrees)
        breakup = broken(doublet, rc.planar_extension(1.0), criterion=rc.Sliding(friction), shear_strength=3.0)
        assert breakup.splits == (shear > -friction * tension)
        assert breakup.splits == (degrees != 80)
        if breakup.splits:
            rate = breakup.breakup_rate
            assert rate * shear == pytest.approx(3.0 - friction * rate * tension, rel=1e-9)

    def test_each_load_uses_up_its_share(self):
        doublet, tension, shear = self.at(20)
        strength = {"tensile_strength": 2.0, "shear_strength": 3.0}
        for criterion, rate in (
            (rc.Combined(1), 1 / (tension / 2 + shear / 3)),
            (rc.Combined(2), 1 / np.hypot(tension / 2, shear / 3)),
            (rc.Tension() | rc.Sliding(), 1 / max(tension / 2, shear / 3)),
            (rc.EVERY_LIMIT, 1 / max(tension / 2, shear / 3)),
        ):
            breakup = broken(doublet, rc.planar_extension(1.0), criterion=criterion, **strength)
            assert breakup.breakup_rate == pytest.approx(rate, rel=1e-9)

    @pytest.mark.parametrize(("shear_strength", "name"), [(0.3, "sliding"), (30.0, "tension")])
    def test_whichever_is_met_first_is_told(self, shear_strength, name):
        breakup = broken(
            self.at(20)[0],
            rc.planar_extension(1.0),
            criterion=rc.Tension() | rc.Sliding(),
            tensile_strength=2.0,
            shear_strength=shear_strength,
        )
        assert breakup.failures[0].criterion == name


def parts_of(carried):
    """Tension, shear, bending and size of twisting (C,) from force and moment."""
    n, force, moment = carried.normals, carried.force, carried.moment
    tension, twisting = np.einsum("ci,ci->c", n, force), np.einsum("ci,ci->c", n, moment)
    shear = np.linalg.norm(force - tension[:, None] * n, axis=1)
    bending = np.linalg.norm(moment - twisting[:, None] * n, axis=1)
    return tension, shear, bending, abs(twisting)


BY_HAND = {
    "tension": (rc.Tension(), lambda t, s, b, w: {"tension": t}),
    "sliding": (rc.Sliding(), lambda t, s, b, w: {"sliding": s}),
    "friction": (rc.Sliding(0.5), lambda t, s, b, w: {"sliding": s}),
    "rolling": (rc.Rolling(), lambda t, s, b, w: {"rolling": b}),
    "twisting": (rc.Twisting(), lambda t, s, b, w: {"twisting": w}),
    "sum": (rc.Combined(1), lambda t, s, b, w: {"combined": np.maximum(t, 0) + s + b + w}),
    "squares": (rc.Combined(2), lambda t, s, b, w: {"combined": np.sqrt(np.maximum(t, 0) ** 2 + s**2 + b**2 + w**2)}),
    "any of": (rc.Tension() | rc.Sliding(), lambda t, s, b, w: {"tension": t, "sliding": s}),
    "every limit": (rc.EVERY_LIMIT, lambda t, s, b, w: {"tension": t, "sliding": s, "rolling": b, "twisting": w}),
}


@pytest.mark.parametrize(
    "aggregate", [random_packed_ball(14, seed=3), cluster_cluster(14, seed=3)], ids=["loops", "tree"]
)
@pytest.mark.parametrize("name", BY_HAND)
def test_first_failure_by_each_criterion(aggregate, name):
    """Which contact, at which rate and by what, from the loads in every contact; there the load ratio is one."""
    criterion, hand = BY_HAND[name]
    strength = 10 ** np.random.default_rng(1).uniform(-0.5, 0.5, (4, len(aggregate.pairs)))
    bonds, flow = rc.Bonds(*STIFFNESS, *strength), rc.planar_extension(3.0).rotated(ASKEW)
    response = response_of(aggregate)
    tension, shear, bending, twisting = parts_of(rc.contact_loads(aggregate, response.loads(flow), bonds))
    if name == "friction":
        shear = np.maximum(shear + 0.5 * tension, 0)
    ratios = hand(*(load / limit for load, limit in zip((tension, shear, bending, twisting), strength, strict=True)))
    decisive = max(ratios, key=lambda each: ratios[each].max())
    first = rc.break_up(aggregate, response, bonds, flow, criterion=criterion).failures[0]
    assert first.contact == ratios[decisive].argmax()
    assert first.criterion == decisive
    assert first.rate == pytest.approx(flow.rate / ratios[decisive].max(), rel=1e-9)
    at_failure = rc.contact_loads(aggregate, response.loads(flow.scaled(first.rate / flow.rate)), bonds)
    at_failure = criterion.load_ratio(at_failure, bonds)
    assert at_failure[first.contact] == pytest.approx(1, rel=1e-9)
    assert at_failure.max() == pytest.approx(1, rel=1e-9)
    second = np.sort(np.max(list(ratios.values()), axis=0))[-2]
    assert first.margin == pytest.approx(1 - second / ratios[decisive].max(), rel=1e-6)


@pytest.mark.parametrize("strength", ["tensile_strength", "shear_strength", "bending_strength", "twisting_strength"])
def test_a_flawed_contact_fails_first(strength):
    """However strong the others, the one with hardly any strength."""
    aggregate = random_packed_ball(14, seed=3)
    flow = rc.simple_shear(1.0).rotated(ASKEW)
    carried = rc.contact_loads(aggregate, response_of(aggregate).loads(flow), rc.Bonds(*STIFFNESS))
    for contact in np.flatnonzero(carried.tension > 0)[:4]:
        breakup = broken(aggregate, flow, **{strength: flawed(aggregate, contact, 1e-6)})
        assert breakup.failures[0].contact == contact


class TestManyFragments:
    def test_a_cross_stretched_along_both_its_arms(self):
        """The four inner contacts tie: four arms, and the middle."""
        breakup = broken(cross(3), rc.biaxial_extension(0.5), "overloaded")
        assert sorted(map(len, breakup.fragments)) == [1, 3, 3, 3, 3]
        assert len(breakup.failures) == 4
        assert breakup.outcome == "crack"

    @pytest.mark.parametrize("count", [3, 6, 11])
    def test_a_ring_stretched_in_its_plane_falls_into_its_spheres(self, count):
        """The drag 6π R outwards on each of n spheres is the hoop tension times 2 sin π/n, with R sin π/n = 1."""
        breakup = broken(ring(count), rc.biaxial_extension(1.0), "overloaded")
        assert sorted(failure.contact for failure in breakup.failures) == list(range(count))
        assert [spheres.tolist() for spheres in breakup.spheres] == [[k] for k in range(count)]
        hoop = DRAG / (2 * np.sin(np.pi / count) ** 2)
        np.testing.assert_allclose([failure.rate for failure in breakup.failures], 2.0 / hoop, rtol=1e-9)
        assert {failure.margin for failure in breakup.failures} == {1}, "none holds"
        assert breakup.near_ties(1e-6) == ()
        assert len(breakup.surface) == count

    def test_the_same_ring_one_contact_at_a_time(self):
        """The chain that is left bends; by tension alone it parts in two."""
        breakup = broken(ring(6), rc.biaxial_extension(1.0))
        assert len(breakup.failures) == 2
        assert len(breakup.fragments) == 2


class TestMechanism:
    """Contacts that take no moment and no longer hold a part, though it still touches."""

    def broken_between(self, flaw):
        """Two tetrahedra, base on base, pulled apart with one of the three contacts between them flawed."""
        aggregate = touching(TWO_TETRAHEDRA)
        bonds = rc.Bonds(1.0, 0.8, LOOSE, LOOSE, tensile_strength=flawed(aggregate, flaw, 1e-3))
        return rc.break_up(aggregate, response_of(aggregate), bonds, rc.uniaxial_extension(1.0))

    @pytest.mark.parametrize("first", range(3))
    def test_a_hinge_is_released(self, first):
        """Without one of three the other two are a hinge between rigid bodies."""
        aggregate = touching(TWO_TETRAHEDRA)
        between = [contact_of(aggregate, k, k + 4) for k in range(3)]
        breakup = self.broken_between(between[first])
        assert [failure.contact for failure in breakup.failures] == [between[first]]
        np.testing.assert_array_equal(breakup.released, np.delete(between, first))
        assert [spheres.tolist() for spheres in breakup.spheres] == [[0, 1, 2, 3], [4, 5, 6, 7]]
        assert breakup.outcome == "bond"
        assert breakup.surface == breakup.failures
        for fragment in breakup.fragments:
            np.testing.assert_array_equal(fragment.pairs, touching(TETRAHEDRON).pairs)

    def test_with_moments_the_same_contacts_hold(self):
        """All three have to fail."""
        aggregate = touching(TWO_TETRAHEDRA)
        between = [contact_of(aggregate, k, k + 4) for k in range(3)]
        breakup = broken(aggregate, rc.uniaxial_extension(1.0), tensile_strength=flawed(aggregate, between, 1e-3))
        assert sorted(failure.contact for failure in breakup.failures) == between
        assert len(breakup.released) == 0

    def test_a_sphere_that_turns_about_two_contacts_is_a_fragment(self):
        """The tip of a tetrahedron whose base takes moments."""
        aggregate = touching(TETRAHEDRON)
        tip = [contact_of(aggregate, k, 3) for k in range(3)]
        moment = np.where(np.isin(np.arange(6), tip), LOOSE, 6e-3)
        bonds = rc.Bonds(1.0, 0.8, moment, moment, tensile_strength=flawed(aggregate, tip[1], 1e-3))
        breakup = rc.break_up(aggregate, response_of(aggregate), bonds, rc.uniaxial_extension(1.0))
        assert [spheres.tolist() for spheres in breakup.spheres] == [[0, 1, 2], [3]]
        np.testing.assert_array_equal(breakup.released, [tip[0], tip[2]])

    def test_a_ring_with_one_contact_that_takes_no_moment(self):
        """It holds as long as the ring is closed; cut anywhere, two arms swing about that contact."""
        aggregate = ring(6)
        free, cut = contact_of(aggregate, 1, 2), contact_of(aggregate, 4, 5)
        moment = np.where(np.arange(6) == free, LOOSE, 6e-3)
        bonds = rc.Bonds(1.0, 0.8, moment, moment, tensile_strength=flawed(aggregate, cut, 1e-3))
        breakup = rc.break_up(aggregate, response_of(aggregate), bonds, rc.biaxial_extension(1.0))
        assert [spheres.tolist() for spheres in breakup.spheres] == [[0, 1, 5], [2, 3, 4]]
        assert [failure.contact for failure in breakup.surface] == [cut]
        np.testing.assert_array_equal(breakup.released, [free])

    @pytest.mark.parametrize("count", [1, 2])
    def test_loose_from_the_start(self, count):
        """A sphere that hangs on one contact, or two, without moment."""
        hanging = {1: [[-2, 0, 0]], 2: [[1, -np.sqrt(3), 0]]}[count]
        aggregate = touching(np.vstack([TETRAHEDRON, hanging]))
        assert np.count_nonzero(aggregate.pairs == 4) == count
        bonds = rc.Bonds(1.0, 0.8, LOOSE, LOOSE, tensile_strength=1.0)
        with pytest.raises(ValueError, match=r"^bonds: expected contacts that hold the spheres, got some that turn"):
            rc.break_up(aggregate, response_of(aggregate), bonds, ALONG_X)

    def test_normal_forces_alone_do_not_hold_two_bases_upon_each_other(self):
        """Three parallel ones: the tetrahedra slide past each other, and all spheres spin."""
        aggregate = touching(TWO_TETRAHEDRA)
        bonds = rc.Bonds(1.0, LOOSE, LOOSE, LOOSE, tensile_strength=1.0)
        with pytest.raises(ValueError, match="bring bending, twisting and tangential stiffness closer to the normal"):
            rc.break_up(aggregate, response_of(aggregate), bonds, rc.uniaxial_extension(1.0))


class TestWhole:
    def test_a_contact_fails_and_the_rest_is_compressed(self):
        """A triangle stretched along its base and pressed upon its tip, which the base alone holds apart.

        Without the base the two sides carry ½ (e1 + e2) 6π, from the drag (−e1, −e2 / √3) on a lower sphere.
        """
        flow = rc.LinearFlow(np.diag([1.0, -2.0, 1.0]))
        breakup = broken(touching(TRIANGLE), flow)
        assert [failure.pair for failure in breakup.failures] == [(0, 1)]
        assert breakup.outcome == "whole"
        assert not breakup.splits
        assert breakup.initiation_rate < breakup.breakup_rate == np.inf
        assert breakup.surface == ()
        (left,) = breakup.fragments
        np.testing.assert_array_equal(left.pairs, [[0, 2], [1, 2]])
        carried = rc.contact_loads(left, response_of(left).loads(flow))
        np.testing.assert_allclose(carried.tension, DRAG * (1 - 2) / 2, rtol=1e-9)

    def test_the_same_triangle_splits_where_its_sides_are_stretched(self):
        flow = rc.LinearFlow(np.diag([1.0, -0.5, -0.5]))
        breakup = broken(touching(TRIANGLE), flow)
        assert breakup.outcome == "crack"
        assert breakup.failures[1].rate == pytest.approx(flow.rate * 2.0 / (DRAG * 0.25), rel=1e-9)

    @pytest.mark.parametrize("seed", range(4))
    def test_compact_clusters_pressed_from_random_sides(self, seed):
        """Whatever is left of a whole one is nowhere stretched, and one that splits is in parts."""
        aggregate = random_packed_ball(5, seed=1)
        flow = rc.biaxial_extension(1.0).rotated(rc.random_orientations(10, seed=1)[[3, 5, 6, 7][seed]])
        breakup = broken(aggregate, flow)
        kept = sum(map(len, breakup.contacts))
        assert kept + len(breakup.failures) == len(aggregate.pairs)
        left = breakup.fragments[0]
        assert breakup.splits == (len(left) < 5)
        if not breakup.splits:
            carried = rc.contact_loads(left, response_of(left).loads(flow), rc.Bonds(*STIFFNESS))
            assert carried.tension.max() <= 0


class TestUpTo:
    AGGREGATE = random_packed_ball(40, seed=4)
    STRENGTH = 10 ** np.random.default_rng(4).uniform(-1, 0, len(AGGREGATE.pairs))

    def broken(self, rule="weakest", **others):
        return broken(self.AGGREGATE, rc.simple_shear(2.5), rule, tensile_strength=self.STRENGTH, **others)

    @pytest.mark.parametrize("rule", ["weakest", "overloaded"])
    def test_nothing_fails_beyond(self, rule):
        """As the whole sequence, cut where the rate would have to be raised; anything below splits nothing."""
        whole = self.broken(rule)
        reached = np.array([failure.reached for failure in whole.failures])
        levels = np.unique(reached)
        assert len(levels) > 5
        for limit in (levels[1:] + levels[:-1]) / 2:
            cut = self.broken(rule, up_to=limit)
            count = np.count_nonzero(reached <= limit)
            assert cut.failures == whole.failures[:count]
            assert cut.outcome == "whole"
            assert cut.breakup_rate == np.inf
            assert len(cut.contacts[0]) == len(self.AGGREGATE.pairs) - count

    def test_above_the_rate_of_breakup_it_splits(self):
        whole = self.broken()
        for limit in ((1 + 1e-12) * whole.breakup_rate, 2 * whole.breakup_rate, np.inf):
            again = self.broken(up_to=limit)
            assert again.failures == whole.failures
            assert again.splits

    def test_below_the_first_failure_nothing_happens(self):
        assert self.broken(up_to=0.999 * self.broken().initiation_rate).failures == ()

    @pytest.mark.parametrize("limit", [0, -1.0, np.nan, "fast"])
    def test_refused(self, limit):
        with pytest.raises(ValueError, match=r"^up_to: expected a (positive |finite )?number, got"):
            self.broken(up_to=limit)


def test_where_the_flow_is_raised_the_rate_reached_is_the_rate_to_the_last_digit():
    """So that a flow up to the rate of breakup splits it, and a single bond breaks where the breakup begins."""
    aggregate = straight_chain(6)
    for orientation in rc.random_orientations(20, seed=1):
        flow = rc.planar_extension(3.0).rotated(orientation)
        breakup = broken(aggregate, flow, shear_strength=3.0)
        assert breakup.breakup_rate == breakup.initiation_rate
        assert broken(aggregate, flow, shear_strength=3.0, up_to=breakup.breakup_rate).splits


def test_fragments_are_the_spheres_and_contacts_that_are_left():
    aggregate = random_packed_ball(60, seed=1)
    breakup = broken(aggregate, rc.uniaxial_extension(1.0))
    assert sorted(np.concatenate(breakup.spheres).tolist()) == list(range(60))
    for fragment, spheres in zip(breakup.fragments, breakup.spheres, strict=True):
        np.testing.assert_array_equal(fragment.spheres.centers, aggregate.spheres.centers[spheres])
    whole = {tuple(pair) for pair in aggregate.pairs.tolist()}
    inside = {tuple(s[p].tolist()) for f, s in zip(breakup.fragments, breakup.spheres, strict=True) for p in f.pairs}
    lost = {failure.pair for failure in breakup.failures}
    assert inside | lost == whole
    assert not inside & lost
    assert [len(fragment) for fragment in breakup.fragments] == sorted(map(len, breakup.fragments), reverse=True)


@pytest.mark.parametrize("rule", ["weakest", "overloaded"])
def test_rates(rule):
    """What was reached is the largest rate so far, and only in an avalanche more than a contact needs."""
    breakup = broken(lattice_ball("fcc", 43), rc.simple_shear(1.0), rule)
    rates, reached = np.array([(failure.rate, failure.reached) for failure in breakup.failures]).T
    assert breakup.initiation_rate == rates[0] == reached[0]
    assert breakup.breakup_rate == reached[-1] == pytest.approx(rates.max(), rel=1e-11)
    np.testing.assert_allclose(reached, np.maximum.accumulate(rates), rtol=1e-11)
    overload = np.array([failure.overload for failure in breakup.failures])
    assert (overload >= 1 - 1e-11).all()
    assert (overload > 1.01).any()


def test_places_are_those_of_the_contact_points():
    aggregate = random_packed_ball(30, seed=2)
    for failure in broken(aggregate, rc.uniaxial_extension(1.0)).failures:
        assert failure.pair == tuple(aggregate.pairs[failure.contact])
        point = aggregate.contact_points[[failure.contact]]
        assert failure.depth == pytest.approx(rc.depth(aggregate, point)[0], rel=1e-12)
        assert failure.radial_position == pytest.approx(rc.radial_position(aggregate, point)[0], rel=1e-12)


class TestEach:
    AGGREGATE = random_packed_ball(20, seed=5)
    BONDS = rc.Bonds(*STIFFNESS, tensile_strength=2.0, shear_strength=3.0)
    ORIENTATIONS = rc.random_orientations(4, seed=6)

    @pytest.mark.parametrize("rule", ["weakest", "overloaded"])
    def test_is_one_after_the_other(self, rule):
        flows = [rc.simple_shear(2.0).rotated(each) for each in self.ORIENTATIONS] + [rc.uniaxial_extension(1.0)]
        response = response_of(self.AGGREGATE)
        criterion = rc.Combined(1)
        events = list(
            rc.break_up_each(self.AGGREGATE, response, self.BONDS, flows, rule=rule, criterion=criterion, up_to=1.0)
        )
        assert len(events) == 5
        for event, flow in zip(events, flows, strict=True):
            alone = rc.break_up(self.AGGREGATE, response, self.BONDS, flow, rule=rule, criterion=criterion, up_to=1.0)
            assert event.failures == alone.failures
            assert [spheres.tolist() for spheres in event.spheres] == [spheres.tolist() for spheres in alone.spheres]
            assert event.aggregate is self.AGGREGATE
        assert len({event.initiation_rate for event in events}) == 5

    def test_only_as_far_as_asked(self):
        """A flow is taken when its event is."""
        taken = []

        def flows():
            for orientation in self.ORIENTATIONS:
                taken.append(len(taken))
                yield rc.simple_shear(1.0).rotated(orientation)
            yield SPIN

        events = rc.break_up_each(self.AGGREGATE, response_of(self.AGGREGATE), self.BONDS, flows())
        assert inspect.isgenerator(events)
        assert taken == []
        for count in range(1, 5):
            next(events)
            assert taken == list(range(count))
        with pytest.raises(ValueError, match=r"^flow: expected a strain rate that is not zero"):
            next(events)

    def test_no_flow_no_event(self):
        assert list(rc.break_up_each(self.AGGREGATE, response_of(self.AGGREGATE), self.BONDS, [])) == []

    @pytest.mark.parametrize(
        ("wrong", "error", "message"),
        [
            ({"rule": "all"}, ValueError, "^rule: expected 'weakest' or 'overloaded', got 'all'$"),
            (
                {"criterion": rc.Tension},
                TypeError,
                "^criterion: expected Criterion, got the class Tension; for instance",
            ),
            ({"criterion": rc.Tension | rc.Sliding}, TypeError, "^criterion: expected Criterion, got UnionType; for"),
            (
                {"criterion": rc.Rolling()},
                ValueError,
                "^bonds: expected a strength of some contact for failure by rolling",
            ),
            ({"up_to": -1}, ValueError, "^up_to: expected a positive number, got -1$"),
            (
                {"bonds": rc.Bonds(*STIFFNESS, tensile_strength=[1.0, 2.0])},
                ValueError,
                r"^bonds.tensile_strength: expected one value or one per contact \(\d+\), got 2$",
            ),
            (
                {"bonds": rc.Bonds(1.0, [0.8, 0.8], 6e-3, 8e-3, 1.0)},
                ValueError,
                r"^bonds.tangential: expected one value or one per contact \(\d+\), got 2$",
            ),
            (
                {"response": response_of(random_packed_ball(20, seed=6))},
                rc.GeometryError,
                r"^the response was solved for other spheres \(20\) than those of the aggregate \(20\)",
            ),
        ],
    )
    def test_refused_before_the_first_event(self, wrong, error, message):
        given = {"aggregate": self.AGGREGATE, "response": response_of(self.AGGREGATE), "bonds": self.BONDS}
        with pytest.raises(error, match=message):
            rc.break_up_each(flows=[SPIN], **(given | wrong))
        with pytest.raises(error, match=message):
            rc.break_up(flow=ALONG_X, **(given | wrong))


class TestRefusals:
    def test_flow_without_strain(self):
        with pytest.raises(
            ValueError, match=r"^flow: expected a strain rate that is not zero, got none; a rotation loads"
        ):
            broken(straight_chain(3), SPIN)
        with pytest.raises(ValueError, match=r"^flow: expected a strain rate that is not zero"):
            broken(straight_chain(3), rc.simple_shear(0.0))

    def test_bonds_without_strength(self):
        message = (
            "^bonds: expected a strength of some contact for failure by tension or .*, got none; give for instance"
        )
        with pytest.raises(ValueError, match=message):
            broken(straight_chain(3), ALONG_X, tensile_strength=np.inf)
        with pytest.raises(ValueError, match=r"for failure by sliding, got none; give for instance shear_strength$"):
            broken(straight_chain(3), ALONG_X, criterion=rc.Sliding(0.1), tensile_strength=1.0)

    @pytest.mark.parametrize("value", [0.0, -2.0])
    def test_strengths_that_are_not_positive(self, value):
        with pytest.raises(ValueError, match=rf"^tensile_strength: expected a positive number, got {value:g}$"):
            broken(straight_chain(3), ALONG_X, tensile_strength=value)
        with pytest.raises(ValueError, match=rf"^shear_strength\[1\]: expected a positive number, got {value:g}$"):
            broken(straight_chain(3), ALONG_X, shear_strength=[1.0, value])

    def test_a_single_sphere(self):
        with pytest.raises(
            ValueError, match=r"^the aggregate is a single sphere and has no contact; expected at least two"
        ):
            broken(touching([[0.0, 0, 0]]), ALONG_X)

    def test_what_is_already_in_parts(self):
        with pytest.raises(rc.GeometryError, match=r"^the aggregate is in 2 parts, expected one"):
            broken(touching([[0.0, 0, 0], [2, 0, 0], [9, 0, 0]]), ALONG_X)


def test_some_contacts_without_a_limit_never_fail():
    """Whatever they carry."""
    strength = np.array([np.inf, np.inf, 5.0, np.inf, np.inf])
    breakup = broken(straight_chain(6), ALONG_X, tensile_strength=strength)
    assert [failure.contact for failure in breakup.failures] == [2]
    strength[2] = np.inf
    strength[0] = 1e30
    assert broken(straight_chain(6), ALONG_X, tensile_strength=strength).failures[0].contact == 0


def test_one_very_weak_contact_does_not_hide_the_others():
    """It fails at once, and the rest breaks as if it had not been there."""
    aggregate = random_packed_ball(20, seed=1)
    strength = np.full(len(aggregate.pairs), 2.0)
    first = broken(aggregate, rc.uniaxial_extension(1.0)).failures[0].contact
    strength[first] = 2e-10
    breakup = broken(aggregate, rc.uniaxial_extension(1.0), tensile_strength=strength)
    assert breakup.failures[0].contact == first
    assert breakup.splits
    whole = broken(aggregate, rc.uniaxial_extension(1.0))
    assert [each.contact for each in breakup.failures] == [each.contact for each in whole.failures]
