"""Campaigns from beginning to end, and the command that runs them."""

import pytest

from rheoclast.cli import main

pytest.importorskip("msgspec")
pytest.importorskip("pyarrow")

import pyarrow.parquet as pq

from rheoclast.populations.campaign import read_campaign, survey
from rheoclast.populations.campaign.task import failed, perform
from rheoclast.populations.campaign.worker import WorkerLost

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
    monkeypatch.setattr("rheoclast.populations.campaign.local_pool.performed", in_turn)


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

    monkeypatch.setattr("rheoclast.populations.campaign.running.perform", remembered)
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


def test_lost_workers_are_failures(file, tmp_path, monkeypatch):
    def lost(function, items, **_):
        return ((item, WorkerLost("gone")) for item in items)

    monkeypatch.setattr("rheoclast.populations.campaign.local_pool.performed", lost)
    results = survey(read_campaign(file), tmp_path / "out")
    assert results.table("aggregates", ["failure"])["failure"].to_pylist() == ["gone"] * 4


@pytest.mark.usefixtures("alone")
def test_all_failed_is_still_a_summary(file, capsys, monkeypatch):
    monkeypatch.setattr("rheoclast.populations.campaign.running.perform", lambda task: failed(task, "no luck"))
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


def test_workers_and_scheduler_exclude_each_other(file, tmp_path):
    with pytest.raises(ValueError, match="workers: a cluster has workers of its own"):
        survey(read_campaign(file), tmp_path / "out", workers=2, scheduler="tcp://127.0.0.1:1")
    with pytest.raises(ValueError, match="workers: expected an integer of at least 1, got 0"):
        survey(read_campaign(file), tmp_path / "out", workers=0)
    assert not (tmp_path / "out").exists()
