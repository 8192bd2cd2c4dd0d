"""The pages on the command line and on campaigns name every command, file, column and key, and no others."""

import csv
import json
import re
from pathlib import Path

import pytest
import typer

import rheoclast as rc
from rheoclast.cli import main
from rheoclast.cli.commands import app

DOCS = Path(__file__).parents[2] / "docs"
COMMAND_LINE = (DOCS / "command_line.md").read_text(encoding="utf-8")
CAMPAIGNS = (DOCS / "campaigns.md").read_text(encoding="utf-8")
UNITS = {"m": "m", "N": "N", "Nm": "N m", "per_s": "1/s"}
TABLES = ("contacts.csv", "spheres.csv", "failures.csv", "fragments.csv", "pieces.csv")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Everything that the commands leave of a small ball with loops."""
    folder = tmp_path_factory.mktemp("results")
    ball = rc.generation.thinned_fcc_ball(14, 5, radius=0.5e-6, seed=1)
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        rc.write("ball.dat", ball)
        run("stress", "ball.dat", "--output", "loads")
        run("break", "ball.dat", "--rate", "1e9", "--orientation", "worst", "--cascade", "--output", "broken")
        run("report", "broken")
    return folder


def run(*arguments):
    with pytest.raises(SystemExit) as stop:
        main(arguments)
    assert not stop.value.code


def rows(heading):
    """Rows of the table under a heading of the page, as cells."""
    section = re.search(rf"^### {re.escape(heading)}\n(.*?)(?=^#|\Z)", COMMAND_LINE, re.M | re.S)[1]
    return [[cell.strip() for cell in line.strip("|\n").split(" |")] for line in re.findall(r"^\| `.*$", section, re.M)]


def names(cell):
    return re.findall(r"`([^`]+)`", cell)


def documented(heading):
    return [name for row in rows(heading) for name in names(row[0])]


def columns(path):
    with path.open(newline="") as file:
        return next(csv.reader(file))


@pytest.mark.parametrize("name", TABLES)
def test_every_column_is_documented_in_its_order(folder, name):
    written = [column for path in sorted(folder.glob(f"*/{name}"), reverse=True) for column in columns(path)]
    assert written
    assert list(dict.fromkeys(written)) == documented(name)


@pytest.mark.parametrize("name", TABLES)
def test_units_are_those_in_the_names(name):
    for cell, unit, *_ in rows(name):
        for column in names(cell):
            tag = re.search(r"(?:^|_)(m|N|Nm|per_s)(?:_[xyz])?$", column)
            assert unit == UNITS[tag[1]] if tag else unit in ("", "1"), column


@pytest.mark.parametrize(("command", "written"), [("stress", "loads"), ("break", "broken")])
def test_every_key_of_a_summary_is_documented(folder, command, written):
    keys = documented(f"summary.json of {command}")
    if "worst_orientation.…" in keys:
        keys.remove("worst_orientation.…")
        keys += [key.replace("given", "worst") for key in keys if key.startswith("given_orientation.")]
    summary = json.loads((folder / written / "summary.json").read_text())
    assert sorted(leaves(summary, keys)) == sorted(keys)


def leaves(value, documented, path=""):
    """Paths to the values of a summary, as deep as they are documented."""
    if not isinstance(value, dict) or path in documented:
        return [path]
    return [leaf for key, part in value.items() for leaf in leaves(part, documented, f"{path}.{key}".lstrip("."))]


def test_every_file_is_named(folder):
    written = {re.sub(r"\d+", "1", path.name) for path in folder.glob("*/*")}
    assert written >= {*TABLES, "report.html", "crack.png", "fragment_1.dat"}
    for name in written:
        assert re.search(rf"[`/]{re.escape(name)}`", COMMAND_LINE), name


def test_every_command_has_its_section():
    commands = typer.main.get_command(app).commands
    assert set(re.findall(r"^## (\w+)$", COMMAND_LINE, re.M)) == set(commands)
    assert re.findall(r"^\| \[`(\w+)`\]", COMMAND_LINE, re.M) == re.findall(r"^## (\w+)$", COMMAND_LINE, re.M)


def test_every_option_that_is_named_exists():
    commands = [typer.main.get_command(app).commands[name] for name in ("stress", "break", "report", "survey")]
    options = {option for command in commands for each in command.params for option in each.opts}
    families = typer.main.get_command(app).commands["generate"].commands.values()
    options |= {option for family in families for each in family.params for option in each.opts}
    named = set(re.findall(r"(?<![\w-])--[a-z][\w-]+", COMMAND_LINE))
    assert named - {"--help", "--debug"} <= options


def test_every_column_of_a_campaign_is_documented():
    pytest.importorskip("pyarrow")
    from rheoclast.campaigns.events import EVENTS
    from rheoclast.campaigns.task import AGGREGATE, IDENTITY

    lists = [
        {name for line in block.splitlines() for name in re.split(r"\s{2,}", line)[0].split(", ")}
        for block in re.findall(r"^```text\n(.*?)^```", CAMPAIGNS, re.M | re.S)
    ]
    for kind in (IDENTITY, AGGREGATE, *(event.type for event in EVENTS.values())):
        assert set(kind.names) in lists
