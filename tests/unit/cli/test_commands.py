"""The command line as a user meets it: real files in, files and one clear line out."""

import csv
import json
import os
import re
import subprocess
import sys
from pathlib import Path
from time import sleep

import numpy as np
import pytest
from rich.console import Console

import rheoclast as rc
from rheoclast.cli import main
from rheoclast.cli.console import progress_bar
from rheoclast.cli.results import FILES

CLUSTERS = Path(__file__).parents[3] / "examples" / "clusters"
EQUAL, POLYDISPERSE = CLUSTERS / "fracval_n300_df1.8.dat", CLUSTERS / "fracval_n200_df1.9_polydisperse.dat"

KINDS = ("unit", "name", "number", "9 numbers", "4 numbers", "integer", "file", "folder", "address", "bool")
"""What the values of options are called; bool stands at --help, which Typer writes itself."""


@pytest.fixture
def run(capsys):
    """Run the command line; returns exit status, standard output and standard error."""

    def run(*arguments):
        with pytest.raises(SystemExit) as stop:
            main([str(argument) for argument in arguments])
        return (stop.value.code or 0, *capsys.readouterr())

    return run


@pytest.fixture
def small(tmp_path):
    """File of a bent chain of four spheres, in micrometres."""
    path = tmp_path / "chain.dat"
    path.write_text("0 0 0 1\n2 0 0 1\n4 0 0 1\n4 2 0 1\n")
    return path


def rows(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


class TestStress:
    @pytest.mark.parametrize(("file", "spheres"), [(EQUAL, 300), (POLYDISPERSE, 200)])
    def test_reports_a_tree_of_another_code(self, run, file, spheres):
        status, out, err = run("stress", file, "--unit", "nm", "--rate", 1e5, "--material", "polystyrene", "--json")
        report = json.loads(out)
        assert (status, err) == (0, "")
        assert report["aggregate"]["spheres"] == spheres
        assert report["aggregate"]["contacts"] == spheres - 1
        assert report["aggregate"]["hyperstaticity"] == 0
        given, worst = report["given_orientation"], report["worst_orientation"]
        assert 0 < worst["initiation_rate"] <= given["initiation_rate"]

    def test_agrees_with_the_library(self, run):
        _, out, _ = run("stress", POLYDISPERSE, "--unit", "nm", "--flow", "uniaxial", "--rate", 1e5, "--json")
        report = json.loads(out)
        floc = rc.read(POLYDISPERSE, "nm")
        bonds = rc.jkr_bonds(floc, rc.MATERIALS["polystyrene"])
        response = rc.rigid_response(floc.spheres, rc.StokesianDynamics(), viscosity=1e-3)
        flow = rc.uniaxial_extension(1e5)
        carried = rc.contact_loads(floc, response.loads(flow), bonds)
        assert report["largest"]["tension"] == pytest.approx(carried.tension.max(), rel=1e-9)
        ratio = (carried.tension / bonds.tensile_strength).max()
        assert report["given_orientation"]["initiation_rate"] == pytest.approx(1e5 / ratio, rel=1e-9)

    def test_the_failing_contact_reaches_its_strength_at_the_critical_rate(self, run, small):
        _, out, _ = run("stress", small, "--unit", "um", "--rate", 10, "--json")
        for orientation in ("given_orientation", "worst_orientation"):
            failure = json.loads(out)[orientation]
            arguments = ["--gradient", " ".join(map(str, np.ravel(failure["flow_gradient_per_s"])))]
            _, again, _ = run("stress", small, "--unit", "um", *arguments, "--json")
            at_failure = json.loads(again)
            assert at_failure["largest"]["tension"] == pytest.approx(failure["pull_off_force"], rel=1e-9)

    def test_writes_every_result(self, run, small, tmp_path):
        folder = tmp_path / "results"
        status, out, _ = run("stress", small, "--unit", "um", "--rate", 10, "--output", folder)
        assert status == 0
        assert sorted(path.name for path in folder.iterdir()) == sorted(FILES)
        assert all(name in out for name in FILES)
        assert [row["i"] + row["j"] for row in rows(folder / "contacts.csv")] == ["01", "12", "23"]
        assert (folder / "aggregate.png").read_bytes().startswith(b"\x89PNG")

    @pytest.mark.parametrize("name", ["spheres.csv", "aggregate.xyz"])
    def test_written_spheres_can_be_analysed_again(self, run, small, tmp_path, name):
        run("stress", small, "--unit", "um", "--output", tmp_path / "results")
        _, first, _ = run("stress", small, "--unit", "um", "--json")
        _, second, _ = run("stress", tmp_path / "results" / name, "--json")
        assert json.loads(first)["largest"]["tension"] == pytest.approx(
            json.loads(second)["largest"]["tension"], rel=1e-9
        )

    def test_sphere_table_balances(self, run, small, tmp_path):
        run("stress", small, "--unit", "um", "--rate", 10, "--output", tmp_path / "results")
        force = np.array(
            [[float(row[f"force_N_{k}"]) for k in "xyz"] for row in rows(tmp_path / "results/spheres.csv")]
        )
        np.testing.assert_allclose(force.sum(axis=0), 0, atol=1e-12 * np.abs(force).max())

    def test_dimensionless_results_do_not_depend_on_units(self, run, small):
        one = run("stress", small, "--unit", "um", "--rate", 10, "--dimensionless", "--json")[1]
        two = run("stress", small, "--unit", "nm", "--rate", 300, "--viscosity", 2, "--dimensionless", "--json")[1]
        one, two = json.loads(one), json.loads(two)
        for load in ("tension", "compression", "shear", "bending"):
            assert one["largest"][load] == pytest.approx(two["largest"][load], rel=1e-9)
        for orientation in ("given_orientation", "worst_orientation"):
            assert one[orientation]["initiation_rate"] == pytest.approx(two[orientation]["initiation_rate"], rel=1e-9)

    def test_dimensionless_doublet(self, run, tmp_path):
        """The tension of a doublet is 35.903916 μa² per axial strain rate, and e_nn is the extension rate along z."""
        path = tmp_path / "doublet.dat"
        path.write_text("0 0 0 3\n0 0 6 3\n")
        _, out, _ = run("stress", path, "--unit", "nm", "--flow", "uniaxial", "--rate", 7, "--dimensionless", "--json")
        report = json.loads(out)
        assert report["largest"]["tension"] == pytest.approx(35.903916, rel=1e-7)
        assert report["given_orientation"]["initiation_rate"] == pytest.approx(1 / 35.903916, rel=1e-7)

    def test_options_of_the_contacts(self, run, small):
        def critical(*arguments):
            return json.loads(run("stress", small, "--unit", "um", *arguments, "--json")[1])["given_orientation"]

        assert critical("--pull-off", 1e-9)["pull_off_force"] == pytest.approx(1e-9)
        assert critical("--work-of-adhesion", 0.04)["initiation_rate"] == pytest.approx(
            2 * critical()["initiation_rate"]
        )
        properties = ["--youngs-modulus", 3.4e9, "--poisson-ratio", 0.33, "--work-of-adhesion", 0.02]
        assert critical("--material", "mine", *properties) == critical("--material", "polystyrene")
        stiff = critical("--stiffness", 1, 1, 1e-13, 1e-13, "--pull-off", 1e-9)
        assert stiff["initiation_rate"] == pytest.approx(critical("--pull-off", 1e-9)["initiation_rate"])

    def test_scales_of_dimensionless_results(self, run, small):
        arguments = ["stress", small, "--unit", "um", "--rate", 20, "--viscosity", 2e-3, "--json"]
        scaled, si = (json.loads(run(*arguments, *more)[1]) for more in (["--dimensionless"], []))
        scales, strength = scaled["scales"], si["contact_law"]["pull_off_N"]
        assert si["scales"] == {}
        assert scaled["contact_law"] == si["contact_law"]
        assert scales == pytest.approx({"a_m": 1e-6, "G_per_s": 20, "F_N": strength[0]})
        drag = 2e-3 * 20 * scales["a_m"] ** 2
        assert scaled["largest"]["tension"] * drag == pytest.approx(si["largest"]["tension"])
        unit = scales["F_N"] / (2e-3 * scales["a_m"] ** 2)
        rates = [each["worst_orientation"]["initiation_rate"] for each in (scaled, si)]
        assert rates[0] * unit == pytest.approx(rates[1])

    def test_without_units_nothing_has_one(self, run, small):
        given = ["--unit", "dimensionless", "--viscosity", 1, "--pull-off", 1]
        status, out, err = run("stress", small, *given)
        assert (status, err) == (0, "")
        assert not re.search(r"\d (a|f|p|n|µ|m)?(m|N|Pa|1/s|s)\b", out)
        report = json.loads(run("stress", small, *given, "--json")[1])
        assert set(report["units"].values()) == {""}

    def test_numbers_have_three_digits_and_no_rounding_noise(self, run, small):
        """The chain lies in a plane, which nothing twists; what bends it is below the smallest prefix."""
        out = run("stress", small, "--unit", "um")[1]
        assert re.search(r"mean sphere radius +│ 1\.00 µm", out)
        assert re.search(r"largest twisting +│ 0 N m", out)
        assert re.search(r"largest bending +│ 4\.18e−20 N m", out)
        assert "shape anisotropy" in out

    def test_a_title_is_not_wrapped(self, run, small, monkeypatch):
        monkeypatch.setenv("COLUMNS", "40")
        long = small.with_name("a_name_that_is_longer_than_the_table_that_stands_below_it.dat")
        small.rename(long)
        assert str(long) in run("stress", long, "--unit", "um")[1].splitlines()

    def test_smallest_and_largest_pull_off_force(self, run, tmp_path):
        """They go with the reduced radius: 1/2 and 1/3 of a micrometre here."""
        path = tmp_path / "three.dat"
        path.write_text("0 0 0 1\n2 0 0 1\n3.5 0 0 0.5\n")
        told = json.loads(run("stress", path, "--unit", "um", "--json")[1])["contact_law"]["pull_off_N"]
        assert told == pytest.approx([1.5 * np.pi * 0.02 * radius for radius in (1e-6 / 3, 0.5e-6)])
        assert "31.4 nN to 47.1 nN" in run("stress", path, "--unit", "um")[1]

    def test_free_draining(self, run, small):
        _, out, _ = run("stress", small, "--unit", "um", "--model", "free-draining", "--json")
        assert json.loads(out)["model"] == {"name": "FreeDraining", "order": None, "viscosity_Pa_s": 1e-3}

    def test_error_bars(self, run, small, tmp_path):
        """The columns are the library's estimate, and the critical rate errs by the share its tension does."""
        _, out, _ = run("stress", small, "--unit", "um", "--order", 3, "--json", "--output", tmp_path / "results")
        chain = rc.read(small, "um")
        table = rc.contact_response(chain, rc.rigid_response(chain.spheres, rc.StokesianDynamics(3), viscosity=1e-3))
        flow = rc.simple_shear(1.0)
        expected, tension = rc.truncation_error(table, flow), table.loads(flow).tension
        written = [float(row["tension_error_N"]) for row in rows(tmp_path / "results" / "contacts.csv")]
        np.testing.assert_allclose(written, expected.tension, rtol=1e-9)
        failure = json.loads(out)["given_orientation"]
        contact = failure["contact"]
        assert failure["initiation_rate_error"] == pytest.approx(expected.tension[contact] / tension[contact])

    def test_no_error_bars_without_lower_order(self, run, small):
        for arguments in (["--order", 1], ["--model", "free-draining"], ["--model", "exposed-area"]):
            _, out, _ = run("stress", small, "--unit", "um", *arguments, "--json")
            assert json.loads(out)["given_orientation"]["initiation_rate_error"] is None

    def test_automatic_order(self, run, small):
        orders = [
            json.loads(run("stress", small, "--unit", "um", "--order", "auto", "--accuracy", a, "--json")[1])["model"][
                "order"
            ]
            for a in (0.5, 0.02, 0.002)
        ]
        assert orders[0] == 2
        assert orders == sorted(set(orders))

    def test_compressed_doublet_does_not_fail(self, run, tmp_path):
        path = tmp_path / "doublet.dat"
        path.write_text("0 0 0 1\n2 0 0 1\n")
        status, out, _ = run("stress", path, "--unit", "um", "--flow", "uniaxial")
        assert status == 0
        assert "no contact is pulled apart" in out


class TestRefusals:
    @pytest.mark.parametrize(
        ("content", "message"),
        [
            ("0 0 0 1\n1.5 0 0 1\n", r"spheres 0 and 1 overlap: distance 1.5e-06 < 2e-06 = sum of radii; shrink"),
            ("0 0 0 1\n5 0 0 1\n", r"in 2 parts, expected one: sphere 0 .* gap of 3 mean radii; "),
            ("0 0 0 1\n", r"single sphere and has no contact; expected at least two"),
            ("0 0 0 1\nnan 0 0 1\n", r"line 2: expected a finite number, got 'nan'"),
            ("0 0 0 1\n2 0 0 0\n", r"line 2: .*positive.*0"),
            ("0 0 0 1\n0 0 0 1\n", r"spheres 0 and 1 are at the same place .*; remove the duplicate"),
            ("", r"empty file"),
            ("0 0 0 1\n2 0\n", r"line 2: expected 4 .*got 2"),
        ],
    )
    def test_bad_file(self, run, tmp_path, content, message):
        path, folder = tmp_path / "bad.dat", tmp_path / "results"
        path.write_text(content)
        status, out, err = run("stress", path, "--unit", "um", "--output", folder)
        assert (status, out) == (1, "")
        assert err.count("\n") == 1
        assert err.startswith("error: ")
        assert not folder.exists()
        assert re.search(message, err), err

    @pytest.mark.parametrize(
        ("arguments", "message"),
        [
            (["--gradient", "1 0 0 0 0 0 0 0 0"], "--gradient: expected zero trace (an incompressible flow), got 1"),
            (["--gradient", "1 2 3"], "--gradient: expected nine numbers, got 3"),
            (["--gradient", "a"], "--gradient: expected nine numbers, got 'a'"),
            (["--rate", "-1"], "--rate: expected zero or a positive number, got -1"),
            (["--viscosity", "0"], "--viscosity: expected a positive number, got 0"),
            (
                ["--material", "gold"],
                "--material: 'gold' is none of the known ones (polystyrene); give its --youngs-modulus,",
            ),
            (["--law", "oil"], "--law: expected one of jkr"),
            (["--model", "magic"], "--model: expected one of stokesian, "),
            (["--flow", "turbulent"], "--flow: expected one of shear, uniaxial, biaxial, planar, got 'turbulent'"),
            (["--order", "0"], "--order: expected an integer of at least 1, got 0"),
            (["--order", "two"], "--order: expected an integer of at least 1, or auto, got 'two'"),
            (["--stiffness", "1", "1", "1", "1"], "add --pull-off"),
            (["--pull-off", "-1"], "--pull-off: expected a positive number, got -1"),
            (["--unit", "parsec"], "parsec"),
            (["--rate", "0", "--dimensionless"], "--dimensionless: expected a positive rate to scale with, got 0"),
        ],
    )
    def test_bad_option(self, run, small, arguments, message):
        status, out, err = run("stress", small, "--unit", "um", *arguments)
        assert (status, out) == (1, "")
        assert err.count("\n") == 1
        assert message in err

    def test_missing_output_folder(self, run, small, tmp_path):
        status, _, err = run("stress", small, "--output", tmp_path / "missing" / "results")
        assert status == 1
        assert f"the folder {tmp_path / 'missing'} does not exist; create it first" in err

    def test_existing_output_is_kept(self, run, small, tmp_path):
        (tmp_path / "summary.json").write_text("mine")
        status, _, err = run("stress", small, "--unit", "um", "--output", tmp_path)
        assert status == 1
        assert "summary.json already there; add --overwrite to replace" in err
        assert (tmp_path / "summary.json").read_text() == "mine"
        assert run("stress", small, "--unit", "um", "--output", tmp_path, "--overwrite")[0] == 0
        assert json.loads((tmp_path / "summary.json").read_text())["aggregate"]["spheres"] == 4

    def test_output_that_is_a_file(self, run, small):
        status, _, err = run("stress", small, "--output", small)
        assert status == 1
        assert "expected a folder, got a file" in err

    @pytest.mark.parametrize("arguments", [["--rate", "fast"], ["--nonsense"]])
    def test_wrong_option(self, run, small, arguments):
        status, out, err = run("stress", small, *arguments)
        assert (status, out) == (2, "")
        assert err.count("\n") == 1
        assert err.startswith("error: ")

    def test_rate_of_a_gradient(self, run, small):
        status, _, err = run("stress", small, "--gradient", "0 1 0 0 0 0 0 0 0", "--rate", 2)
        assert status == 1
        assert "leave one of them out" in err

    def test_overflow(self, run, small, tmp_path):
        for arguments, message in (
            (["--rate", 1e308], "gradient: expected rates up to 1e+100 1/s, got 1e+308; check the unit"),
            (["--pull-off", 1e300], "got inf"),
            (["--viscosity", 1e305, "--rate", 1e90], "got inf"),
        ):
            status, out, err = run("stress", small, "--unit", "um", *arguments, "--output", tmp_path / "results")
            assert (status, out) == (1, "")
            assert message in err
            assert not (tmp_path / "results").exists()

    def test_folder_in_the_place_of_a_file(self, run, small, tmp_path):
        (tmp_path / "results" / "summary.json").mkdir(parents=True)
        status, _, err = run("stress", small, "--unit", "um", "--output", tmp_path / "results", "--overwrite")
        assert status == 1
        assert "summary.json there is a folder; choose another folder" in err
        assert [path.name for path in (tmp_path / "results").iterdir()] == ["summary.json"]

    def test_failure_while_writing_leaves_nothing(self, run, small, tmp_path, monkeypatch):
        def fail(*_, **__):
            raise OSError("disk full")

        monkeypatch.setattr("rheoclast.view.draw", fail)
        status, _, err = run("stress", small, "--unit", "um", "--output", tmp_path / "results")
        assert status == 1
        assert "disk full" in err
        assert [path.name for path in tmp_path.iterdir()] == [small.name]

    def test_names_with_brackets(self, run, small, tmp_path):
        odd = tmp_path / "q[b]x[bold]y.dat"
        odd.write_text(small.read_text())
        status, out, _ = run("info", odd, "--unit", "um")
        assert status == 0
        assert "q[b]x[bold]y.dat" in out.replace("\n", "")

    def test_screen_without_unicode(self, small):
        command = [sys.executable, "-m", "rheoclast", "stress", str(small), "--unit", "um"]
        done = subprocess.run(command, capture_output=True, env={**os.environ, "PYTHONIOENCODING": "ascii"}, check=True)
        assert b"initiation rate" in done.stdout

    def test_singular_frame(self, run, tmp_path):
        path = tmp_path / "triangle.dat"
        path.write_text("0 0 0 1\n2 0 0 1\n1 1.7320508 0 1\n")
        status, _, err = run("stress", path, "--unit", "um", "--stiffness", 1, 1, 1e-30, 1e30, "--pull-off", 1)
        assert status == 1
        assert err.count("\n") == 1
        assert "stiffness" in err

    def test_forgotten_unit_is_warned_of_once(self, run, small):
        status, _, err = run("stress", small)
        assert status == 0
        assert err.count("warning: ") == 1
        assert "radii up to 1 m exceed 1 mm: is the unit of length right?" in err

    def test_thick_liquid_is_warned_of(self, run, small):
        assert "viscosity 1e+04 Pa s exceeds 1000 Pa s" in run("stress", small, "--unit", "um", "--viscosity", 1e4)[2]

    def test_memory_is_told_beforehand(self, run, tmp_path):
        """At order 6 the blocks of 200 spheres take 4 (200 · 107)² bytes and the factor a quarter of that."""
        path = tmp_path / "chain.dat"
        path.write_text("".join(f"{2 * k} 0 0 1\n" for k in range(200)))
        _, _, err = run("info", path, "--unit", "um", "--order", 6)
        assert err.strip() == "200 spheres: up to 2.3 GB of memory"

    def test_debug_shows_the_traceback(self, small):
        with pytest.raises(ValueError, match="expected nine numbers"):
            main(["stress", str(small), "--gradient", "1", "--debug"])


class TestOtherCommands:
    def test_info(self, run):
        status, out, _ = run("info", EQUAL, "--unit", "nm", "--json")
        report = json.loads(out)
        assert status == 0
        # The generator's header gives Rg of point masses; the spheres' own 3/5 a² adds 0.07 %.
        assert report["radius_of_gyration"] == pytest.approx(
            np.hypot(10276.532895978327e-9, np.sqrt(0.6) * 500e-9), rel=2e-3
        )
        assert report["mean_coordination"] == pytest.approx(2 * 299 / 300)
        assert 0.5 < report["hydrodynamic_radius"] / report["radius_of_gyration"] < 1.3

    def test_info_on_one_sphere(self, run, tmp_path):
        path = tmp_path / "one.dat"
        path.write_text("1 2 3 0.5\n")
        status, out, _ = run("info", path, "--unit", "um", "--dimensionless", "--json")
        report = json.loads(out)
        assert status == 0
        assert "isostatic" not in run("info", path, "--unit", "um")[1]
        assert report["hydrodynamic_radius"] == pytest.approx(1)
        assert report["intrinsic_viscosity"] == pytest.approx(2.5)

    def test_info_on_screen(self, run):
        out = run("info", POLYDISPERSE, "--unit", "nm")[1]
        assert "isostatic (tree), hyperstaticity 0" in out
        assert "nm" in out

    def test_demo(self, run, tmp_path):
        status, out, _ = run("demo", "--output", tmp_path / "demo")
        assert status == 0
        assert (tmp_path / "demo" / "aggregate.png").exists()
        assert (tmp_path / "demo" / "report.html").exists()
        assert "rheoclast stress FILE" in out

    def test_version(self, run):
        assert run("--version")[1].strip() == f"rheoclast {rc.__version__}"

    @pytest.mark.parametrize("command", ["stress", "info", "break", "survey", "report", "demo", "generate"])
    def test_help_has_an_example(self, run, command):
        status, out, _ = run(command, "--help")
        assert status == 0
        assert f"rheoclast {command}" in out.split("Example:")[1]

    @pytest.mark.parametrize("command", [[], ["stress"], ["break"], ["generate", "lattice-block"]])
    def test_help_fits_a_narrow_screen(self, run, command, monkeypatch):
        """Nothing is cut off, and no kind of value is broken over two lines."""
        monkeypatch.setenv("COLUMNS", "80")
        lines = run(*command, "--help")[1].splitlines()
        assert len(lines) > 10
        assert all(len(line) <= 80 and "…" not in line for line in lines)
        assert all(line.count("<") == line.count(">") for line in lines)

    @pytest.mark.parametrize(
        "command",
        [
            "stress",
            "info",
            "break",
            "survey",
            "report",
            "demo",
            *(f"generate {name}" for name in rc.generation.FAMILIES),
        ],
    )
    def test_help_speaks_no_python(self, run, command):
        out = run(*command.split(), "--help")[1]
        kinds = re.findall(r"^│ +--[a-z-]+ (?: *-h)? *(<.+?>)", out, re.M)
        assert set(kinds) <= {f"<{kind}>" for kind in KINDS}
        assert not re.search(r"LATTICES|[a-z]_[a-z]|`", out)
        flags = [line for line in out.splitlines() if "<bool>" in line]
        assert {line.split()[1] for line in flags} <= {"--help"}
        assert out.count("─ Output ─") == (command != "survey")

    @pytest.mark.parametrize(
        ("words", "completed"),
        [("br", ["break"]), ("stress f.dat --flow u", ["uniaxial"]), ("break f.dat --rule w", ["weakest"])],
    )
    def test_shell_completes_commands_and_names(self, words, completed):
        asked = f"rheoclast {words}"
        asking = {"_RHEOCLAST_COMPLETE": "complete_bash", "COMP_WORDS": asked, "COMP_CWORD": str(len(words.split()))}
        command = [Path(sys.executable).parent / "rheoclast"]
        done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, **asking}, check=True)
        assert done.stdout.split() == completed

    def test_module_is_the_command(self, small):
        command = [sys.executable, "-m", "rheoclast", "stress", str(small), "--unit", "um", "--json"]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        assert json.loads(done.stdout)["aggregate"]["contacts"] == 3


class TestProgress:
    def test_silent_when_quick(self, capsys):
        with progress_bar() as progress:
            progress("pair mobilities", 0.5)
        assert capsys.readouterr() == ("", "")

    def test_speaks_when_long(self, capsys, monkeypatch):
        monkeypatch.setattr("rheoclast.cli.console.SECONDS_WITHOUT_PROGRESS", 0.05)
        monkeypatch.setattr("rheoclast.cli.console.messages", Console(stderr=True, force_terminal=True))
        with progress_bar() as progress:
            progress("pair mobilities", 0.5)
            sleep(0.5)
        captured = capsys.readouterr()
        assert "pair mobilities" in captured.err
        assert captured.out == ""

    def test_says_when_it_compiles(self, capsys, monkeypatch):
        from numba.core import event

        monkeypatch.setattr("rheoclast.cli.console.SECONDS_WITHOUT_PROGRESS", 0.01)
        monkeypatch.setattr("rheoclast.cli.console.messages", Console(stderr=True, force_terminal=True, width=120))
        with progress_bar() as progress:
            progress("pair mobilities", 0.5)
            sleep(0.3)
            event.start_event("numba:compile")
            sleep(0.3)
            event.end_event("numba:compile")
            sleep(0.3)
        told = capsys.readouterr().err
        assert "pair mobilities, compiling (only the first time)" in told
        assert re.search(r"pair mobilities (?!.*compiling)", told.rpartition("compiling")[2])
        event.start_event("numba:compile")
        event.end_event("numba:compile")
        assert capsys.readouterr().err == ""
