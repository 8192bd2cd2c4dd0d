"""What is refused is refused in one line, in words of the command line, before anything is written."""

import os
import re
from pathlib import Path

import pytest

from rheoclast.cli import main

CHAIN = "0 0 0 1\n2 0 0 1\n4 0 0 1\n4 2 0 1\n"
SQUARE = "0 0 0 1\n2 0 0 1\n2 2 0 1\n0 2 0 1\n"
FILES = {
    "chain.dat": CHAIN,
    "square.dat": SQUARE,
    "one.dat": "0 0 0 1\n",
    "apart.dat": "0 0 0 1\n2.1 0 0 1\n",
    "far.dat": "0 0 0 1\n9 0 0 1\n",
    "overlap.dat": "0 0 0 1\n1.8 0 0 1\n",
    "positions.csv": "x,y,z\n0,0,0\n2,0,0\n",
    "nanometres.csv": "x_nm,y_nm,z_nm,radius_nm\n0,0,0,1\n2,0,0,1\n",
    "bad.dat": "0 0 0 1\n2 0\n",
    "pairs.csv": "i,j\n0,7\n",
    "campaign.toml": "viscosity = 1e-3\n",
    "ring.dat": "precious",
}
PYTHON = re.compile(
    r"\b(radius|unit|viscosity|format|order|overwrite|tolerance|arrays)=|\(overwrite\)|\bpass \w|[a-z]+_[a-z]+"
    r"|None|\bErrno\b|\b\w+Error\b|Traceback|NumPy|dtype|Value error|Invalid value|Input should|Missing|No such"
)
COMMANDS = [
    "stress",
    "stres chain.dat",
    "stress nothing.dat",
    "stress .",
    "stress one.dat --unit um",
    "break one.dat --unit um",
    "stress apart.dat --unit um",
    "stress far.dat --unit um",
    "stress overlap.dat --unit um",
    "stress positions.csv --unit um",
    "stress chain.dat --unit um --radius 1",
    "stress nanometres.csv --unit um",
    "stress bad.dat --unit um",
    "stress chain.dat --unit parsec",
    "stress chain.dat --unit um --format vtp",
    "stress chain.dat --unit um --format word",
    "stress chain.dat --unit um --contacts pairs.csv",
    "stress chain.dat --unit um --tolerance -1",
    "stress chain.dat --unit um --overlap-tolerance -1",
    "stress chain.dat --unit dimensionless",
    "stress chain.dat --unit um --flow shaer",
    "stress chain.dat --unit um --rate 1,5",
    "stress chain.dat --unit um --rate",
    "stress chain.dat --unit um --rate -1",
    "stress chain.dat --unit um --gradient '1 2 3'",
    "stress chain.dat --unit um --gradient '1 0 0 0 0 0 0 0 0'",
    "stress chain.dat --unit um --viscosity 0",
    "stress chain.dat --unit um --viscosity 1e300",
    "stress chain.dat --unit um --model magic",
    "stress chain.dat --unit um --order 0",
    "stress chain.dat --unit um --order two",
    "stress chain.dat --unit um --order auto --accuracy -1",
    "stress chain.dat --unit um --order auto --accuracy 1e-9",
    "stress chain.dat --unit um --material gold",
    "stress chain.dat --unit um --youngs-modulus 0",
    "stress chain.dat --unit um --poisson-ratio 0.7",
    "stress chain.dat --unit um --work-of-adhesion x",
    "stress chain.dat --unit um --law oil",
    "stress chain.dat --unit um --pull-off -1",
    "stress chain.dat --unit um --stiffness 1 1 1 1",
    "stress chain.dat --unit um --stiffness 1,1,1,1",
    "stress chain.dat --unit um --stiffness 1 1 1 0 --pull-off 1",
    "stress chain.dat --unit um --output ''",
    "stress chain.dat --unit um --output chain.dat",
    "stress chain.dat --unit um --output nowhere/results",
    "stress chain.dat --unit um --rat 3",
    "stress chain.dat --unit um -5",
    "stress chain.dat square.dat --unit um",
    "break chain.dat --unit um --rule weak",
    "break chain.dat --unit um --orientation best",
    "break chain.dat --unit um --orientation random --seed -1",
    "break chain.dat --unit um --orientation random --seed 1.5",
    "break chain.dat --unit um --up-to 0",
    "break chain.dat --unit um --cascade",
    "break chain.dat --unit um --criterion taste",
    "break chain.dat --unit um --criterion rolling",
    "break chain.dat --unit um --friction -1",
    "break chain.dat --unit um --rolling-distance 0",
    "break square.dat --unit um --stiffness 1 1 1 1 --pull-off 1 --friction 1",
    "info chain.dat --unit um --order 1.5",
    "generate ring",
    "generate ring 2",
    "generate ring ten",
    "generate ring 10",
    "generate rnig 10",
    "generate ring 10 --output new.foo",
    "generate ring 10 --output nowhere/new.dat",
    "generate bent-chain 10",
    "generate lattice-block fcc 3",
    "generate lattice-block fc 3 3 3",
    "generate random-packed-ball 10 --seed -1",
    "generate cluster-cluster 10 --spread -1",
    "report nothing",
    "report .",
    "survey nothing.toml",
    "survey .",
    "survey chain.dat",
    "survey campaign.toml",
    "survey campaign.toml --workers two",
]
IDLE = [
    ("stress --gradient '0 1 0 0 0 0 0 0 0' --flow shear", "--flow: has no effect with --gradient"),
    ("stress --gradient '0 1 0 0 0 0 0 0 0' --rate 1", "--rate: has no effect with --gradient"),
    ("stress --contacts pairs.csv --tolerance 0.1", "--tolerance: has no effect with --contacts"),
    ("stress --stiffness 1 1 1 1 --pull-off 1 --material gold", "--material: has no effect with --stiffness"),
    ("stress --stiffness 1 1 1 1 --pull-off 1 --law jkr", "--law: has no effect with --stiffness"),
    ("stress --stiffness 1 1 1 1 --pull-off 1 --youngs-modulus 1", "--youngs-modulus: has no effect with --stiffness"),
    ("stress --model free-draining --order 3", "--order: has no effect with this --model"),
    ("stress --accuracy 0.1", "--accuracy: has no effect without --order auto; leave it out, or add --order auto"),
    ("info --accuracy 0.1 --order 2", "--accuracy: has no effect without --order auto"),
    ("stress --overwrite", "--overwrite: has no effect without --output"),
    ("break --animation", "--animation: has no effect without --output"),
    ("break --seed 0 --orientation worst", "--seed: has no effect without --orientation random"),
    ("break --seed 0", "--seed: has no effect without --orientation random"),
]


@pytest.fixture
def run(capsys, tmp_path, monkeypatch):
    """Run a command line in a folder of small files; returns exit status, standard output and standard error."""
    monkeypatch.chdir(tmp_path)
    for name, content in FILES.items():
        (tmp_path / name).write_text(content)

    def run(line):
        words = [word.strip("'") for word in re.findall(r"'[^']*'|\S+", line)]
        with pytest.raises(SystemExit) as stop:
            main(words)
        return (stop.value.code or 0, *capsys.readouterr())

    return run


@pytest.mark.parametrize("line", COMMANDS)
def test_one_line_without_words_of_python(run, line, tmp_path):
    status, out, err = run(line)
    assert status in (1, 2)
    assert out == ""
    assert re.fullmatch(r"(warning: .*\n)?error: \S.*\n", err), err
    assert not PYTHON.search(err.replace(str(tmp_path), "")), err
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(FILES)


def test_the_words_of_python_would_be_found():
    for text in ("pass radius= here", "(unit='nm')", "give youngs_modulus", "[Errno 2] No such file", "Value error, x"):
        assert PYTHON.search(text)
    assert not PYTHON.search("error: --pull-off: expected a positive number, got -1; see rheoclast stress --help")


@pytest.mark.parametrize(("line", "message"), IDLE)
def test_options_without_effect(run, line, message):
    command, _, rest = line.partition(" ")
    status, out, err = run(f"{command} chain.dat --unit um {rest}")
    assert (status, out) == (1, "")
    assert err.startswith(f"error: {message}")
    assert "leave one of them out" in err or "leave it out, or add" in err


def test_defaults_that_are_written_out_are_no_contradiction(run):
    line = "stress chain.dat --unit um --order auto --accuracy 0.5 --model stokesian --flow shear --rate 1"
    assert run(line)[0] == 0


@pytest.mark.skipif(not Path("/proc/self").exists(), reason="there is no folder that nobody can write to")
@pytest.mark.parametrize("line", ["stress chain.dat --unit um --output", "break chain.dat --unit um --output"])
def test_a_folder_that_cannot_be_written_is_told_before_the_computation(run, line, monkeypatch):
    monkeypatch.setattr("rheoclast.cli.commands.analyse", None)
    monkeypatch.setattr("rheoclast.cli.breaking.rigid_response", None)
    status, _, err = run(f"{line} /proc/results")
    assert status == 1
    assert re.search(r"error: --output /proc/results: cannot be written \(.*\); choose another folder\n$", err)


@pytest.mark.skipif(not Path("/proc/self").exists(), reason="there is no folder that nobody can write to")
def test_a_file_that_cannot_be_written_is_told_before_the_growth(run):
    assert "error: /proc/ring.dat: cannot be written" in run("generate ring 10 --output /proc/ring.dat")[2]


def test_results_go_into_a_folder_whose_own_folder_is_closed(run, tmp_path, monkeypatch):
    """Unfinished files lie in the folder itself once it is there."""
    (tmp_path / "results").mkdir()
    real = os.mkdir

    def closed(path, *arguments, **named):
        if Path(path).absolute().parent == tmp_path:
            raise PermissionError(13, "Permission denied", str(path))
        return real(path, *arguments, **named)

    monkeypatch.setattr("os.mkdir", closed)
    assert run("stress chain.dat --unit um --output results")[0] == 0
    assert (tmp_path / "results" / "summary.json").exists()


@pytest.mark.parametrize("line", ["", "generate", "-h", "stress -h", "generate ring -h", "generate --help"])
def test_help_is_no_error(run, line):
    status, out, err = run(line)
    assert (status, err) == (0, "")
    assert "Usage: rheoclast" in out


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("stress chain.dat --unit um --flow shaer", "got 'shaer'; did you mean shear?"),
        ("break chain.dat --unit um --rule weak", "one of weakest, overloaded, got 'weak'; did you mean weakest?"),
        ("generate rnig 10", "there is no command rnig; did you mean ring?"),
        ("stress chain.dat --unit um --rate 1,5", "--rate: expected a number, got '1,5'; write a point for the"),
        ("stress", "expected <file>, got nothing; see rheoclast stress --help"),
        ("stress apart.dat --unit um", "raise --tolerance above it"),
        ("stress overlap.dat --unit um", "add --overlap-tolerance"),
        ("stress positions.csv --unit um", "add --radius in the file's unit"),
        ("stress nanometres.csv --unit um", "add --unit nm or rename the columns"),
        ("generate ring 10", "ring.dat exists already; choose another name, or add --overwrite"),
        ("stress chain.dat --unit um --stiffness 1 1 1 0 --pull-off 1", "--stiffness (twisting): expected a positive"),
        ("survey chain.dat", "chain.dat: expected a campaign in TOML, with lines key = value; "),
        ("stress chain.dat --unit dimensionless", "add --viscosity 1 and --pull-off, and --stiffness for contacts"),
    ],
)  # fmt: skip
def test_what_to_do(run, line, message):
    assert message in run(line)[2]


def test_a_warning_comes_before_the_results_and_once(run, capsys):
    status, out, err = run("info chain.dat")
    assert status == 0
    assert err == "warning: radii up to 1 m exceed 1 mm: is the unit of length right? If not, add --unit nm\n"
    assert "1.00 m" in out
