"""Results are read back as they were written, or refused in one sentence."""

import json

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.report.result import read_result


def test_loads_are_those_of_the_library(stressed):
    aggregate = rc.read(stressed / "spheres.csv", contacts=stressed / "contacts.csv")
    bonds = rc.jkr_bonds(aggregate, rc.MATERIALS["polystyrene"])
    response = rc.rigid_response(aggregate.spheres, rc.StokesianDynamics(), viscosity=1e-3)
    loads = rc.contact_response(aggregate, response, bonds).loads(rc.simple_shear(1e4))
    result = read_result(stressed)
    assert not result.is_breakup
    for name in ("tension", "shear", "bending", "twisting"):
        np.testing.assert_allclose(result.contacts[name], getattr(loads, name), rtol=1e-6, atol=1e-18)
    np.testing.assert_array_equal(result.flow.gradient, rc.simple_shear(1e4).gradient)
    assert result.flow.rate == 1e4


def test_loads_of_a_breakup_are_those_at_its_initiation(broken):
    result = read_result(broken)
    first = int(result.failures["contact"][0])
    assert result.is_breakup
    assert result.contacts["load_ratio"].max() == pytest.approx(1, rel=1e-9)
    assert result.contacts["load_ratio"].argmax() == first
    assert result.summary["contact_loads_at_rate_per_s"] == result.summary["initiation_rate_per_s"]
    share = result.contacts["tension_error"][first] / result.contacts["tension"][first]
    assert result.summary["initiation_rate_error"] == pytest.approx(share, rel=1e-9)
    assert result.flow.rate == 1e5


def test_criterion_decides_the_load_ratio(results):
    """Sliding with friction: the contact that fails first is the one whose ratio is one."""
    ball = rc.generation.random_packed_ball(20, radius=0.5e-6, seed=1)
    result = read_result(results("break", ball, "--friction", 0.3, "--criterion", "sliding"))
    assert result.contacts["load_ratio"].max() == pytest.approx(1, rel=1e-9)
    assert result.contacts["load_ratio"].argmax() == result.failures["contact"][0]
    assert result.summary["initiation_rate_error"] is None


def test_fragments_of_spheres(broken):
    result = read_result(broken)
    sizes = np.bincount(result.spheres["fragment"].astype(int))[1:]
    assert sizes.tolist() == result.summary["fragments"]
    assert len(sizes) > 1
    for failure in np.flatnonzero(result.failures["on_surface"]):
        i, j = (int(result.failures[side][failure]) for side in "ij")
        assert result.spheres["fragment"][i] != result.spheres["fragment"][j]


def test_dimensionless(results):
    result = read_result(results("stress", "0 0 0 1\n2 0 0 1\n4 0 0 1\n", "--unit", "um", "--dimensionless"))
    assert result.units["force"] == "μGa²"
    np.testing.assert_allclose(np.diff(result.spheres["x"]), 2)


def test_rounding_errors_of_loads_are_zeros(results):
    """Of a chain along the axis of an extension, which has neither shear nor moments."""
    contacts = read_result(
        results("stress", "0 0 0 1\n2 0 0 1\n4 0 0 1\n", "--unit", "um", "--flow", "biaxial")
    ).contacts
    assert (contacts["tension"] > 0).all()
    for load in ("shear", "bending", "twisting"):
        np.testing.assert_array_equal(contacts[load], 0)


def test_nothing_fails(results):
    """A doublet that is compressed: no failures and one fragment."""
    result = read_result(results("break", "0 0 0 1\n2 0 0 1\n", "--unit", "um", "--flow", "uniaxial"))
    assert not result.failures
    assert result.fragments["spheres"].tolist() == [2]


class TestRefusals:
    def test_no_folder(self, tmp_path):
        with pytest.raises(FileNotFoundError, match=r"expected a folder with the results .* got nothing of that name"):
            read_result(tmp_path / "none")
        (tmp_path / "file").write_text("")
        with pytest.raises(FileNotFoundError, match=r"expected a folder with the results .* got a file"):
            read_result(tmp_path / "file")

    def test_no_results(self, tmp_path):
        with pytest.raises(FileNotFoundError, match=r"without summary\.json, contacts\.csv, spheres\.csv; write them"):
            read_result(tmp_path)

    @pytest.mark.parametrize(
        ("text", "message"),
        [
            ("{", "expected JSON"),
            ("[]", "expected an object with the names of results, got list"),
            ("{}", "expected the summary of stress or break, got one without aggregate"),
            ('{"outcome": "bond"}', "expected the summary of stress or break, got one without spheres"),
        ],
    )
    def test_summary(self, stressed, copied, text, message):
        folder = copied(stressed)
        (folder / "summary.json").write_text(text)
        with pytest.raises(rc.FileFormatError, match=message):
            read_result(folder)

    @pytest.mark.parametrize(
        ("old", "new", "message"),
        [
            ("tension_N", "pull_N", r"contacts\.csv: expected a column tension, got 'contact, i, j"),
            ("0,0,1,", "0,0,", r"contacts\.csv, line 2: expected \d+ cells, got \d+"),
            ("0,0,1,", "0,0,x,", r"contacts\.csv: expected numbers in the column j, got words"),
            ("0,0,1,", "0,0,inf,", r"contacts\.csv: expected finite numbers in the column j, got inf"),
            ("0,0,1,", "0,0,9,", r"contacts\.csv: expected spheres below 6, the number in spheres\.csv, got 9"),
        ],
    )
    def test_tables(self, stressed, copied, old, new, message):
        folder = copied(stressed)
        path = folder / "contacts.csv"
        path.write_text(path.read_text().replace(old, new, 1))
        with pytest.raises(rc.FileFormatError, match=message):
            read_result(folder)

    def test_results_without_loads(self, broken, copied):
        folder = copied(broken)
        (folder / "contacts.csv").unlink()
        with pytest.raises(FileNotFoundError, match=r"got a folder without contacts\.csv; write them with rheoclast"):
            read_result(folder)

    def test_fewer_keys(self, broken, copied):
        folder = copied(broken)
        told = json.loads((folder / "summary.json").read_text())
        del told["near_ties"]
        (folder / "summary.json").write_text(json.dumps(told))
        with pytest.raises(rc.FileFormatError, match="got one without near_ties; write it anew"):
            read_result(folder)

    def test_cascade_without_pieces(self, results, copied):
        cluster = rc.generation.straight_chain(4, radius=0.5e-6)
        folder = copied(results("break", cluster, "--flow", "biaxial", "--rate", 1e9, "--cascade"))
        assert len(read_result(folder).pieces["parent"]) == 7
        (folder / "pieces.csv").unlink()
        with pytest.raises(FileNotFoundError, match=r"pieces\.csv: there is no such file"):
            read_result(folder)
