"""`rheoclast report` as a user meets it."""

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
    assert "expected the results of stress or break, got a folder without summary.json" in str(problem)
