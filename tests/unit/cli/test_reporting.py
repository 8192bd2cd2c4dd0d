"""`rheoclast report` as a user meets it."""

import sys

import pytest
import typer
from typer.testing import CliRunner

from rheoclast.cli import main
from rheoclast.cli.reporting import report_command


@pytest.fixture
def report():
    """Run the command; returns what typer's runner does."""
    app = typer.Typer()
    app.command()(report_command)
    return lambda *arguments: CliRunner().invoke(app, [str(argument) for argument in arguments])


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "chain.dat").write_text("0 0 0 1\n2 0 0 1\n4 0 0 1\n4 2 0 1\n")
    with pytest.raises(SystemExit):
        main(["stress", str(tmp_path / "chain.dat"), "--unit", "um", "--output", str(tmp_path / "out")])
    return tmp_path / "out"


def test_writes_beside_the_results(report, folder):
    done = report(folder)
    assert done.exit_code == 0
    assert f"written to {folder / 'report.html'} (0.1 MB); open it in a browser" in done.stdout
    assert (folder / "report.html").read_text(encoding="utf-8").startswith("<!doctype html>")


def test_another_place(report, folder, tmp_path):
    assert report(folder, "--output", tmp_path / "page.html").exit_code == 0
    assert (tmp_path / "page.html").exists()
    assert isinstance(report(folder, "--output", tmp_path / "page.html").exception, FileExistsError)
    assert report(folder, "--output", tmp_path / "page.html", "--overwrite").exit_code == 0


def test_a_folder_without_results(report, tmp_path):
    problem = report(tmp_path).exception
    assert isinstance(problem, FileNotFoundError)
    assert str(problem).count("\n") == 0
    assert "expected the results of stress, break or survey, got a folder without summary.json" in str(problem)


CAMPAIGN = """
event = "first failure"
viscosity = 1e-3
radius = 1e-6
flows = ["shear"]
orientations = { number = 5 }
materials = ["polystyrene"]
hydrodynamics = { model = "free-draining" }
families = [{ name = "straight-chain", count = [4, 6] }]
"""


def in_turn(function, items, **_):
    """Performed here and now."""
    return ((item, function(item)) for item in items)


@pytest.fixture
def campaign(tmp_path, monkeypatch):
    pytest.importorskip("msgspec")
    pytest.importorskip("pyarrow")
    monkeypatch.setattr("rheoclast.campaigns.local_pool.performed", in_turn)
    (tmp_path / "chains.toml").write_text(CAMPAIGN)
    with pytest.raises(SystemExit) as stop:
        main(["survey", str(tmp_path / "chains.toml")])
    assert not stop.value.code
    return tmp_path / "chains"


def test_a_campaign(report, campaign):
    done = report(campaign)
    assert done.exit_code == 0
    assert f"written to {campaign / 'report.html'}" in done.stdout
    assert "<h1>chains</h1>" in (campaign / "report.html").read_text(encoding="utf-8")


def test_a_campaign_without_pyarrow(report, campaign, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    problem = report(campaign).exception
    assert isinstance(problem, ImportError)
    assert str(problem) == "a page on a campaign needs the package pyarrow: pip install 'rheoclast[parquet]'"
    assert not (campaign / "report.html").exists()
