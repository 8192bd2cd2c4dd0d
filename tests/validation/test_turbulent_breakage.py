"""The comparison with breakage in turbulence runs, reduced to seconds, and finds what its text says."""

import importlib
from pathlib import Path

import numpy as np
import pytest

import rheoclast as rc

FOLDER = Path(__file__).parents[2] / "validation" / "turbulent_breakage"
SIZES = {"doublet": (2,), "open tree": (16, 32, 64), "dense tree": (16, 32, 64), "unequal tree": (16, 32, 64)}

SEEDS, PATHS = 3, 5


@pytest.fixture(scope="module")
def scripts():
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(FOLDER)
        names = ("records", "ensembles", "findings", "figures", "turbulent_breakage")
        yield {name: importlib.import_module(name) for name in names}


@pytest.fixture(scope="module")
def found(scripts):
    """Few seeds on few paths."""
    return scripts["ensembles"].ensembles(scripts["records"].run(seed, SIZES, PATHS) for seed in range(SEEDS))


def blocks(records, seed):
    """What each block of the Gaussian paths of one seed does to an open tree of 16, with the tree."""
    body = records.Body.made("open tree", 16, seed)
    flows = rc.gaussian_histories(PATHS, records.SETTLING + records.BLOCKS * records.BLOCK, 1.0, 1.0, seed)
    for flow, start in zip(flows, rc.random_orientations(PATHS, seed), strict=True):
        whole = body.tension(flow, start)
        for begin in records.SETTLING + records.BLOCK * np.arange(records.BLOCKS):
            times = whole.times[(whole.times >= begin) & (whole.times < begin + records.BLOCK)]
            yield body, rc.load_history(whole.loads.trajectory, body.table, records.UNIT_BONDS, times=times)


def test_rate_and_fragments_are_those_of_first_failures(scripts, found):
    """Block by block along the same paths, with the library's own first failures."""
    ensemble = next(each for each in found if (each.model, each.family, each.spheres) == ("gaussian", "open tree", 16))
    pairs = [pair for seed in range(SEEDS) for pair in blocks(scripts["records"], seed)]
    for rate in ensemble.rates[::4]:
        level = rate.dissipation**-0.5
        waiting = rc.first_failure_times((history for _, history in pairs), level=level)
        expected = rc.breakage_rate(waiting)
        assert rate.measured.events == expected.events
        assert rate.measured.rate == pytest.approx(expected.rate, rel=0.02)
        assert rate.overloaded == pytest.approx(waiting.overloaded / len(pairs))
        failures = [(body, history.first_failure(level), history.times[0]) for body, history in pairs]
        shares = [body.smaller[each.contact] / 16 for body, each, start in failures if each and each.time > start]
        # Where two contacts change places between a failure and the next sample, the records name the later one.
        assert np.mean(ensemble.smaller_shares(rate.dissipation)[0] != shares) < 0.1


def test_one_path_serves_every_dissipation(scripts):
    """Four times the dissipation: the same motion in half the time, with twice the tension."""
    body = scripts["records"].Body.made("open tree", 16, 1)
    slow, fast = (
        body.tension(rc.gaussian_histories(1, 200 / dissipation**0.5, dissipation, 1.0, seed=5)[0], np.eye(3))
        for dissipation in (1.0, 4.0)
    )
    np.testing.assert_allclose(2 * fast.times, slow.times, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(fast.largest, 2 * slow.largest, rtol=1e-5)


@pytest.mark.parametrize("family", ["open tree", "unequal tree"])
def test_smaller_parts_are_those_of_a_breakup(scripts, family):
    records = scripts["records"]
    body = records.Body.made(family, 40, 3)
    assert len(body.aggregate.pairs) == 39
    for flow in (rc.simple_shear(1.0), rc.uniaxial_extension(1.0)):
        breakup = rc.break_up(body.aggregate, body.response, records.UNIT_BONDS, flow)
        assert min(map(len, breakup.spheres)) == body.smaller[breakup.failures[0].contact]


def test_resampled_mean_has_the_scatter_of_the_seeds(scripts):
    random = np.random.default_rng(4)
    seed, value = np.repeat(np.arange(25), 40), np.repeat(random.standard_normal(25), 40)
    total, count = scripts["ensembles"].resampled(seed, value, np.ones(1000))
    assert np.std(total / count) == pytest.approx(np.std(value[::40]) / 5, rel=0.1)


@pytest.mark.parametrize("exponent", [1, 2, 5])
def test_exponent_of_smaller_fragments(scripts, exponent):
    """Drawn from the law itself, by inverting its cumulative distribution."""
    erosive, random = scripts["findings"].EROSIVE, np.random.default_rng(1)
    low, high = erosive**exponent, 0.5**exponent
    share = (low + random.random(4000) * (high - low)) ** (1 / exponent)
    estimate, (below, above) = scripts["findings"]._exponent(share, np.arange(4000) % 50)
    assert below < exponent < above
    assert estimate == pytest.approx(exponent, rel=0.1)


def test_rates_and_lengths(scripts, found):
    findings, local_exponents = scripts["findings"], scripts["ensembles"].local_exponents
    fastest = {}
    for ensemble in found:
        rates = ensemble.rates
        exponents = local_exponents(rates)
        assert exponents[:3].mean() > 2  # steep where breakage is rare
        fastest.setdefault(ensemble.family, []).append(exponents[-4:].mean())
    assert 0.3 < np.mean(fastest["doublet"]) < 0.7  # as often as they turn: f ~ (ε/ν)^½
    assert min(np.mean(fastest[family]) for family in fastest if family != "doublet") > 0.9
    lengths = {(row["family"], row["length"]): row for row in findings.length_rows(found)}
    for family in ("open tree", "dense tree"):
        assert 1.8 < lengths[family, "gyration"]["tension_exponent"] < 2.3
        assert lengths[family, "gyration"]["tension_misfit"] < 0.15
    best = lengths["all", "hydrodynamic"]
    assert best["critical_dissipation_exponent"] == pytest.approx(-2 * best["tension_exponent"], abs=0.5)
    assert best["tension_misfit"] < lengths["all", "gyration"]["tension_misfit"]


def test_fragments_kernel_and_figures(scripts, found, monkeypatch, tmp_path):
    findings = scripts["findings"]
    monkeypatch.setattr(findings, "LARGE", (64,))
    monkeypatch.setattr(findings, "RATES_OF_FRAGMENTS", (0.1, 0.5))
    monkeypatch.setattr(scripts["figures"], "RATES_OF_FRAGMENTS", (0.1, 0.5))
    rows = {(row["family"], row["rate"]): row for row in findings.fragment_rows(found)}
    for family in ("open tree", "dense tree", "unequal tree"):
        assert 0.5 > rows[family, 0.1]["smaller"] > rows[family, 0.5]["smaller"] > 0.25
        assert rows[family, 0.5]["erosive"] < 0.05
    rc.write_kernel(tmp_path / "kernel.csv", findings.kernel(found))
    assert (tmp_path / "kernel.csv").read_text().startswith("# spheres: ")
    for draw, panels in (("draw_rates", 4), ("draw_lengths", 4), ("draw_fragments", 6)):
        assert len(getattr(scripts["figures"], draw)(found).axes) == panels
