import numpy as np
import pytest

from rheoclast import FileFormatError
from rheoclast.io import read, read_spheres, write
from rheoclast.io.lammps_data import STYLES

DUMP = """\
ITEM: TIMESTEP
0
ITEM: NUMBER OF ATOMS
1
ITEM: BOX BOUNDS pp pp ff
0.0 10.0
0.0 10.0
0.0 10.0
ITEM: ATOMS id type x y z radius
1 1 0 0 0 4
ITEM: TIMESTEP
1000
ITEM: NUMBER OF ATOMS
3
ITEM: BOX BOUNDS pp pp ff
-1.0000000000000000e+01 1.0000000000000000e+01
-1.0000000000000000e+01 1.0000000000000000e+01
-1.0000000000000000e+01 1.0000000000000000e+01
ITEM: ATOMS id type x y z radius vx vy vz
3 1 4 0 0 1 0 0 0
1 1 0 0 0 1 0 0 0
2 1 2 0 0 1 0 0 0
"""

DATA = """\
LAMMPS data file via write_data, version 2 Aug 2023, timestep = 1000, units = si

3 atoms
1 atom types

-10 10 xlo xhi
-10 10 ylo yhi
-10 10 zlo zhi

Atoms # sphere

3 1 2.0 2500 4 0 0 0 0 0
1 1 2.0 2500 0 0 0 0 0 0   # the first
2 1 2.0 2500 2 0 0 0 0 0

Velocities

1 0 0 0 0 0 0
2 0 0 0 0 0 0
3 0 0 0 0 0 0
"""

CHAIN = [[0, 0, 0], [2e-9, 0, 0], [4e-9, 0, 0]]


def dump(columns, *rows, box="pp pp pp\n0 10\n0 10\n0 10"):
    text = "\n".join(rows)
    return (
        f"ITEM: UNITS\nsi\nITEM: TIMESTEP\n5\nITEM: NUMBER OF ATOMS\n{len(rows)}\n"
        f"ITEM: BOX BOUNDS {box}\nITEM: ATOMS {columns}\n{text}\n"
    )


def test_last_frame_of_a_dump_in_the_order_of_ids(file):
    floc = read(file("run.lammpstrj", DUMP), "nm")
    np.testing.assert_allclose(floc.spheres.centers, CHAIN)
    np.testing.assert_allclose(floc.spheres.radii, 1e-9)
    assert floc.pairs.tolist() == [[0, 1], [1, 2]]


@pytest.mark.parametrize(
    ("columns", "row"),
    [
        ("id type x y z radius", "1 1 1 2 3 .5"),
        ("id type diameter xu yu zu", "1 1 1 1 2 3"),
        ("element z y x radius", "Si 3 2 1 .5"),
        ("id xs ys zs radius", "1 .1 .2 .3 .5"),
        ("id xsu ysu zsu radius", "1 .1 .2 .3 .5"),
    ],
)
def test_columns_of_a_dump(columns, row, file):
    spheres = read_spheres(file("one.dump", dump(columns, row)), "nm")
    np.testing.assert_allclose(spheres.centers, [[1e-9, 2e-9, 3e-9]])
    np.testing.assert_allclose(spheres.radii, 5e-10)


def test_scaled_positions_in_a_tilted_box(file):
    """A box of edges (10, 0, 0), (-4, 8, 0), (1, -2, 5) at (1, 2, 3), bounds as the LAMMPS manual gives them."""
    edges, origin = np.array([[10, 0, 0], [-4, 8, 0], [1, -2, 5]]), np.array([1, 2, 3])
    corners = origin + np.array([[i, j, k] for i in (0, 1) for j in (0, 1) for k in (0, 1)]) @ edges
    low, high = corners.min(axis=0), corners.max(axis=0)
    box = f"xy xz yz pp pp pp\n{low[0]} {high[0]} -4\n{low[1]} {high[1]} 1\n{low[2]} {high[2]} -2"
    spheres = read_spheres(file("one.dump", dump("id xs ys zs radius", "1 .25 .5 .75 1", box=box)), "nm")
    expected = origin + np.array([0.25, 0.5, 0.75]) @ edges
    np.testing.assert_allclose(spheres.centers, [1e-9 * expected])


def test_dump_without_radii_and_without_ids(file):
    path = file("run", dump("type x y z", "1 0 0 0", "1 0 2 0"))
    np.testing.assert_allclose(read(path, "nm", radius=1).spheres.centers, [[0, 0, 0], [0, 2e-9, 0]])


COMPLETE = dump("id type x y z radius", "1 1 0 0 0 1", "2 1 2 0 0 1")
"""Lines 12 and 13 hold the spheres."""


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("2 1 2 0 0 1\n", "", "expected 2 spheres, as line 6 states, got 1 rows; the file is truncated"),
        ("2 1 2 0 0 1\n", "2 1 2 0 0 1\n3 1 4 0 0 1\n", "expected 2 spheres, as line 6 states, got 3 rows; correct"),
        ("2 1 2 0 0 1\n", "2 1 2 0\n", r"line 13: expected 6 columns \(id type x y z radius\), got 4; is the file"),
        ("2 1 2 0 0 1", "2 1 2 0 zero 1", "line 13: expected a number, got 'zero'"),
        ("2 1 2 0 0 1", "2 1 nan 0 0 1", "line 13: expected a finite number, got 'nan'"),
        ("2 1 2 0 0 1", "2 1 2 0 0 inf", "line 13: expected a finite number, got 'inf'"),
        ("1 1 0 0 0 1", "1 1 0 0 0 -1", "line 12: expected a positive radius, got -1 for sphere 0"),
        ("2 1 2 0 0 1", "1 1 2 0 0 1", "line 13: id 1 is there already in line 12; give every id once"),
        ("2 1 2 0 0 1", "b 1 2 0 0 1", "line 13: expected the id of a sphere as a whole number, got 'b'"),
        ("x y z", "vx vy vz", "line 11: expected columns x y z .*, got 'id type vx vy vz radius'"),
        ("ATOMS\n2", "ATOMS\nmany", "line 6: expected the number of atoms as a whole number, got 'many'"),
        ("ATOMS\n2", "ATOMS\n0", "expected 0 spheres, as line 6 states, got 2 rows; correct"),
        ("NUMBER OF ATOMS", "COUNT", "expected a line 'ITEM: NUMBER OF ATOMS …' in the last frame, got none"),
        ("ITEM: ATOMS", "ITEM: GRID", "expected a line 'ITEM: ATOMS …' in the last frame, got none; the file is trunc"),
        (" radius", "", r"line 12: expected 5 columns \(id type x y z\), got 6; remove the surplus"),
    ],
)
def test_bad_dump(old, new, message, file):
    assert COMPLETE.count(old) == 1
    with pytest.raises(FileFormatError, match=message):
        read(file("floc.dump", COMPLETE.replace(old, new)))


@pytest.mark.parametrize("lines", [6, 4, 1])
def test_dump_that_ends_in_its_header(lines, file):
    text = "\n".join(COMPLETE.splitlines()[:lines])
    with pytest.raises(FileFormatError, match=r"floc.dump.*expected (a line 'ITEM: |the number of atoms)"):
        read(file("floc.dump", text.replace("ATOMS\n2", "ATOMS\n")))


def test_dump_ending_right_behind_the_title_of_the_count(file):
    text = "\n".join(COMPLETE.splitlines()[:5])
    with pytest.raises(FileFormatError, match="line 6: expected the number of atoms as a whole number, got ''"):
        read(file("floc.dump", text))


def test_dump_of_no_atoms(file):
    with pytest.raises(FileFormatError, match="line 6: expected at least one atom, got a frame of 0"):
        read(file("floc.dump", dump("id x y z radius").rstrip() + "\n"))


@pytest.mark.parametrize("box", ["pp pp pp\n0 10\n0 10", "xy xz yz pp pp pp\n0 10\n0 10\n0 10"])
def test_scaled_positions_without_a_box(box, file):
    path = file("floc.dump", dump("id xs ys zs radius", "1 0 0 0 1", box=box))
    with pytest.raises(FileFormatError, match=r"line 7: expected three lines of \d box bounds for scaled positions"):
        read(path)


def test_data_file_of_spheres(file):
    floc = read(file("floc.data", DATA), "nm")
    np.testing.assert_allclose(floc.spheres.centers, CHAIN)
    np.testing.assert_allclose(floc.spheres.radii, 1e-9)


@pytest.mark.parametrize("style", STYLES)
def test_every_atom_style(style, file):
    values = {"id": 1, "type": 1, "molecule": 5, "charge": 0.5, "diameter": 2, "density": 9, "x": 1, "y": 2, "z": 3}
    row = " ".join(str(values[name]) for name in STYLES[style].split())
    path = file("one.lmp", f"title\n\n1 atoms\n\nAtoms # {style}\n\n{row}\n")
    radius = {} if "diameter" in STYLES[style] else {"radius": 1}
    spheres = read_spheres(path, "nm", **radius)
    np.testing.assert_allclose(spheres.centers, [[1e-9, 2e-9, 3e-9]])
    np.testing.assert_allclose(spheres.radii, 1e-9)


def test_data_file_without_radii(file):
    path = file("floc.data", "title\n\n2 atoms\n\nAtoms # atomic\n\n1 1 0 0 0\n2 1 2 0 0 0 0 1\n")
    with pytest.raises(FileFormatError, match="expected a radius of every sphere, got only positions"):
        read(path, "nm")
    assert len(read(path, "nm", radius=1).pairs) == 1


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("2 1 2.0 2500 2 0 0 0 0 0\n", "", "expected 3 spheres, as line 3 states, got 2 rows; the file is truncated"),
        ("\nVelocities", "4 1 2 2500 6 0 0\n\nVelocities", "expected 3 spheres, as line 3 states, got 4 rows; correct"),
        ("2 1 2.0 2500 2 0 0 0 0 0", "2 1 2.0 2500", r"line 14: expected 7 columns \(id type .*\), got 4; is the file"),
        ("2 1 2.0 2500 2 0 0", "2 1 2.0 2500 two 0 0", "line 14: expected a number, got 'two'"),
        ("2 1 2.0 2500 2 0 0", "2 1 2.0 2500 nan 0 0", "line 14: expected a finite number, got 'nan'"),
        ("2 1 2.0 2500 2 0 0", "2 1 0.0 2500 2 0 0", "line 14: expected a positive radius, got 0 for sphere 1"),
        ("2 1 2.0 2500 2 0 0", "1 1 2.0 2500 2 0 0", "line 14: id 1 is there already in line 13"),
        ("3 atoms", "", "expected a line such as '300 atoms' in the header, got none"),
        ("Atoms # sphere", "Atoms", r"line 10: expected an atom style \(sphere, .*\) behind 'Atoms #', got no style"),
        (
            "Atoms # sphere",
            "Atoms  # ellipsoid",
            "line 10: expected an atom style .*, got 'ellipsoid'; write for example",
        ),
        ("Atoms # sphere", "Bonds", "expected a section 'Atoms # sphere', got none; the file is truncated or no"),
    ],
)
def test_bad_data_file(old, new, message, file):
    assert DATA.count(old) == 1
    with pytest.raises(FileFormatError, match=message):
        read(file("floc.lmp", DATA.replace(old, new)), format="lammps-data")


def test_data_file_of_no_atoms(file):
    with pytest.raises(FileFormatError, match="line 3: expected at least one atom, got 0"):
        read(file("floc.data", "title\n\n0 atoms\n\nAtoms # sphere\n\n"))


def test_written_dump(aggregate, sphere_columns, tmp_path):
    write(tmp_path / "floc.dump", aggregate, unit="nm", sphere_columns=sphere_columns)
    lines = (tmp_path / "floc.dump").read_text().splitlines()
    assert lines[:5] == ["ITEM: TIMESTEP", "0", "ITEM: NUMBER OF ATOMS", "5", "ITEM: BOX BOUNDS ff ff ff"]
    assert lines[8] == "ITEM: ATOMS id type x y z radius force_N_x force_N_y force_N_z depth"
    rows = np.loadtxt(lines[9:])
    np.testing.assert_array_equal(rows[:, 6:9], sphere_columns["force_N"])
    bounds = np.loadtxt(lines[5:8])
    assert np.all(bounds[:, 0] < rows[:, 2:5].min(axis=0))
    assert np.all(bounds[:, 1] > rows[:, 2:5].max(axis=0))


def test_written_data_file(aggregate, tmp_path):
    write(tmp_path / "floc.data", aggregate, unit=1e-9)
    text = (tmp_path / "floc.data").read_text()
    assert text.startswith("Rheoclast aggregate, lengths in 1e-09 m\n\n5 atoms\n1 atom types\n\n")
    assert "\nAtoms # sphere\n\n1 1 " in text
