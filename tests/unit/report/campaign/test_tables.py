"""The tables of a campaign, worked out again row by row."""

import json
from statistics import mean

import numpy as np
import pytest
from scipy.stats import chi2

from rheoclast.report.campaign.folder import read_campaign_result
from rheoclast.report.campaign.kinds import kinds
from rheoclast.report.campaign.tables import campaign_tables

pq = pytest.importorskip("pyarrow.parquet")


def shown(folder):
    result = read_campaign_result(folder)
    return campaign_tables(result, kinds(result))


def with_events(folder, met):
    """Rows of the tables, of every kind with its events."""
    result = read_campaign_result(folder)
    found = kinds(result)
    events = pq.read_table(folder / "events.parquet").to_pylist()
    tables = campaign_tables(result, found)
    for k, kind in enumerate(found):
        own = [
            row
            for row in events
            if (row["family"], json.loads(row["parameters"]), row["material"], row[met])
            == (kind.family, kind.parameters, kind.material, kind.met)
        ]
        cells = {name: values[k] for table in ("rates", "course") for name, values in tables[table]["rows"].items()}
        yield cells, own


def middle(values):
    """The lower median; infinite ones count."""
    return sorted(values)[(len(values) - 1) // 2]


def same(cell, value):
    return cell is None if value is None or np.isinf(value) else cell == pytest.approx(value, rel=1e-4, abs=1e-9)


def test_every_column_has_a_row_per_kind(surveyed):
    number = len(kinds(read_campaign_result(surveyed)))
    tables = shown(surveyed)
    for name in ("rates", "course"):
        keys = [column["key"] for column in tables[name]["columns"]]
        assert len(set(keys)) == len(keys)
        assert [len(tables[name]["rows"][key]) for key in keys] == [number] * len(keys)
    json.dumps(tables, allow_nan=False)


@pytest.mark.parametrize(("name", "event"), [("first_failures", 7), ("breakups", 2)])
def test_rates_in_flows(name, event, request):
    for cells, own in with_events(request.getfixturevalue(name), "flow"):
        rates = sorted(row["initiation_rate_per_s"] for row in own)
        assert cells["events"] == len(own) == event * cells["aggregates"]
        assert same(cells["initiation_rate_per_s_0.5"], middle(rates))
        below = sum(rate <= (cells["initiation_rate_per_s_0.25"] or np.inf) * (1 + 1e-4) for rate in rates)
        assert below / len(rates) >= 0.25
        assert cells["asked_fractal_dimension"] == json.loads(own[0]["parameters"]).get("fractal_dimension")


def test_what_fails_first(first_failures):
    for cells, own in with_events(first_failures, "flow"):
        failed = [row for row in own if row["contact"] is not None]
        assert failed
        assert sum(cells[key] or 0 for key in cells if key.startswith("by_")) == pytest.approx(100, abs=0.01)
        assert same(cells["position"], middle([row["radial_position"] for row in failed]))
        assert same(cells["margin"], middle([row["margin"] for row in failed]))


def test_how_they_break(breakups):
    outcomes = set()
    for cells, own in with_events(breakups, "flow"):
        for outcome in ("whole", "bond", "crack"):
            assert same(cells[outcome], 100 * mean(row["outcome"] == outcome for row in own))
            outcomes |= {outcome} if cells[outcome] else set()
        assert same(cells["breakup_rate_per_s_0.5"], middle([row["breakup_rate_per_s"] for row in own]))
        assert same(cells["surface"], mean(row["surface"] for row in own))
        assert same(cells["pieces"], mean(len(row["fragments"]) for row in own))
        smaller = [1 - max(row["fragments"]) / sum(row["fragments"]) for row in own]
        assert same(cells["smaller_share"], middle(smaller))
    assert outcomes == {"whole", "bond", "crack"}


def test_rates_of_breakage(in_turbulence):
    """Failures over the time without those that are overloaded from the start, and the interval of a Poisson count."""
    found = set()
    for cells, own in with_events(in_turbulence, "dissipation_m2_per_s3"):
        time = sum(row["time_s"] for row in own if not row["overloaded"])
        failures = sum(row["failed"] and not row["overloaded"] for row in own)
        assert cells["overloaded"] == sum(row["overloaded"] for row in own)
        assert cells["failures"] == failures
        assert same(cells["rate"], failures / time if time else None)
        assert same(cells["high"], chi2.ppf(0.975, 2 * failures + 2) / (2 * time) if time else None)
        assert same(cells["low"], chi2.ppf(0.025, 2 * failures) / (2 * time) if failures else 0.0 if time else None)
        assert same(cells["ratio"], middle([row["largest_load_ratio"] for row in own]))
        found |= {failures > 0, cells["overloaded"] > 0}
    assert found == {False, True}


def test_what_came_to_nothing(first_failures, in_turbulence):
    rows = shown(first_failures)["reasons"]["rows"]
    assert sum(rows["number"]) == 2 * 2 * 3 * 2
    assert rows["parameters"][0] == "count 12, fractal dimension 1.8, prefactor 6"
    assert "reasons" not in shown(in_turbulence)
