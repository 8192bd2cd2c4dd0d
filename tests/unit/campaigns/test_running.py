"""Campaigns from beginning to end, and the command that runs them."""

import json
import re
from itertools import product

import pytest

import rheoclast as rc
from rheoclast.cli import main

pytest.importorskip("msgspec")
pytest.importorskip("pyarrow")

import pyarrow.parquet as pq

from rheoclast.campaigns import read_campaign, survey
from rheoclast.campaigns.task import failed, perform
from rheoclast.campaigns.worker import WorkerLost

REQUEST = """
event = "breakup"
viscosity = 1e-3
radius = 1e-6
sizes = [12, 13]
flows = ["shear"]
orientations = "worst"
materials = ["polystyrene"]
hydrodynamics = { model = "free-draining" }
families = [{ name = "thinned-fcc-ball", coordination = [4, 11] }]
"""

IN_TURBULENCE = """
event = "history"
viscosity = 1e-3
radius = 1e-6
sizes = [12, 13]
materials = [{ name = "weak", stiffness = [1, 1, 1, 1], pull_off = 2e-10 }]
hydrodynamics = { model = "free-draining" }
families = [{ name = "cluster-cluster" }, { name = "straight-chain" }]

[histories]
model = "gaussian"
number = 4
duration = 5
dissipations = [1e-3, 3, 1e9]
density = 1e3
"""


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "campaign.toml"
    path.write_text(REQUEST, encoding="utf-8")
    return path


def in_turn(function, items, **_):
    """Performed here and now."""
    return ((item, function(item)) for item in items)


@pytest.fixture
def alone(monkeypatch):
    monkeypatch.setattr("rheoclast.campaigns.local_pool.performed", in_turn)


@pytest.mark.usefixtures("alone")
def test_only_what_is_missing_is_done_and_failures_only_when_asked_for(file, tmp_path, monkeypatch):
    campaign = read_campaign(file)
    told, worked = [], []
    survey(campaign, tmp_path / "out", progress=lambda *numbers: told.append(numbers))
    assert told == [(k, 4) for k in range(5)]
    first = (tmp_path / "out" / "events.parquet").read_bytes()

    def remembered(task):
        worked.append(task.parameters["coordination"])
        return perform(task)

    monkeypatch.setattr("rheoclast.campaigns.running.perform", remembered)
    told.clear()
    survey(campaign, tmp_path / "out", progress=lambda *numbers: told.append(numbers))
    assert worked == []
    assert told == [(4, 4)]
    survey(campaign, tmp_path / "out", retry=True)
    assert worked == [11, 11]
    assert (tmp_path / "out" / "events.parquet").read_bytes() == first


@pytest.mark.usefixtures("alone")
def test_summary_counts_and_names_failures_rates_and_files(file, tmp_path, capsys):
    with pytest.raises(SystemExit) as end:
        main(["survey", str(file)])
    assert end.value.code == 0
    shown = capsys.readouterr().out
    assert "4 aggregates, 1 material, 2 events" in shown
    assert "failed: 2" in shown
    assert "1 × ValueError: coordination: expected from" in shown
    assert "thinned-fcc-ball" in shown
    for name in ("events", "aggregates"):
        path = tmp_path / "campaign" / f"{name}.parquet"
        assert str(path) in shown
        assert path.is_file()
    rate = pq.read_table(tmp_path / "campaign" / "events.parquet")["initiation_rate_per_s"].to_numpy()
    assert f"{min(rate):.3g}" in shown


MANY_KINDS = """
viscosity = 1e-3
radius = 1e-6
sizes = [12, 14]
flows = ["shear", "uniaxial"]
orientations = { number = 5 }
materials = ["polystyrene", { name = "weak", stiffness = [1, 1, 1, 1], pull_off = 2e-10 }]
hydrodynamics = { model = "free-draining" }
families = [{ name = "straight-chain" }, { name = "thinned-fcc-ball", count = 13, coordination = [3.0, 4] }]
"""


@pytest.mark.usefixtures("alone")
def test_summary_keeps_apart_what_is_not_alike(file, tmp_path, capsys):
    """A table for every family, material and flow; a row for every size or other parameter."""
    file.write_text(MANY_KINDS, encoding="utf-8")
    with pytest.raises(SystemExit):
        main(["survey", str(file)])
    rows = pq.read_table(tmp_path / "campaign" / "events.parquet").to_pylist()
    shown = capsys.readouterr().out
    tables = {each.splitlines()[0].rpartition("\n")[2]: each for each in re.split(r"\n(?=\S+, \w+, \w+: )", shown)[1:]}
    assert len(tables) == 8
    for title, table in tables.items():
        family, material, flow = title.partition(":")[0].split(", ")
        name = {"straight-chain": "count", "thinned-fcc-ball": "coordination"}[family]
        lines = [[cell.strip() for cell in line[1:-1].split("│")] for line in table.splitlines() if line[0] in "│┃"]
        assert re.split(r"\s*┃\s*", "┃".join(lines[0]))[0] == name
        for line, value in zip(lines[1:], {"count": (12, 14), "coordination": (3, 4)}[name], strict=True):
            own = [row for row in rows if (row["family"], row["material"], row["flow"]) == (family, material, flow)]
            rates = sorted(r["initiation_rate_per_s"] for r in own if json.loads(r["parameters"])[name] == value)
            assert len(rates) == 5
            assert line == [str(value), "5", *(f"{rate:.3g}" for rate in (rates[0], rates[2], rates[4]))]


@pytest.mark.usefixtures("alone")
def test_summary_of_histories_has_the_breakage_rate_of_every_family_and_dissipation(file, tmp_path, capsys):
    file.write_text(IN_TURBULENCE, encoding="utf-8")
    with pytest.raises(SystemExit):
        main(["survey", str(file)])
    shown = capsys.readouterr().out
    assert "4 aggregates, 1 material, 48 events" in shown
    rows = pq.read_table(tmp_path / "campaign" / "events.parquet").to_pylist()
    lines = iter([line[1:-1].split("│") for line in shown.splitlines() if line.startswith("│")])
    for family in ("cluster-cluster", "straight-chain"):
        assert f"{family}, weak: breakage rate by dissipation" in shown
        for count, dissipation in product((12, 13), (1e-3, 3.0, 1e9)):
            of_family = [row for row in rows if row["family"] == family and f'"count":{count},' in row["parameters"]]
            own = [row for row in of_family if row["dissipation_m2_per_s3"] == dissipation]
            lasting = [row for row in own if not row["overloaded"]]
            shown_row = [each.strip() for each in next(lines)]
            assert shown_row[:3] == [str(count), f"{dissipation:.3g}", str(len(own) - len(lasting))]
            if not lasting:
                assert shown_row[3:] == ["0", "", ""]
                continue
            rate = rc.breakage_rate(rc.WaitingTimes(*([row[name] for row in lasting] for name in ("time_s", "failed"))))
            interval = " to ".join(f"{bound:.3g}" for bound in rate.interval)
            assert shown_row[3:] == [str(rate.events), f"{rate.rate:.3g}", interval]
    assert next(lines, None) is None


@pytest.mark.usefixtures("alone")
def test_histories_interrupted_and_taken_up_again_are_the_same(file, tmp_path, monkeypatch):
    file.write_text(IN_TURBULENCE, encoding="utf-8")
    campaign = read_campaign(file)
    whole = survey(campaign, tmp_path / "whole")

    def interrupted(task):
        if task == campaign.tasks()[2]:
            raise KeyboardInterrupt
        return perform(task)

    monkeypatch.setattr("rheoclast.campaigns.running.perform", interrupted)
    with pytest.raises(KeyboardInterrupt):
        survey(campaign, tmp_path / "parts")
    monkeypatch.setattr("rheoclast.campaigns.running.perform", perform)
    parts = survey(read_campaign(file), tmp_path / "parts")
    assert parts.events.read_bytes() == whole.events.read_bytes()
    assert parts.aggregates.read_bytes() == whole.aggregates.read_bytes()


def test_lost_workers_are_failures(file, tmp_path, monkeypatch):
    def lost(function, items, **_):
        return ((item, WorkerLost("gone")) for item in items)

    monkeypatch.setattr("rheoclast.campaigns.local_pool.performed", lost)
    results = survey(read_campaign(file), tmp_path / "out")
    assert results.table("aggregates", ["failure"])["failure"].to_pylist() == ["gone"] * 4


@pytest.mark.usefixtures("alone")
def test_all_failed_is_still_a_summary(file, capsys, monkeypatch):
    monkeypatch.setattr("rheoclast.campaigns.running.perform", lambda task: failed(task, "no luck"))
    with pytest.raises(SystemExit):
        main(["survey", str(file)])
    shown = capsys.readouterr().out
    assert "4 × no luck" in shown
    assert "quantiles" not in shown


def test_refusals_are_one_line(file, capsys):
    file.write_text(REQUEST.replace('"shear"', '"swirl"'), encoding="utf-8")
    with pytest.raises(SystemExit) as end:
        main(["survey", str(file)])
    assert end.value.code == 1
    told = capsys.readouterr().err
    assert told.count("\n") == 1
    assert "flows: expected one of shear, uniaxial, biaxial, planar, got 'swirl'" in told
    assert not file.with_suffix("").exists()


@pytest.mark.usefixtures("alone")
def test_a_spoilt_file_is_no_obstacle(file, tmp_path):
    campaign = read_campaign(file)
    first = survey(campaign, tmp_path / "out").events.read_bytes()
    next((tmp_path / "out" / "tasks").iterdir()).write_bytes(b"")
    assert survey(campaign, tmp_path / "out").events.read_bytes() == first


@pytest.mark.usefixtures("alone")
def test_a_second_run_in_the_same_folder_is_refused(file, tmp_path):
    campaign = read_campaign(file)

    def again(done, number):
        survey(campaign, tmp_path / "out")

    with pytest.raises(BlockingIOError, match="another process works in this folder"):
        survey(campaign, tmp_path / "out", progress=again)
    survey(campaign, tmp_path / "out")


@pytest.mark.usefixtures("alone")
def test_tables_have_two_names(file, tmp_path):
    results = survey(read_campaign(file), tmp_path / "out")
    with pytest.raises(ValueError, match="name: expected one of events, aggregates, got 'event'"):
        results.table("event")


def test_workers_and_scheduler_exclude_each_other(file, tmp_path):
    with pytest.raises(ValueError, match="workers: a cluster has workers of its own"):
        survey(read_campaign(file), tmp_path / "out", workers=2, scheduler="tcp://127.0.0.1:1")
    with pytest.raises(ValueError, match="workers: expected an integer of at least 1, got 0"):
        survey(read_campaign(file), tmp_path / "out", workers=0)
    assert not (tmp_path / "out").exists()
