"""The largest load in the course of time: a doublet in closed form, samples by hand, and what is refused."""

import json
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.breakup import load_history as module
from rheoclast.breakup import ratio_response, trajectory_loads
from rheoclast.breakup.load_history import Exceedances, LargestLoad, LoadHistory, load_history
from rheoclast.generation import cluster_cluster, straight_chain

REFERENCE = json.loads((Path(__file__).parents[2] / "published" / "reference" / "doublet.json").read_text())
SHEAR_RATE = 3.0
ALONG_GRADIENT = np.array([[0, -1.0, 0], [1, 0, 0], [0, 0, 1]])  # turns the doublet's axis from x to y


def setting(aggregate, **strength):
    response = rc.rigid_response(aggregate.spheres, rc.StokesianDynamics(), viscosity=1.0)
    bonds = rc.Bonds(1.0, 0.8, 6e-3, 8e-3, **(strength or {"tensile_strength": 2.0}))
    return response, rc.contact_response(aggregate, response, bonds), bonds


class Orbit:
    """A doublet in the plane of shear: tan φ = r tan(G t/(r + 1/r)) from the gradient, tension ∝ sin 2φ (Jeffery)."""

    RATIO = REFERENCE["order_2"]["r_e"]
    FREQUENCY = SHEAR_RATE / (RATIO + 1 / RATIO)
    HALF_TURN = np.pi / FREQUENCY

    def __init__(self):
        shear = rc.simple_shear(SHEAR_RATE)
        response, self.table, self.bonds = setting(straight_chain(2))
        self.trajectory = rc.trajectory(response, shear, 3 * self.HALF_TURN, ALONG_GRADIENT, tolerance=1e-12)
        self.amplitude = self.table.worst_tension(shear)[0] / 2.0

    def ratio(self, times):
        tangent = self.RATIO * np.tan(self.FREQUENCY * times)
        return self.amplitude * 2 * tangent / (1 + tangent**2)

    def time(self, share, falling=False):
        """When the ratio is a share of the largest, going up or down, for the first time."""
        tangent = (1 + (1 if falling else -1) * np.sqrt(1 - share**2)) / share
        return np.arctan(tangent / self.RATIO) / self.FREQUENCY


@pytest.fixture(scope="module")
def orbit():
    return Orbit()


@pytest.fixture(scope="module")
def history(orbit):
    return load_history(orbit.trajectory, orbit.table, orbit.bonds)


class TestDoublet:
    def test_load_ratio(self, orbit, history):
        np.testing.assert_allclose(history.largest, orbit.ratio(history.times), atol=2e-7 * orbit.amplitude)
        assert history.duration == pytest.approx(3 * orbit.HALF_TURN)
        assert not history.contact.any()

    @pytest.mark.parametrize("share", [0.05, 0.5, 0.9, 0.999])
    def test_first_failure(self, orbit, history, share):
        failure = history.first_failure(share * orbit.amplitude)
        assert failure.time == pytest.approx(orbit.time(share), abs=3e-7 * orbit.HALF_TURN / np.sqrt(1 - share**2))
        assert (failure.contact, failure.criterion) == (0, "tension")
        at_failure = rc.load_ratios(orbit.table.loads(orbit.trajectory.flow(failure.time)), orbit.bonds)
        assert at_failure.max() == pytest.approx(share * orbit.amplitude, rel=1e-10)

    def test_does_not_fail_below_its_largest_load(self, orbit, history):
        assert history.first_failure(1.0001 * orbit.amplitude) is None
        assert history.first_failure(0.9999 * history.maximum.ratio) is not None

    def test_maximum(self, orbit, history):
        assert history.maximum.ratio == pytest.approx(orbit.amplitude, rel=1e-9)
        since = (history.maximum.time - orbit.time(1.0)) / orbit.HALF_TURN
        assert since == pytest.approx(round(since), abs=1e-5)
        assert history.maximum.ratio == history.largest.max()

    @pytest.mark.parametrize("share", [0.1, 0.7])
    def test_exceedances(self, orbit, history, share):
        """Once every half turn, from the time it goes up to the time it goes down."""
        above = history.exceedances(share * orbit.amplitude)
        assert above.count == 3
        expected = 3 * (orbit.time(share, falling=True) - orbit.time(share))
        assert above.duration == pytest.approx(expected, rel=2e-3)

    def test_peaks_are_half_a_turn_apart(self, orbit, history):
        times = history.times[history.peaks(0.5 * orbit.amplitude)]
        spacing = np.diff(history.times).max()
        np.testing.assert_allclose(times, orbit.time(1.0) + orbit.HALF_TURN * np.arange(3), atol=spacing)

    def test_compressed_doublet_has_a_negative_ratio(self, orbit, history):
        assert history.largest.min() == pytest.approx(-orbit.amplitude, rel=1e-3)


class Interpolated:
    """Loads with straight lines between samples."""

    criteria = ("tension",)

    def __init__(self, times, largest):
        self.samples = times, largest

    def largest_at(self, time):
        return float(np.interp(time, *self.samples))

    def largest(self, times):
        return np.interp(times, *self.samples), np.zeros(len(times), int), np.zeros(len(times), int)


def sampled(times, largest):
    times, largest = np.array(times, float), np.array(largest, float)
    zeros = np.zeros(len(times), int)
    return LoadHistory(times, largest, zeros, zeros, Interpolated(times, largest))


class TestSamples:
    HISTORY = sampled([0, 1, 3, 4, 6, 7, 8], [2, 0, 4, 6, 0, 0, 3])

    def test_exceedances_by_hand(self):
        """Above 1: ½ s, then from 1½ to 5⅔, then the last ⅔ s; the start above it is no crossing."""
        assert self.HISTORY.exceedances(1.0) == Exceedances(2, pytest.approx(0.5 + (5 + 2 / 3 - 1.5) + 2 / 3))
        assert self.HISTORY.exceedances(-1.0) == Exceedances(0, 8.0)
        assert self.HISTORY.exceedances(7.0) == Exceedances(0, 0.0)

    def test_touching_counts_as_reaching(self):
        assert self.HISTORY.exceedances(6.0) == Exceedances(1, 0.0)
        assert self.HISTORY.first_failure(6.0).time == 4.0

    def test_peaks_by_hand(self):
        assert self.HISTORY.peaks(1.0).tolist() == [0, 3, 6]
        assert self.HISTORY.peaks(5.0).tolist() == [3]
        assert self.HISTORY.peaks(7.0).tolist() == []

    def test_first_failure_by_hand(self):
        assert self.HISTORY.first_failure().time == 0.0
        assert self.HISTORY.first_failure(3.0).time == pytest.approx(2.5, rel=1e-11)
        assert self.HISTORY.first_failure(10.0) is None

    def test_maximum_is_that_of_the_samples(self):
        assert self.HISTORY.maximum == LargestLoad(4.0, 6.0, 0, "tension")

    def test_maximum_at_an_end(self):
        assert sampled([1, 2, 4], [1, 2, 5]).maximum.time == 4.0
        assert sampled([1, 2, 4], [5, 2, 1]).maximum.time == 1.0


STRENGTHS = {"tensile_strength": np.linspace(1, 2, 29), "shear_strength": 1.5, "twisting_strength": 0.8}


@pytest.fixture(scope="module")
def case():
    """In turbulence, where the load bends at every sample of the gradient."""
    response, table, bonds = setting(cluster_cluster(30, seed=4), **STRENGTHS)
    flow = rc.recent_deformation_histories(1, 8.0, 1.0, 1.0, seed=3)[0]
    return rc.trajectory(response, flow), table, bonds


@pytest.fixture(scope="module")
def smooth():
    """In shear, where its peaks lie between the samples."""
    response, table, bonds = setting(cluster_cluster(30, seed=4), **STRENGTHS)
    return rc.trajectory(response, rc.simple_shear(2.0), duration=25.0), table, bonds


@pytest.fixture(scope="module")
def growing():
    """A doublet in a shear that grows so little that of two peaks the higher one may have the lower samples."""
    response, table, bonds = setting(straight_chain(2))
    shear = rc.simple_shear(SHEAR_RATE).gradient
    duration = 20 * Orbit.HALF_TURN
    flow = rc.GradientHistory([0.0, duration], [shear, (1 + 3e-4) * shear])
    return rc.trajectory(response, flow, start=ALONG_GRADIENT), table, bonds


class TestRoutes:
    def test_tension_alone_as_with_limits_never_reached(self, case):
        """The linear route against the general one, with a limit that only makes the general one be taken."""
        trajectory, table, bonds = case
        strong = rc.Bonds(1.0, 0.8, 6e-3, 8e-3, tensile_strength=bonds.tensile_strength, shear_strength=1e30)
        alone = load_history(trajectory, table, bonds, criterion=rc.Tension())
        among = load_history(trajectory, table, strong)
        tension = alone.largest > 1e-20
        assert tension.any()
        np.testing.assert_allclose(alone.largest[tension], among.largest[tension], rtol=1e-12)
        np.testing.assert_array_equal(alone.contact[tension], among.contact[tension])
        assert {among.criteria[k] for k in among.criterion[tension]} == {"tension"}

    def test_pieces_make_no_difference(self, case, monkeypatch):
        trajectory, table, bonds = case
        for criterion in (rc.Tension(), rc.EVERY_LIMIT, rc.Combined()):
            whole = load_history(trajectory, table, bonds, criterion=criterion)
            with monkeypatch.context() as patch:
                patch.setattr(trajectory_loads, "INSTANTS_AT_ONCE", 17)
                patch.setattr(ratio_response, "RATIOS_AT_ONCE", 5 * 29 + 3)
                patch.setattr(module, "INSTANTS_AT_ONCE", 17)
                pieces = load_history(trajectory, table, bonds, criterion=criterion)
            np.testing.assert_array_equal(whole.times, pieces.times)
            np.testing.assert_allclose(whole.largest, pieces.largest, rtol=1e-12)
            np.testing.assert_array_equal(whole.contact, pieces.contact)
            np.testing.assert_array_equal(whole.criterion, pieces.criterion)

    def test_criteria_without_a_limit_keep_their_position(self, case):
        """Rolling has no limit here: it never shows, and those behind it keep their names."""
        trajectory, table, bonds = case
        history = load_history(trajectory, table, bonds)
        assert history.criteria == ("tension", "sliding", "rolling", "twisting")
        assert set(np.unique(history.criterion)) <= {0, 1, 3}
        single = {
            name: load_history(trajectory, table, bonds, criterion=kind)
            for name, kind in (("tension", rc.Tension()), ("sliding", rc.Sliding()), ("twisting", rc.Twisting()))
        }
        every = np.stack([each.largest for each in single.values()])
        np.testing.assert_allclose(history.largest, every.max(axis=0), rtol=1e-12)
        assert [history.criteria[k] for k in history.criterion] == [list(single)[k] for k in every.argmax(axis=0)]

    @pytest.mark.parametrize(("path", "fewest"), [("case", 0), ("smooth", 3)])
    def test_default_times_resolve_the_flow(self, path, fewest, request):
        """The steps of the trajectory, each divided evenly; and nothing but tops of peaks higher than all before."""
        trajectory, table, bonds = request.getfixturevalue(path)
        history = load_history(trajectory, table, bonds)
        times, largest = history.times, history.largest
        sizes = np.linalg.norm(trajectory.gradient(trajectory.times), axis=(1, 2))
        evenly = [
            np.linspace(start, end, max(1, int(np.ceil(40 * (end - start) * max(sizes[k : k + 2])))) + 1)
            for k, (start, end) in enumerate(pairwise(trajectory.times))
        ]
        even = np.unique(np.round(np.concatenate(evenly), 12))
        added = np.flatnonzero(~np.isin(np.round(times, 12), even))
        assert len(times) == len(even) + len(added)
        assert fewest <= len(added) < 20
        for k in added:
            assert largest[k] > largest[:k].max()
            assert largest[k] > largest[k + 1]

    def test_given_times_are_the_samples(self, case):
        times = np.sort(np.random.default_rng(2).uniform(0, 8, 50))
        history = load_history(*case, times=times)
        np.testing.assert_array_equal(history.times, times)
        assert history.maximum.ratio == history.largest.max()

    def test_arrays_are_read_only(self, case):
        history = load_history(*case, times=[0.0, 1.0])
        for array in (history.times, history.largest, history.contact, history.criterion):
            with pytest.raises(ValueError, match="read-only"):
                array[0] = 0


def told(history, level):
    """Whether the level is reached, as every method has it."""
    starts_above = history.largest[0] >= level
    above = history.exceedances(level)
    return [
        history.first_failure(level) is not None,
        history.maximum.ratio >= level,
        len(history.peaks(level)) > 0,
        bool(starts_above or above.count > 0),
    ]


class TestOneStory:
    @pytest.mark.parametrize("times", [None, np.linspace(0, 8, 30)], ids=["default", "given"])
    def test_all_methods_agree_whether_a_level_is_reached(self, case, times):
        history = load_history(*case, times=times)
        second, first = np.sort(history.largest)[-2:]
        levels = [0.5 * first, 0.5 * (second + first), first, np.nextafter(first, 2 * first), 1.1 * first]
        assert [told(history, level) for level in levels] == [[True] * 4] * 3 + [[False] * 4] * 2

    @pytest.mark.parametrize("path", ["case", "smooth", "growing"])
    def test_no_instant_between_the_samples_reaches_a_level_before_the_first_failure(self, path, request):
        """Against 200 000 instants: the levels are their own records, so that none may be missed between samples."""
        trajectory, table, bonds = request.getfixturevalue(path)
        history = load_history(trajectory, table, bonds)
        dense = load_history(trajectory, table, bonds, times=np.linspace(0, trajectory.duration, 200_001))
        tops = np.flatnonzero(
            (np.diff(dense.largest) <= 0) & (dense.largest[:-1] == np.maximum.accumulate(dense.largest)[:-1])
        )
        assert len(tops) > 2
        for top in tops:
            level = dense.largest[top] * (1 - 1e-12)
            assert history.first_failure(level).time <= dense.times[top] * (1 + 1e-9)
        assert history.maximum.ratio >= dense.maximum.ratio * (1 - 1e-12)

    @pytest.mark.parametrize("seed", range(3))
    def test_fails_at_the_critical_rate_of_its_orbit(self, seed):
        """In a flow that is faster than that by rounding, and not in one that is slower."""
        aggregate = cluster_cluster(20, seed=seed)
        response, table, bonds = setting(aggregate, tensile_strength=1.0, shear_strength=1.0)
        first = rc.orbit_initiation(response, table, bonds, rc.simple_shear(1.0), duration=60.0)
        flow = rc.simple_shear(first.rate)
        history = load_history(rc.trajectory(response, flow, duration=60.0 / first.rate), table, bonds)
        assert history.first_failure(1 + 1e-9) is None
        failure = history.first_failure(1 - 1e-9)
        assert (failure.contact, failure.criterion) == (first.contact, first.criterion)
        assert failure.time == pytest.approx(first.time / first.rate, rel=1e-3)


class TestRefusal:
    @pytest.mark.parametrize("times", [[0.0], [0.0, 1.0, 1.0], [1.0, 0.0]])
    def test_times(self, orbit, times):
        with pytest.raises(ValueError, match="times: expected two or more increasing times; sort them"):
            load_history(orbit.trajectory, orbit.table, orbit.bonds, times=times)

    def test_times_outside(self, orbit):
        with pytest.raises(ValueError, match=r"times: expected 0 s to .* s, got 1000 s"):
            load_history(orbit.trajectory, orbit.table, orbit.bonds, times=[0.0, 1000.0])

    def test_no_strength(self, orbit):
        bonds = rc.Bonds(1.0, 0.8, 6e-3, 8e-3, shear_strength=1.0)
        with pytest.raises(ValueError, match="bonds: expected a strength of some contact for failure by tension"):
            load_history(orbit.trajectory, orbit.table, bonds, criterion=rc.Tension())

    def test_other_bonds(self, orbit):
        bonds = rc.Bonds(1.0, 0.8, 6e-3, 8e-3, tensile_strength=[1.0, 2.0])
        with pytest.raises(ValueError, match=r"expected one value or one per contact \(1\), got 2"):
            load_history(orbit.trajectory, orbit.table, bonds)

    def test_types(self, orbit):
        with pytest.raises(TypeError, match=r"trajectory: expected Trajectory, got LinearFlow; make one with"):
            load_history(rc.simple_shear(1.0), orbit.table, orbit.bonds)
        with pytest.raises(TypeError, match=r"criterion: expected Criterion, got the class Tension"):
            load_history(orbit.trajectory, orbit.table, orbit.bonds, criterion=rc.Tension)

    def test_too_many_samples(self, orbit, monkeypatch):
        monkeypatch.setattr(module, "MOST_SAMPLES", 10)
        with pytest.raises(ValueError, match=r"times: expected at most 10 by default, got .*; pass fewer times"):
            load_history(orbit.trajectory, orbit.table, orbit.bonds)

    def test_levels(self, history):
        with pytest.raises(ValueError, match="level: expected a positive number, got 0"):
            history.first_failure(0.0)
        with pytest.raises(ValueError, match="level: expected a finite number, got nan"):
            history.exceedances(np.nan)
        with pytest.raises(ValueError, match="level: expected a finite number, got inf"):
            history.peaks(np.inf)


def test_a_steady_load_has_no_peaks_between_the_samples():
    """A ball in uniaxial extension does not turn: its load varies by rounding, which is not sampled more finely."""
    ball = rc.generation.lattice_ball("fcc", 13)
    response = rc.rigid_response(ball.spheres, rc.FreeDraining(), 1.0)
    path = rc.trajectory(response, rc.uniaxial_extension(1.0), 50.0)
    bonds = rc.Bonds(1.0, 0.8, 0.01, 0.01, tensile_strength=1.0, shear_strength=1.0)
    history = rc.load_history(path, rc.contact_response(ball, response, bonds), bonds)
    assert np.ptp(history.largest) < 1e-9 * history.largest.max()
    spacing = np.diff(history.times)
    assert (spacing < 0.1 * np.median(spacing)).sum() < 5
