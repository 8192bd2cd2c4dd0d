"""Events fall into kinds, and nothing is lost."""

import json
from collections import defaultdict
from statistics import median_low

import numpy as np
import pytest

from rheoclast.report.campaign.folder import read_campaign_result
from rheoclast.report.campaign.kinds import differing, kinds, parameter, quantiles, series, told_parameters

pq = pytest.importorskip("pyarrow.parquet")

MET = {"first failure": "flow", "breakup": "flow", "history": "dissipation_m2_per_s3"}


def of_kind(row):
    return row["family"], json.loads(row["parameters"]), row["material"]


def named(kind):
    return kind.family, kind.parameters, kind.material


def test_every_event_is_in_the_kind_it_belongs_to(surveyed):
    result = read_campaign_result(surveyed)
    met = MET[result.event]
    rows = pq.read_table(surveyed / "events.parquet").to_pylist()
    found = kinds(result)
    for kind in found:
        own = [row for row in rows if (*of_kind(row), row[met]) == (*named(kind), kind.met)]
        assert len(kind.events["aggregate"]) == len(own) > 0
    assert sum(len(kind.events["aggregate"]) for kind in found) == len(rows)


def test_aggregates_of_a_kind(surveyed):
    """What is known of every aggregate comes from its own row, once for each."""
    rows = pq.read_table(surveyed / "aggregates.parquet").to_pylist()
    for kind in kinds(read_campaign_result(surveyed)):
        own = [row for row in rows if of_kind(row) == named(kind)]
        assert kind.number == len(own)
        for name in ("spheres", "mean_coordination", "radius_of_gyration_m"):
            assert sorted(kind.each(name)) == sorted(row[name] for row in own)


@pytest.mark.parametrize("name", ["first_failures", "breakups"])
def test_medians_of_aggregates(name, request):
    """Over an odd number of orientations, and over two."""
    folder = request.getfixturevalue(name)
    rows = pq.read_table(folder / "events.parquet").to_pylist()
    for kind in kinds(read_campaign_result(folder)):
        own = defaultdict(list)
        for row in rows:
            if (*of_kind(row), row["flow"]) == (*named(kind), kind.met):
                own[row["task"]].append(row["initiation_rate_per_s"])
        assert sorted(kind.medians("initiation_rate_per_s")) == sorted(map(median_low, own.values()))


def test_fragments(breakups):
    shares = {}
    for row in pq.read_table(breakups / "events.parquet").to_pylist():
        shares[len(row["fragments"]), 1 - max(row["fragments"]) / sum(row["fragments"])] = None
    found = kinds(read_campaign_result(breakups))
    for pieces, share in {
        (p, s) for k in found for p, s in zip(k.events["pieces"], k.events["smaller_share"], strict=True)
    }:
        assert any(pieces == number and share == pytest.approx(other, abs=1e-12) for number, other in shares)


def test_series_join_sizes_and_part_parameters(first_failures):
    found = kinds(read_campaign_result(first_failures))
    assert differing(found) == ("fractal_dimension", "counts")
    assert list(series(found)) == [
        "cluster-cluster, fractal dimension 1.8",
        "cluster-cluster, fractal dimension 2.9",
        "straight-chain",
        "lattice-block, counts 2 × 2 × 2",
        "lattice-block, counts 3 × 2 × 2",
    ]
    assert sum(map(len, series(found).values())) == len(found)


def test_too_many_series_are_joined_by_family(first_failures, monkeypatch):
    monkeypatch.setattr("rheoclast.report.campaign.kinds.MOST_SERIES", 4)
    found = kinds(read_campaign_result(first_failures))
    assert list(series(found)) == ["cluster-cluster", "straight-chain", "lattice-block"]
    assert sum(map(len, series(found).values())) == len(found)


def test_quantiles_of_what_never_fails():
    assert quantiles(np.array([1.0, np.inf, 2.0, np.inf]), (0.25, 0.5, 0.75)).tolist() == [1, 2, np.inf]
    assert np.isnan(quantiles(np.empty(0), (0.5,))).all()


def test_parameters_in_words():
    assert parameter([3, 2, 2]) == "3 × 2 × 2"
    assert parameter(1.8) == "1.8"
    assert told_parameters({"count": 12, "fractal_dimension": 1.8, "radius": 1e-6}) == "count 12, fractal dimension 1.8"
