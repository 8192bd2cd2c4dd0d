"""`rheoclast generate`: every family from the shell, to files that the other commands read."""

import json

import numpy as np
import pytest
import typer

import rheoclast as rc
from rheoclast import generation
from rheoclast.cli import generation as families_of_commands
from rheoclast.cli import main

ARGUMENTS = {
    "bent-chain": ["12", "--bend", "0.3"],
    "cross": ["3"],
    "lattice-block": ["fcc", "2", "3", "2"],
    "lattice-ball": ["hcp", "13"],
    "thinned-fcc-ball": ["20", "3"],
    "compacted-cluster": ["20", "--amount", "0.5"],
}


@pytest.fixture
def run(capsys, tmp_path, monkeypatch):
    """Run the command line in an empty folder; returns exit status, standard output and standard error."""
    monkeypatch.chdir(tmp_path)

    def run(*arguments):
        with pytest.raises(SystemExit) as stop:
            main([str(argument) for argument in arguments])
        return (stop.value.code or 0, *capsys.readouterr())

    return run


@pytest.mark.parametrize("name", generation.FAMILIES)
def test_every_family_writes_a_file_that_is_read_back(run, name, tmp_path):
    status, out, _ = run("generate", name, *ARGUMENTS.get(name, ["12"]))
    assert status == 0
    assert "rheoclast stress" in out
    aggregate = rc.read(tmp_path / f"{name}.dat", unit="m")
    assert len(aggregate) > 9
    np.testing.assert_allclose(aggregate.spheres.radii, 0.5e-6)
    status, out, _ = run("stress", f"{name}.dat", "--rate", "1e5", "--json")
    assert status == 0
    assert json.loads(out)["aggregate"]["spheres"] == len(aggregate)


@pytest.mark.parametrize("name", generation.FAMILIES)
def test_every_help_has_an_example_that_runs(run, name, tmp_path):
    _, out, _ = run("generate", name, "--help")
    example = " ".join(out.split("Example:")[1].split("╭")[0].split())
    words = example.removeprefix("rheoclast generate ").split()
    assert words[0] == name
    assert run("generate", *words)[0] == 0


def test_options_are_those_of_the_function(run, tmp_path):
    options = ["--radius", "1e-7", "--fractal-dimension", "2.1", "--prefactor", "1.2", "--spread", "0.2", "--seed", "5"]
    assert run("generate", "cluster-cluster", "40", *options, "--output", "floc.csv")[0] == 0
    expected = generation.cluster_cluster(40, 1e-7, fractal_dimension=2.1, prefactor=1.2, spread=0.2, seed=5)
    np.testing.assert_allclose(rc.read(tmp_path / "floc.csv", unit="m").spheres.centers, expected.spheres.centers)


def test_parameters_of_a_new_family_are_options_with_its_own_words(run, monkeypatch):
    def knot(count: int, radius: float = 1.0, *, tightness: float = 2.0) -> rc.Aggregate:
        """Knot of `count` spheres.

        Parameters
        ----------
        tightness
            How close its strands lie,
            in `radii`.

        Raises
        ------
        ValueError
            Never.
        """
        assert tightness == 3
        return generation.straight_chain(count, radius)

    command = families_of_commands.command_of("knot", knot)
    app = typer.Typer()
    app.command()(command)
    app(["5", "--tightness", "3"], standalone_mode=False)
    assert len(rc.read("knot.dat")) == 5
    assert families_of_commands.documented(knot, "tightness") == "How close its strands lie, in radii."
    assert families_of_commands.documented(knot, "count") == ""


class TestRefusals:
    def test_existing_file(self, run, tmp_path):
        (tmp_path / "ring.dat").write_text("precious")
        status, _, err = run("generate", "ring", "10")
        assert status == 1
        assert err.startswith("error: ring.dat exists already")
        assert (tmp_path / "ring.dat").read_text() == "precious"
        assert run("generate", "ring", "10", "--overwrite")[0] == 0

    def test_what_cannot_be_leaves_no_file(self, run, tmp_path):
        status, _, err = run("generate", "cluster-cluster", "100", "--fractal-dimension", "3", "--prefactor", "4")
        assert status == 1
        assert "less than that of the densest packing" in err
        assert not list(tmp_path.iterdir())

    def test_contacts_are_kept_where_not_all_that_touch_are_joined(self, run):
        status, out, _ = run("generate", "thinned-fcc-ball", "20", "3", "--output", "thin.xyz")
        assert status == 0
        assert "--contacts thin_contacts.csv" in out.replace("\n", "")
        thin = rc.read("thin.xyz", contacts="thin_contacts.csv")
        assert len(thin.pairs) == 30
        assert len(rc.read("thin.xyz").pairs) > 30
