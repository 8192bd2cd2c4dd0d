import subprocess
import sys

import extxyz
import numpy as np
import pytest

from rheoclast import FileFormatError
from rheoclast.io import read, read_spheres, write

OVITO = """\
3
Lattice="9.0 0.0 0.0 0.0 9.0 0.0 0.0 0.0 9.0" Properties=species:S:1:pos:R:3:id:I:1:Radius:R:1 pbc="F F F" Timestep=0
type1 1.0 1.0 1.0 1 0.5
type1 2.0 1.0 1.0 2 0.5
type2 3.25 1.0 1.0 3 0.75
"""


def test_extended_xyz_as_ovito_writes_it(file):
    floc = read(file("ovito.xyz", OVITO), "um")
    np.testing.assert_allclose(floc.spheres.radii, [5e-7, 5e-7, 7.5e-7])
    np.testing.assert_allclose(floc.spheres.centers[2], [3.25e-6, 1e-6, 1e-6])
    assert floc.pairs.tolist() == [[0, 1], [1, 2]]


@pytest.mark.parametrize(
    ("comment", "row"),
    [
        ("Properties=pos:R:3:radius:R:1", "2 0 0 1"),
        ('Properties="pos:R:3:radius:R:1" note="a b"', "2 0 0 1"),
        ("it's \"unbalanced Properties=pos:R:3:radius:R:1", "2 0 0 1"),
        ("Properties=radius:R:1:pos:R:3", "1 2 0 0"),
        ("Properties=c_1[1]:R:1:pos:R:3:velo.x:R:1:σ:R:1:radius:R:1", ".1 2 0 0 .2 .3 1"),
        ('Properties="a b:R:1:pos:R:3:radius:R:1"', ".1 2 0 0 1"),
        ("Properties=pos:R:3:diameter:R:1", "2 0 0 2"),
        ("Properties=pos:I:3:velo:R:3:radius:I:1", "2 0 0 .1 .2 .3 1"),
        ("", "Ag 2 0 0 1"),
        ('Properties=""', "Ag 2 0 0 1"),
        ("silver, sintered", "Ag 2.0 0 0 1.0"),
    ],
)
def test_columns_of_one_sphere(comment, row, file):
    spheres = read_spheres(file("one.xyz", f"1\n{comment}\n{row}\n"), "nm")
    np.testing.assert_allclose(spheres.centers, [[2e-9, 0, 0]])
    np.testing.assert_allclose(spheres.radii, [1e-9])


def test_plain_xyz_needs_a_radius(file):
    path = file("two.xyz", "2\nsilica\nSi 0 0 0\nSi 2 0 0\n")
    with pytest.raises(FileFormatError, match="expected a radius of every sphere, got only positions; pass radius="):
        read(path, "nm")
    np.testing.assert_allclose(read(path, "nm", radius=1.0).spheres.radii, 1e-9)


@pytest.mark.parametrize("end", ["", "\n", "\n\n \n"])
@pytest.mark.parametrize("line_end", ["\n", "\r\n"])
def test_the_last_frame_is_read(end, line_end, file):
    text = "1\n\nA 0 0 0 9\n2\n\nA 0 0 0 1\nA 2 0 0 1" + end
    assert len(read(file("run.xyz", text.replace("\n", line_end)), "nm")) == 2


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("two\n\nA 0 0 0 1\n", "line 1: expected the number of spheres of a frame as a whole number, got 'two'"),
        ("0\n\n", "line 1: expected at least one sphere, got a frame of 0"),
        ("3\n", "expected 3 spheres, as line 1 states, got 0 rows; the file is truncated"),
        ("3\n\nA 0 0 0 1\nA 2 0 0 1\n", "expected 3 spheres, as line 1 states, got 2 rows; the file is truncated"),
        ("1\n\nA 0 0 0 1\n2\n\nA 0 0 0 1\n", "expected 2 spheres, as line 4 states, got 1 rows; the file is truncated"),
        ("1\n\nA 0 0 0 1\nA 2 0 0 1\n", "line 4: expected the number of spheres .*, got 'A 2 0 0 1'"),
        (
            "1\n\nA 0 0 0 1 5\n",
            r"line 3: expected species x y z \[r\], got 6 columns; name other columns by Properties",
        ),
        ("2\n\nA 0 0 0 1\nA 2 0 0\n", r"line 4: expected 5 columns \(species.*\), got 4; is the file truncated"),
        ("3\n\nA 0 0 0 1\n\nA 2 0 0 1\n", r"line 4: expected 5 columns \(species.*\), got 0; is the file truncated"),
        ("2\n\nA 0 0 0 1\nA 2 zero 0 1\n", "line 4: expected a finite number for 'pos', got 'zero'"),
        ("2\n\nA 0 0 0 1\nA 2 nan 0 1\n", "line 4: expected a finite number for 'pos', got 'nan'"),
        ("2\n\nA 0 0 0 1\nA 2 0 0 inf\n", "line 4: expected a finite number for 'radius', got 'inf'"),
        ("2\n\nA 0 0 0 1\nA 2 0 0 0\n", "line 4: expected a positive radius, got 0 for sphere 1"),
        ("1\nProperties=species:S:1:xyz:R:3\nA 0 0 0\n", "line 2: expected a column pos:R:3 among the properties"),
        ("1\nProperties=pos:R:3:radius:S:1\n0 0 0 a\n", "line 2: expected one number per sphere as radius"),
        (
            "1\nProperties=pos:R:3:a:R:1:a:R:1\n0 0 0 1 1\n",
            "line 2: expected columns in the form .*, got 'pos:R:3:a:R:1:a",
        ),
        ("1\nProperties=pos:R\n0 0 0\n", "line 2: expected columns in the form name:type:number, got 'pos:R'"),
        ("1\nProperties=pos:Q:3\n0 0 0\n", "line 2: expected columns in the form name:type:number, got 'pos:Q:3'"),
    ],
)
def test_bad_input(text, message, file):
    with pytest.raises(FileFormatError, match=message):
        read(file("floc.xyz", text))


def test_written_for_ovito(aggregate, sphere_columns, tmp_path):
    write(tmp_path / "floc.xyz", aggregate, sphere_columns=sphere_columns)
    comment = (tmp_path / "floc.xyz").read_text().splitlines()[1]
    assert 'pbc="F F F"' in comment
    assert "Properties=species:S:1:pos:R:3:radius:R:1:force_N:R:3:depth:R:1" in comment
    frame = extxyz.read_dicts(str(tmp_path / "floc.xyz"))
    np.testing.assert_array_equal(frame.arrays["force_N"], sphere_columns["force_N"])
    np.testing.assert_array_equal(frame.arrays["depth"], sphere_columns["depth"])
    inside = frame.arrays["pos"] - frame.info["Origin"]
    assert np.all(inside > 0)
    assert np.all(inside < np.diag(frame.cell))


def test_numbers_that_the_format_cannot_hold(aggregate, tmp_path):
    (tmp_path / "floc.xyz").write_text("old")
    with pytest.raises(
        ValueError, match=r"sphere_columns\['v'\]: expected finite numbers.*got nan for sphere 2; leave"
    ):
        write(tmp_path / "floc.xyz", aggregate, sphere_columns={"v": [0, 1, np.nan, 2, 3]}, overwrite=True)
    assert [(path.name, path.read_text()) for path in tmp_path.iterdir()] == [("floc.xyz", "old")]


def test_the_library_is_imported_only_when_needed():
    code = "import sys, rheoclast.io; raise SystemExit('extxyz' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
