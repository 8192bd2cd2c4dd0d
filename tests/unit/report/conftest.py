"""Results as the command line leaves them, made once for all tests of the page."""

import csv
import os
import shutil

import pytest

import rheoclast as rc
from rheoclast.cli import main

BENT_CHAIN = (
    "0 0 0 1\n2 0 0 1\n4 0 0 1\n5.4 1.4282856857085699 0 1\n7.4 1.4282856857085699 0 1\n7.4 2.9282856857085699 0 .5\n"
)


@pytest.fixture(scope="session")
def results(tmp_path_factory):
    """Run a command with some arguments on an aggregate; returns the folder with its results."""

    def results(command, aggregate, *arguments):
        folder = tmp_path_factory.mktemp(command)
        file = folder / "floc.dat"
        if isinstance(aggregate, str):
            file.write_text(aggregate)
        else:
            rc.write(file, aggregate)
        with pytest.raises(SystemExit) as stop:
            main([command, str(file), *map(str, arguments), "--output", str(folder / "out")])
        assert not stop.value.code
        return folder / "out"

    return results


@pytest.fixture(scope="session")
def stressed(results):
    """Loads of a flat bent chain of five spheres and a smaller one, lengths in µm."""
    return results("stress", BENT_CHAIN, "--unit", "um", "--rate", 1e4)


@pytest.fixture(scope="session")
def broken(results):
    """Breakup of a cluster of thirty spheres with loops."""
    aggregate = rc.generation.compacted_cluster(30, radius=0.5e-6, amount=0.4, seed=1)
    return results("break", aggregate, "--flow", "uniaxial", "--rate", 1e5)


@pytest.fixture
def copied(tmp_path):
    """A copy of a folder of results, to be changed."""

    def copied(folder):
        return shutil.copytree(folder, tmp_path / "copy")

    return copied


@pytest.fixture(scope="session")
def rows():
    """Rows of a table of results, as words by column."""

    def rows(path: os.PathLike):
        with path.open(newline="") as file:
            return list(csv.DictReader(file))

    return rows
