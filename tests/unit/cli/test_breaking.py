"""`rheoclast break` as a user meets it: real files in, tables, fragments and pictures out."""

import csv
import json
import re
import shlex

import numpy as np
import pytest

import rheoclast as rc
from rheoclast.cli import main


@pytest.fixture
def run(capsys, tmp_path, monkeypatch):
    """Run the command line in an empty folder; returns exit status, standard output and standard error."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "120")

    def run(*arguments):
        with pytest.raises(SystemExit) as stop:
            main([str(argument) for argument in arguments])
        return (stop.value.code or 0, *capsys.readouterr())

    return run


@pytest.fixture
def compact(tmp_path):
    """File of a cluster of thirty spheres of half a micrometre with loops."""
    aggregate = rc.generation.compacted_cluster(30, radius=0.5e-6, amount=0.4, seed=1)
    rc.write(tmp_path / "floc.dat", aggregate)
    return tmp_path / "floc.dat"


def rows(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def setting(path):
    aggregate = rc.read(path)
    response = rc.rigid_response(aggregate.spheres, rc.StokesianDynamics(), viscosity=1e-3)
    return aggregate, response, rc.jkr_bonds(aggregate, rc.MATERIALS["polystyrene"])


def test_agrees_with_the_library(run, compact, tmp_path):
    status, out, err = run("break", compact, "--flow", "uniaxial", "--output", "out", "--json")
    assert (status, err) == (0, "")
    report = json.loads(out)
    expected = rc.break_up(*setting(compact), rc.uniaxial_extension(1.0))
    assert report["breakup_rate_per_s"] == pytest.approx(expected.breakup_rate, rel=1e-9)
    assert report["initiation_rate_per_s"] == pytest.approx(expected.initiation_rate, rel=1e-9)
    assert report["fragments"] == [len(each) for each in expected.fragments]
    assert report["near_ties"] == len(expected.near_ties())
    written = rows(tmp_path / "out" / "failures.csv")
    assert [int(row["contact"]) for row in written] == [failure.contact for failure in expected.failures]
    assert [float(row["rate_per_s"]) for row in written] == [failure.rate for failure in expected.failures]
    assert sum(int(row["on_surface"]) for row in written) == report["surface"] == len(expected.surface)


def test_fragments_can_be_read_back(run, compact, tmp_path):
    """With the contacts that are left, which are fewer than those that touch."""
    run("break", compact, "--flow", "uniaxial", "--output", "out")
    expected = rc.break_up(*setting(compact), rc.uniaxial_extension(1.0))
    fewer = 0
    for k, fragment in enumerate(expected.fragments):
        name = tmp_path / "out" / f"fragment_{k + 1}"
        found = rc.read(f"{name}.dat", contacts=f"{name}_contacts.csv")
        np.testing.assert_allclose(found.spheres.centers, fragment.spheres.centers, rtol=0, atol=1e-20)
        np.testing.assert_array_equal(found.pairs, fragment.pairs)
        fewer += len(rc.Aggregate.touching(found.spheres).pairs) - len(found.pairs)
    assert fewer > 0
    assert [int(row["spheres"]) for row in rows(tmp_path / "out" / "fragments.csv")] == [
        len(each) for each in expected.fragments
    ]


def test_pictures(run, compact, tmp_path):
    from PIL import Image

    assert run("break", compact, "--output", "out", "--animation")[0] == 0
    with Image.open(tmp_path / "out" / "crack.png") as picture:
        assert min(picture.size) > 300
        assert len(set(picture.convert("L").resize((64, 64)).tobytes())) > 10
    with Image.open(tmp_path / "out" / "crack.gif") as film:
        assert film.n_frames > 2


def test_screen(run, compact):
    status, out, _ = run("break", compact)
    assert status == 0
    expected = rc.break_up(*setting(compact), rc.simple_shear(1.0))
    assert f"breaks by a crack of {len(expected.failures)} failures" in out
    assert f"{expected.breakup_rate:.4g} 1/s" in out
    first = expected.failures[0]
    assert f"{first.pair[0]}–{first.pair[1]}" in out


@pytest.mark.parametrize("orientation", ["worst", "orbit", "random"])
def test_orientation(run, compact, orientation):
    given = json.loads(run("break", compact, "--json")[1])
    seed = ["--seed", 3] if orientation == "random" else []
    turned = json.loads(run("break", compact, "--orientation", orientation, *seed, "--json")[1])
    gradient = np.array(turned["flow_gradient_per_s"])
    np.testing.assert_allclose(np.linalg.norm(gradient), 1, rtol=1e-9)
    assert turned["initiation_rate_per_s"] != given["initiation_rate_per_s"]
    if orientation != "random":
        assert turned["initiation_rate_per_s"] < given["initiation_rate_per_s"]
    if orientation == "worst":
        aggregate, response, bonds = setting(compact)
        table = rc.contact_response(aggregate, response, bonds)
        worst = rc.worst_initiation(table, bonds, rc.simple_shear(1.0)).rate
        assert turned["initiation_rate_per_s"] == pytest.approx(worst, rel=1e-9)


def test_cascade(run, compact, tmp_path):
    rate = 4 * json.loads(run("break", compact, "--json")[1])["breakup_rate_per_s"]
    _, out, _ = run("break", compact, "--rate", rate, "--cascade", "--json", "--output", "out")
    expected = rc.cascade(*setting(compact), rc.simple_shear(rate))
    assert json.loads(out)["cascade"]["sizes"] == expected.sizes.tolist()
    pieces = rows(tmp_path / "out" / "pieces.csv")
    assert [int(row["parent"]) for row in pieces] == expected.table()["parent"].tolist()
    assert len(list((tmp_path / "out").glob("fragment_*.dat"))) == len(expected.remaining)


@pytest.mark.parametrize("cascade", [[], ["--cascade"]])
def test_fragments_have_the_same_numbers_in_all_files(run, compact, tmp_path, cascade):
    rate = 4 * json.loads(run("break", compact, "--json")[1])["breakup_rate_per_s"]
    report = json.loads(run("break", compact, "--rate", rate, *cascade, "--json", "--output", "out")[1])
    spheres, fragments = rows(tmp_path / "out" / "spheres.csv"), rows(tmp_path / "out" / "fragments.csv")
    assert [int(row["spheres"]) for row in fragments] == (
        report["cascade"]["sizes"] if cascade else report["fragments"]
    )
    assert len(fragments) > (2 if cascade else 1)
    digits = len(str(len(fragments)))
    for fragment in fragments:
        own = [row for row in spheres if row["fragment"] == fragment["fragment"]]
        assert len(own) == int(fragment["spheres"])
        alone = rc.read_spheres(tmp_path / "out" / f"fragment_{int(fragment['fragment']):0{digits}d}.dat")
        places = [[float(row[f"{axis}_m"]) for axis in "xyz"] for row in own]
        np.testing.assert_allclose(sorted(places), sorted(alone.centers.tolist()), rtol=0, atol=1e-20)
    first = [row.get("first_fragment", row["fragment"]) for row in spheres]
    assert [first.count(str(k + 1)) for k in range(len(report["fragments"]))] == report["fragments"]
    assert ("first_fragment" in spheres[0]) == bool(cascade)


def test_summary_tells_what_the_contacts_were_and_how_to_repeat(run, compact):
    numbers = ["--friction", 0.3, "--rolling-distance", 1e-9, "--work-of-adhesion", 0.03, "--up-to", 1e9]
    out = run("break", compact, *numbers, "--orientation", "random", "--seed", 5, "--json")[1]
    report = json.loads(out)
    aggregate, polystyrene = rc.read(compact), rc.MATERIALS["polystyrene"]
    law = rc.JKR(rc.Material(polystyrene.youngs_modulus, polystyrene.poisson_ratio, 0.03), 0.3, 1e-9)
    strength = law.bonds(aggregate).tensile_strength
    told = report["contact_law"]
    assert told.pop("pull_off_N") == pytest.approx([strength.min(), strength.max()])
    assert told == {
        "law": "jkr",
        "material": "polystyrene",
        "youngs_modulus_Pa": polystyrene.youngs_modulus,
        "poisson_ratio": polystyrene.poisson_ratio,
        "work_of_adhesion_J_m2": 0.03,
        "pull_off_given": False,
        "stiffness": None,
        "friction": 0.3,
        "rolling_distance_m": 1e-9,
    }
    assert (report["seed"], report["up_to_per_s"], report["flow_name"]) == (5, 1e9, "shear")
    assert report["initiation_rate_error"] is None or report["initiation_rate_error"] > 0
    program, *words = shlex.split(report["command"])
    assert program == "rheoclast"
    assert run(*words)[1] == out


def test_explicit_stiffness_has_no_material(run, compact):
    law = ["--stiffness", 1, 2, 3e-13, 4e-13, "--pull-off", 1e-9]
    told = json.loads(run("break", compact, *law, "--json")[1])["contact_law"]
    assert (told["law"], told["material"], told["youngs_modulus_Pa"]) == (None, None, None)
    assert told["stiffness"] == [1, 2, 3e-13, 4e-13]
    assert told["pull_off_N"] == pytest.approx([1e-9, 1e-9])
    assert "explicit stiffness" in run("break", compact, *law)[1]


def test_screen_tells_what_was_computed(run, compact):
    out = run("break", compact, "--flow", "planar", "--pull-off", 1e-8, "--order", 3, "--viscosity", 2e-3)[1]
    found = {row[0]: row[1] for row in re.findall(r"│ ([a-z][a-z -]+?) +│ (.+?) +│", out)}
    assert found["model"] == "StokesianDynamics, order 3"
    assert found["viscosity"] == "0.002 Pa s"
    assert found["flow"] == "planar, made faster from rest"
    assert found["contacts"] == "polystyrene, law jkr"
    assert found["pull-off force"] == "10.0 nN, as given"
    report = run("break", compact, "--flow", "planar", "--pull-off", 1e-8, "--order", 3, "--viscosity", 2e-3, "--json")
    error = json.loads(report[1])["initiation_rate_error"]
    assert found["initiation rate"].endswith(f"1/s, ± {error:.1%} from the multipole order")


def test_cascade_of_a_given_orientation_is_no_measure_of_strength(run, compact):
    arguments = ["--rate", 1e9, "--cascade"]
    warned = "what holds may only lie well; for what holds in the end take --orientation worst or orbit"
    assert warned in run("break", compact, *arguments)[1]
    assert warned not in run("break", compact, *arguments, "--orientation", "worst")[1]


def test_without_units_nothing_has_one(run, tmp_path):
    (tmp_path / "chain.dat").write_text("0 0 0 1\n2 0 0 1\n4 0 0 1\n4 2 0 1\n")
    given = ["--unit", "dimensionless", "--viscosity", 1, "--pull-off", 1, "--rate", 1, "--cascade", "--output", "out"]
    status, out, err = run("break", "chain.dat", *given)
    assert (status, err) == (0, "")
    assert not re.search(r"\d (a|f|p|n|µ|m)?(m|N|Pa|1/s|s)\b", out)
    for path in (tmp_path / "out").glob("*.csv"):
        assert not re.search(r"_(m|N|Nm|per_s)\b", path.read_text().splitlines()[0]), path


def test_fewer_fragments_leave_none_of_an_earlier_run(run, compact, tmp_path):
    rate = 4 * json.loads(run("break", compact, "--json")[1])["breakup_rate_per_s"]
    run("break", compact, "--rate", rate, "--cascade", "--output", "out")
    status, _, err = run("break", compact, "--output", "out")
    assert status == 1
    assert "already there; add --overwrite to replace" in err
    assert run("break", compact, "--output", "out", "--overwrite")[0] == 0
    assert not (tmp_path / "out" / "pieces.csv").exists()
    assert len(list((tmp_path / "out").glob("fragment_*.dat"))) == 2


def test_criteria(run, compact):
    arguments = ["--friction", 0.3, "--rolling-distance", 1e-9]
    by = {
        name: json.loads(run("break", compact, *arguments, "--criterion", name, "--json")[1])["initiation_rate_per_s"]
        for name in ("every-limit", "tension", "sliding", "rolling", "twisting", "combined")
    }
    single = [by[name] for name in ("tension", "sliding", "rolling", "twisting")]
    assert by["every-limit"] == pytest.approx(min(single), rel=1e-12)
    assert by["combined"] < min(single)


def test_compression_only(run, tmp_path):
    (tmp_path / "doublet.dat").write_text("0 0 0 1\n2 0 0 1\n")
    status, out, _ = run("break", "doublet.dat", "--unit", "um", "--flow", "uniaxial", "--output", "out")
    assert status == 0
    assert "stays whole: no contact is pulled apart" in out
    assert (tmp_path / "out" / "crack.png").exists()
    assert not (tmp_path / "out" / "failures.csv").exists()


def test_files_of_others_stay(run, compact, tmp_path):
    run("break", compact, "--output", "out")
    (tmp_path / "out" / "fragment_notes.txt").write_text("mine")
    assert run("break", compact, "--output", "out", "--overwrite")[0] == 0
    assert (tmp_path / "out" / "fragment_notes.txt").read_text() == "mine"


def test_film_without_a_folder(run, compact):
    assert (
        "--animation: has no effect without --output; leave it out, or add --output"
        in run("break", compact, "--animation")[2]
    )


def test_up_to(run, compact):
    report = json.loads(run("break", compact, "--json")[1])
    below = 0.5 * (report["initiation_rate_per_s"] + report["breakup_rate_per_s"])
    held = json.loads(run("break", compact, "--up-to", below, "--json")[1])
    assert held["outcome"] == "whole"
    assert held["breakup_rate_per_s"] is None
    assert 0 < held["failures"] < report["failures"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--cascade"], "--cascade: fragments break at the rate of the flow; add --rate or --gradient"),
        (["--gradient", "0 -1 0 1 0 0 0 0 0"], "flow: expected a strain rate that is not zero, got none"),
        (
            ["--criterion", "rolling"],
            "--criterion: 'rolling' never fails 'polystyrene', whose contacts have no limit for it; "
            "add --rolling-distance",
        ),
        (["--criterion", "twisting"], "whose contacts have no limit for it; add --friction"),
        (
            ["--stiffness", 1, 1, 1, 1, "--pull-off", 1, "--friction", 1],
            "--friction: explicit stiffness does not take this; leave one of them out",
        ),
        (["--criterion", "taste"], "--criterion: expected one of every-limit, tension, "),
        (["--up-to", "-1"], "--up-to: expected a positive number, got -1"),
        (["--friction", "-1"], "--friction: expected a positive number, got -1"),
    ],
)
def test_refusals(run, compact, tmp_path, arguments, message):
    status, out, err = run("break", compact, *arguments, "--output", "out")
    assert (status, out) == (1, "")
    assert err.count("\n") == 1
    assert message in err
    assert not (tmp_path / "out").exists()
