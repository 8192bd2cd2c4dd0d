"""The validation scripts run, reduced to what takes seconds, and find what their texts say."""

import importlib
from pathlib import Path

import numpy as np
import pytest

VALIDATION = Path(__file__).parents[2] / "validation"


@pytest.fixture
def load(monkeypatch):
    """Import a script from its folder, as running it there does."""

    def load(folder, name):
        monkeypatch.syspath_prepend(VALIDATION / folder)
        return importlib.import_module(name)

    return load


def test_error_against_size(load):
    script = load("truncation_error", "error_against_size")
    clusters = script.clusters
    families = {
        "tree": {8: [clusters.tree(8, k) for k in range(3)]},
        "chain": {6: [clusters.chain(6)]},
        "compact": {8: [clusters.dense(8, 0)]},
    }
    rows = script.all_errors(families)
    tension = {(row["family"], row["model"]): row["tension"] for row in rows}
    for family in families:
        for coarse, fine in (("order 1", "order 2"), ("order 2", "order 3"), ("order 3", "order 4")):
            assert tension[family, fine] < tension[family, coarse]
        assert tension[family, "free draining"] > tension[family, "order 2"]
    assert tension["compact", "order 2"] > 0.05
    assert len(script.draw(rows).axes) == 15


def test_calibration(load):
    script = load("truncation_error", "calibration")
    clusters = {name: each for name, each in script.calibration_clusters().items() if len(each) in (3, 4, 8)}
    assert len(clusters) >= 10
    rows = [row for name, each in clusters.items() for row in script.judged(name, each)]
    for order in script.ORDERS:
        ratio = np.array([row["true"] / row["expected"] for row in rows if row["order"] == order])
        assert (ratio < 2).mean() >= 0.95
        assert ((ratio > 0.2) & (ratio < 5)).mean() > 0.5
    assert len(script.summary(rows)) == 16
    assert len(script.draw(rows).axes) == 4


def test_convergence(load):
    script = load("convergence", "convergence")
    values, exact = script.values_by_order(), script.exact_values()
    for name in ("axial drag", "transverse drag", "axial rotation"):
        errors = {p: value[name] / exact[name] - 1 for p, value in values.items()}
        assert all(error < 0 for error in errors.values())
        assert 5 < script.exponent(errors) < 9
    assert len({np.sign(value["tension"] - exact["tension"]) for value in values.values()}) == 2


def test_fractal_dimensions(load):
    """Reduced: few seeds and up to 800 spheres, so the bounds are twice those of the whole."""
    script = load("fractal_dimensions", "fractal_dimensions")
    ensembles = {
        name: script.ensemble(family, (30, 150, 800), 12)
        for name, (family, _) in script.FAMILIES.items()
        if "particle" not in name
    }
    for row in script.rows(ensembles):
        published = script.FAMILIES[row["family"]][1]
        assert abs(row["dimension"] - published.dimension) < 2 * published.tolerance, row["family"]
    assert len(script.draw(ensembles).axes) == 1


def test_breakup_modes(load, tmp_path, monkeypatch):
    """Reduced: forty spheres, two clusters and three orientations of each family but one."""
    script, figures = load("breakup_modes", "events"), load("breakup_modes", "breakup_modes")
    rows = [
        {"variant": "all", **{name: str(value) for name, value in row.items()}}
        for family in script.FAMILIES
        if family != "thinned fcc"  # forty spheres have fewer contacts
        for seed in range(2)
        for row in script.events(family, seed, script.VARIANTS["standard"], 3, False, 40)
    ]
    table = {(row["family"], row["flow"]): row for row in figures.modes(rows)}
    for flow in script.FLOWS:
        assert table["open tree", flow]["single_bond"] == table["dense tree", flow]["single_bond"] == 1
        assert table["packed ball", flow]["single_bond"] < 0.2
        assert table["packed ball", flow]["failures"] > 5
        assert table["packed ball", flow]["first_radial"] > table["dense tree", flow]["first_radial"]
        assert table["packed ball", flow]["surface"] > 3 * table["compacted 3 %", flow]["surface"]
    assert len(figures.draw(list(table.values()), "coordination", "").axes) == 6
    monkeypatch.setattr(script, "RESULTS", tmp_path)
    monkeypatch.setattr(script, "SPHERES", 12)
    first, second = script.waiting()[:2]
    script.Task(first.family, first.seed, first.variant).run()
    assert second in script.waiting()
    assert first not in script.waiting()
    assert [path.suffix for path in tmp_path.iterdir()] == [".csv"]
