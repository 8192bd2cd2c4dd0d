"""What holds for files of every format: units, radii, tolerances and files that are none."""

import numpy as np
import pytest

from rheoclast import FileFormatError, GeometryError, GeometryWarning, UnitWarning
from rheoclast.io import read, read_spheres

TWO = "0 0 0 1\n2 0 0 1\n"
POSITIONS = "0 0 0\n2 0 0\n"


@pytest.mark.parametrize(
    ("unit", "metres"),
    [
        ("nm", 1e-9),
        ("um", 1e-6),
        ("\u00b5m", 1e-6),
        ("\u03bcm", 1e-6),
        ("angstrom", 1e-10),
        ("\u00c5", 1e-10),
        (2e-7, 2e-7),
    ],
)
def test_unit_scales_positions_and_radii(unit, metres, file):
    spheres = read_spheres(file("two.txt", TWO), unit)
    np.testing.assert_allclose(spheres.centers, [[0, 0, 0], [2 * metres, 0, 0]], rtol=1e-15)
    np.testing.assert_allclose(spheres.radii, [metres, metres], rtol=1e-15)


@pytest.mark.parametrize("unit", ["m", "cm"])
def test_radii_above_a_millimetre_warn_of_the_unit(unit, file):
    with pytest.warns(UnitWarning, match="exceed 1 mm: is the unit of length right"):
        read(file("two.txt", TWO), unit)


def test_dimensionless_lengths_do_not_warn(file):
    assert read(file("two.txt", TWO), "dimensionless").spheres.radii.tolist() == [1, 1]


def test_a_millimetre_does_not_warn(file):
    read(file("two.txt", TWO), "mm")


@pytest.mark.parametrize(
    ("unit", "message"),
    [
        ("inch", "unit: expected one of m, cm, mm, um, nm, angstrom, dimensionless, or .* number, got 'inch'"),
        (-1.0, "unit: expected a positive number, got -1"),
    ],
)
def test_unknown_unit(unit, message, file):
    with pytest.raises(ValueError, match=message):
        read(file("two.txt", TWO), unit)


def test_radius_in_the_unit_of_the_file(file):
    floc = read(file("two.txt", POSITIONS), "nm", radius=1)
    np.testing.assert_allclose(floc.spheres.radii, 1e-9)
    assert floc.pairs.tolist() == [[0, 1]]


def test_no_radius_at_all(file):
    with pytest.raises(FileFormatError, match=r"two.txt: expected a radius .*, got only positions; pass radius="):
        read(file("two.txt", POSITIONS))


def test_radius_twice(file):
    with pytest.raises(FileFormatError, match=r"two.txt: expected no radius=, because the file has radii, got 2.0"):
        read(file("two.txt", TWO), radius=2.0)


def test_radius_argument_not_positive(file):
    with pytest.raises(ValueError, match="radius: expected a positive number, got 0"):
        read(file("two.txt", POSITIONS), radius=0)


@pytest.mark.parametrize("radius", ["0", "-2.5"])
def test_radius_in_file_not_positive(radius, file):
    path = file("two.txt", f"# spheres\n0 0 0 1\n\n2 0 0 {radius}\n")
    with pytest.raises(
        FileFormatError, match=rf"two.txt, line 4: expected a positive radius, got {radius} for sphere 1"
    ):
        read(path)


def test_tolerances_reach_the_geometry(file):
    path = file("two.txt", "0 0 0 1\n2.05 0 0 1\n")
    with pytest.raises(GeometryError, match=r"two.txt: the aggregate is in 2 parts"):
        read(path, "nm")
    assert len(read(path, "nm", tolerance=0.06).pairs) == 1
    assert len(read_spheres(path, "nm")) == 2
    path = file("three.txt", "0 0 0 1\n1.95 0 0 1\n")
    with pytest.raises(GeometryError, match=r"three.txt: spheres 0 and 1 overlap"):
        read(path, "nm")
    assert len(read(path, "nm", overlap_tolerance=0.06).pairs) == 1


def test_a_wide_gap_in_a_contact_that_is_given_warns(file):
    """Contacts counted from 1, the usual slip, join spheres that are far apart."""
    spheres = file("chain.csv", "x,y,z,radius\n0,0,0,1\n2,0,0,1\n4,0,0,1\n6,0,0,1\n")
    contacts = file("contacts.csv", "i,j\n0,1\n1,2\n1,3\n")
    message = r"contacts.csv: contact 2 joins spheres 1 and 3 across a gap of 2 mean radii; are spheres counted from 0"
    with pytest.warns(GeometryWarning, match=message):
        read(spheres, "um", contacts=contacts)
    with pytest.warns(
        GeometryWarning, match=r"contact 1 joins .* gap of 2 .* \(and 2 more\); is the tolerance of 5 me"
    ):
        read(spheres, "um", tolerance=5.0)


def test_a_gap_of_bad_resolution_does_not_warn(file):
    assert read(file("two.txt", "0 0 0 1\n2.4 0 0 1\n"), "um", tolerance=0.45).gaps == pytest.approx(0.4)


def test_a_decimal_comma_is_told(file):
    with pytest.raises(
        FileFormatError, match=r"line 2: expected a number, got '2,5'; write decimal points, not commas"
    ):
        read(file("two.csv", "x;y;z;radius\n2,5;0;0;1\n"))


def test_missing_file(tmp_path):
    with pytest.raises(
        FileNotFoundError, match=r"gone.dat: there is no such file; check its name and the current folder"
    ):
        read(tmp_path / "gone.dat")


def test_folder(tmp_path):
    with pytest.raises(FileFormatError, match="expected a file, got a folder; name a file in it"):
        read(tmp_path)


@pytest.mark.parametrize("suffix", ["txt", "csv", "xyz", "dump", "data", "dat"])
@pytest.mark.parametrize("content", ["", "\n \n\n"])
def test_empty_file(suffix, content, file):
    with pytest.raises(FileFormatError, match=rf"empty.{suffix}: expected rows of numbers, got an empty file"):
        read(file(f"empty.{suffix}", content))


@pytest.mark.parametrize("suffix", ["txt", "csv", "xyz", "dump", "data", "gz"])
def test_binary_garbage(suffix, file):
    garbage = np.random.default_rng(0).bytes(3000)
    with pytest.raises(
        FileFormatError, match=rf"junk.{suffix}: expected a text file, got binary data \(character '.*' at"
    ):
        read(file(f"junk.{suffix}", garbage))


def test_utf16_is_refused_by_name(file):
    with pytest.raises(FileFormatError, match="expected text in UTF-8, got UTF-16; save it as UTF-8"):
        read(file("two.txt", TWO.encode("utf-16")))


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "latin-1"])
@pytest.mark.parametrize("line_end", ["\n", "\r\n", "\r"])
def test_encodings_and_line_ends(encoding, line_end, file):
    text = "x (\u00b5m),y (\u00b5m),z (\u00b5m),r (\u00b5m)\n0,0,0,1\n0,2,0,1\n".replace("\n", line_end)
    floc = read(file("two.csv", text.encode(encoding)), "um")
    np.testing.assert_allclose(floc.spheres.centers[1], [0, 2e-6, 0])


@pytest.mark.parametrize("name", ["two.csv", "two.txt"])
def test_a_unit_that_contradicts_the_column_names(name, file):
    path = file(name, "x_nm,y_nm,z_nm,r_nm\n0,0,0,1\n0,2,0,1\n")
    with pytest.raises(FileFormatError, match=rf"{name}: expected lengths in m, got columns in nm .*; pass unit='nm'"):
        read(path)
    with pytest.raises(FileFormatError, match=r"expected lengths in 1e-06 m, got columns in nm"):
        read(path, 1e-6)
    assert read(path, "dimensionless").spheres.radii[0] == 1
    assert len(read(path, 1e-9)) == 2


def test_columns_in_different_units_are_refused(file):
    with pytest.raises(FileFormatError, match="expected lengths in nm, got columns in um"):
        read(file("two.csv", "x_nm,y_nm,z_nm,d_um\n0,0,0,1\n0,2,0,1\n"), "nm")
