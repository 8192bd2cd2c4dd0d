"""`rheoclast survey` as a user meets it; what it computes: tests/unit/campaigns."""

import re

import pytest

from rheoclast.cli import main

pytest.importorskip("msgspec")
pytest.importorskip("pyarrow")

CAMPAIGN = """
viscosity = 1e-3
radius = 1e-6
flows = ["shear"]
orientations = { number = 3 }
materials = ["polystyrene"]
hydrodynamics = { model = "free-draining" }
families = [{ name = "thinned-fcc-ball", count = 13, coordination = [4, 40] }]
"""


def in_turn(function, items, **_):
    """Performed here and now."""
    return ((item, function(item)) for item in items)


@pytest.fixture
def run(capsys, tmp_path, monkeypatch):
    """Run the command line in a folder with a campaign; returns exit status, standard output and standard error."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("rheoclast.campaigns.local_pool.performed", in_turn)
    (tmp_path / "campaign.toml").write_text(CAMPAIGN)

    def run(*arguments):
        with pytest.raises(SystemExit) as stop:
            main(list(arguments))
        return (stop.value.code or 0, *capsys.readouterr())

    return run


def test_what_failed_is_told_last(run):
    status, out, err = run("survey", "campaign.toml")
    assert (status, err) == (0, "")
    assert re.search(r"┘\nwritten to \S+ and \S+\nfailed: 1 \(.*\)\n  1 × .*coordination.*\n$", out)


def test_a_title_is_not_wrapped(run, monkeypatch):
    monkeypatch.setenv("COLUMNS", "40")
    out = run("survey", "campaign.toml")[1]
    assert "thinned-fcc-ball, polystyrene, shear: initiation rate, 1/s: quantiles" in out.splitlines()


def test_a_scheduler_that_is_not_there(run, monkeypatch):
    def refused(*_, **__):
        raise OSError("Timed out trying to connect to tcp://192.0.2.7:8786 after 30 s")

    monkeypatch.setattr("rheoclast.campaigns.survey", refused)
    status, out, err = run("survey", "campaign.toml", "--scheduler", "tcp://192.0.2.7:8786")
    assert (status, out) == (1, "")
    assert err.startswith("error: --scheduler tcp://192.0.2.7:8786: cannot be reached (Timed out trying to connect")
    assert err.endswith("); start it there, or correct the address\n")


def test_a_suggestion_for_a_family_and_a_radius_in_metres(run, tmp_path):
    for changed, message in (
        (("thinned-fcc-ball", "cluster-clustr"), "got 'cluster-clustr'; did you mean cluster-cluster?"),
        (("sizes", "size"), "unknown key size; did you mean sizes?"),
        (("1e-6", "1.0"), "radii up to 1 m exceed 1 mm: is the unit of length right? If not, lengths are in metres"),
    ):
        text = ("sizes = [10]\n" + CAMPAIGN).replace(*changed)
        (tmp_path / "other.toml").write_text(text)
        assert message in run("survey", "other.toml")[2]
