"""What the charts of a campaign draw is what happened."""

import json

import numpy as np
import pytest

from rheoclast.report.campaign.charts import MOST_POINTS, campaign_charts
from rheoclast.report.campaign.folder import read_campaign_result
from rheoclast.report.campaign.kinds import Kind, kinds

pq = pytest.importorskip("pyarrow.parquet")


def charts(folder):
    result = read_campaign_result(folder)
    return campaign_charts(kinds(result), result.event)


def by_condition(folder, met):
    """Events of every condition, in the order of the charts."""
    rows = pq.read_table(folder / "events.parquet").to_pylist()
    found = {}
    for row in rows:
        found.setdefault((row["material"], row[met]), []).append(row)
    return found


MET = {"first_failures": "flow", "breakups": "flow", "in_turbulence": "dissipation_m2_per_s3"}
COLUMNS = {
    "Rates of the first failure": "initiation_rate_per_s",
    "Rates of breakup": "breakup_rate_per_s",
    "Where the first contact fails": "radial_position",
    "Largest loads of the histories": "largest_load_ratio",
    "Sizes of fragments": "smaller_share",
}


def share_outside(row):
    return row.get(
        "smaller_share", None if row["fragments"] is None else 1 - max(row["fragments"]) / sum(row["fragments"])
    )


@pytest.mark.parametrize("name", MET)
def test_distributions_hold_every_event_that_has_a_value(name, request):
    folder = request.getfixturevalue(name)
    drawn = charts(folder)
    for chart in drawn["charts"][1:]:
        column = COLUMNS[chart["title"]]
        for view, own in zip(chart["views"], by_condition(folder, MET[name]).values(), strict=True):
            values = [share_outside(row) if column == "smaller_share" else row[column] for row in own]
            known = [value for value in values if value is not None and np.isfinite(value)]
            if not known:
                assert view["edges"] == []
                continue
            assert view["edges"][0] <= min(known) * (1 + 1e-4) + 1e-9
            assert view["edges"][-1] >= max(known) * (1 - 1e-4)
            families = [label.split(",")[0] for label in drawn["series"]]
            for family in dict.fromkeys(families):
                of_family = [row for row in own if row["family"] == family]
                if families.count(family) > 1 or not of_family:
                    continue
                own_values = [share_outside(row) if column == "smaller_share" else row[column] for row in of_family]
                finite = [value for value in own_values if value is not None and np.isfinite(value)]
                assert sum(view["shares"][families.index(family)]) == pytest.approx(
                    len(finite) / len(of_family), rel=1e-3
                )
            assert bool(view["note"]) == (len(known) < len(values))


def test_points_are_the_aggregates(first_failures):
    """Radii in the unit of the axis, rates between those of the first and the last orientation."""
    drawn = charts(first_failures)
    chart = drawn["charts"][0]
    assert chart["x"]["label"].endswith("(µm)")
    rows = pq.read_table(first_failures / "aggregates.parquet").to_pylist()
    made = [row["radius_of_gyration_m"] for row in rows if row["failure"] is None and row["material"] == "weak"]
    for view, own in zip(chart["views"], by_condition(first_failures, "flow").values(), strict=True):
        radii = [x for points in view["points"] for x in points["x"]]
        np.testing.assert_allclose(sorted(radii), 1e6 * np.sort(made), rtol=1e-4)
        rates = [row["initiation_rate_per_s"] for row in own]
        assert all(min(rates) * 0.999 <= y <= max(rates) * 1.001 for points in view["points"] for y in points["y"])
        for middle in (each for kind in view["medians"] for each in kind):
            low, rate, high = (np.inf if middle[key] is None else middle[key] for key in ("low", "y", "high"))
            assert low <= rate <= high


def test_rates_of_breakage_against_dissipation(in_turbulence):
    """All dissipations in every view; what is zero is left out, as no logarithmic axis has it."""
    for view in charts(in_turbulence)["charts"][0]["views"]:
        for kind in view["medians"]:
            assert [each["x"] for each in kind] == [1e-3, 3, 30]
            assert kind[0]["y"] is None
            assert kind[0]["low"] is None
            assert kind[0]["high"] > 0


def many(number, orientations):
    """One kind of many aggregates."""
    random = np.random.default_rng(1)
    count = number * orientations
    events = {
        "aggregate": np.repeat(np.arange(number), orientations),
        "spheres": np.full(count, 50.0),
        "mean_coordination": np.full(count, 2.0),
        "radius_of_gyration_m": np.repeat(random.uniform(1e-6, 2e-6, number), orientations),
        "initiation_rate_per_s": random.lognormal(10, 1, count),
        "radial_position": random.uniform(0, 1.5, count),
    }
    return Kind("cluster-cluster", {"count": 50}, "weak", "shear", events)


def test_no_more_points_than_fit(first_failures):
    """Of a hundred thousand aggregates a few thousand are drawn, and the page says so."""
    drawn = campaign_charts([many(20_000, 5)], "first failure")
    view = drawn["charts"][0]["views"][0]
    number = len(view["points"][0]["x"])
    assert 0.5 * MOST_POINTS < number <= MOST_POINTS
    assert view["note"].endswith(f"{number} of 20000 aggregates are drawn")
    assert len(json.dumps(drawn)) < 1e5
    assert "are drawn" not in charts(first_failures)["charts"][0]["views"][0]["note"]


def test_nothing_to_draw():
    assert campaign_charts([], "breakup")["charts"] == []


def test_a_single_value_has_a_range():
    kind = many(1, 1)
    for chart in campaign_charts([kind], "first failure")["charts"][1:]:
        edges = chart["views"][0]["edges"]
        assert edges[0] < edges[-1]
        assert sum(chart["views"][0]["shares"][0]) == pytest.approx(1, rel=1e-3)
