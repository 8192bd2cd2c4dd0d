"""The code in README and documentation runs, page by page and in its order, and prints what the page says it prints."""

import inspect
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).parents[2]
GENERATED = ("_build", "_examples", "gallery", "validation")
PAGES = {
    page.relative_to(ROOT).as_posix(): page.read_text(encoding="utf-8")
    for page in (ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md")))
    if page.relative_to(ROOT).parts[1:2] not in [(folder,) for folder in GENERATED]
}
BLOCK = re.compile(r"^( *)```(python|sh)\n(.*?)^\1```\n(?:\n?\1```text\n(.*?)^\1```)?", re.S | re.M)
WITH_CODE = [name for name, text in PAGES.items() if BLOCK.search(text)]
# What makes an environment or checks the whole project; `.ci/run` does all of it.
SET_UP = re.compile(r"python3 -m venv|(\S*/)?(pip install|python -m (pytest|sphinx))|bash \.ci/run")
ADDRESS = "tcp://192.0.2.7:8786"  # stands for any scheduler (RFC 5737)


@pytest.fixture
def workplace(tmp_path, monkeypatch):
    """A folder in which pages find the examples and a campaign, and may write."""
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    (tmp_path / "campaign.toml").write_bytes((ROOT / "examples" / "campaign.toml").read_bytes())
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def scheduler():
    """Address of a scheduler that has one worker."""
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as cluster:
        yield cluster.scheduler_address


@pytest.mark.usefixtures("workplace")
@pytest.mark.parametrize("name", WITH_CODE)
def test_code_runs_and_prints_what_the_page_says(name, capsys, request):
    """Python in one go, tests among it as well; in a shell one command after the other."""
    names: dict[str, object] = {"__name__": "page"}
    for indent, language, code, documented in BLOCK.findall(PAGES[name]):
        if language == "python":
            exec(compile(inspect.cleandoc(code) if indent else code, name, "exec"), names)
            printed = capsys.readouterr().out
        else:
            address = request.getfixturevalue("scheduler") if ADDRESS in code else ""
            printed = "".join(run(line) for line in commands(code.replace(ADDRESS, address)))
        if documented or language == "python":
            assert_same_print(printed, documented)
    for test in [each for key, each in names.items() if key.startswith("test_")]:
        test()


def commands(code):
    """Command lines without set-up, comments and the folder of the environment."""
    lines = [part.partition(" #")[0].strip() for line in code.splitlines() for part in line.split("&&")]
    return [line.removeprefix(".venv/bin/") for line in lines if line and not SET_UP.match(line)]


def run(line):
    """What a command prints on a wide terminal; the programs of this environment come first."""
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    environment = {**os.environ, "PATH": path, "COLUMNS": "120"}
    done = subprocess.run(line, shell=True, env=environment, capture_output=True, text=True, timeout=240)
    assert done.returncode == 0, f"{line}\n{done.stdout}{done.stderr}"
    return done.stdout


def assert_same_print(printed, documented):
    """The same words and numbers, whose last digit may differ between machines; more may follow after a table."""
    got, expected = number_or_word(printed), number_or_word(documented)
    assert len(got) == len(expected) or (len(got) > len(expected) and documented.endswith("┘\n")), printed
    for one, other in zip(got, expected, strict=False):
        if isinstance(other, float):
            np.testing.assert_allclose(one, other, rtol=0.06, err_msg=printed)
        else:
            assert one == other, printed


def number_or_word(printed):
    words = re.findall(r"[-+]?\d+\.?\d*(?:e[-+]?\d+)?|[^\s\d]+", printed)
    return [float(word) if re.fullmatch(r"[-+\d.e]*\d[-+\d.e]*", word) else word for word in words]


@pytest.mark.parametrize("name", PAGES)
def test_no_code_is_of_a_kind_that_does_not_run(name):
    """Apart from what runs there is output, and what Sphinx puts in from files that are tested elsewhere."""
    kinds = re.findall(r"^ *```(\S+)", PAGES[name], re.M)
    assert len(BLOCK.findall(PAGES[name])) == sum(kind in ("python", "sh") for kind in kinds)
    assert set(kinds) <= {"python", "sh", "text", "{literalinclude}", "{include}", "{toctree}", "{eval-rst}"}


@pytest.mark.parametrize("name", WITH_CODE)
def test_only_set_up_is_left_out(name):
    for _, language, code, _ in BLOCK.findall(PAGES[name]):
        if language == "sh":
            assert len(commands(code)) == len(re.findall(r"(?<!name )\brheoclast (?=[a-z])", code))
            assert all(line.startswith("rheoclast ") for line in commands(code))
