import csv

import numpy as np
import pytest

from rheoclast import FileFormatError
from rheoclast.io import read_spheres, write, write_table


@pytest.mark.parametrize(
    "text",
    [
        "x,y,z,r\n0,0,0,1\n2,0,0,1\n",
        "X,Y,Z,Radius\n0,0,0,1\n2,0,0,1\n",
        "name,diameter,z,y,x\nfirst,2,0,0,0\n\n,2,0,0,2\n",
        'x (nm),"y [nm]",z_nm,d / nm\n0,0,0,2\n2,0,0,2\n',
        "x;y;z;r\n0;0;0;1\n2;0;0;1\n",
        "x\ty\tz\tr\n0\t0\t0\t1\n2\t0\t0\t1\n",
        '# made by hand\nlabel,x,y,z,r\n"one, first",0,0,0,1\n"two",2,0,0,1\n',
        "x,y,z,r,d\n0,0,0,1,9\n2,0,0,1,9\n",
        "# x,y,z,r\n0,0,0,1\n2,0,0,1\n",
        "0,0,0,1\n2,0,0,1\n",
    ],
)
@pytest.mark.parametrize("name", ["two.csv", "two.tsv"])
def test_ways_to_write_two_spheres(text, name, file):
    spheres = read_spheres(file(name, text), "nm")
    np.testing.assert_allclose(spheres.centers, [[0, 0, 0], [2e-9, 0, 0]])
    np.testing.assert_allclose(spheres.radii, 1e-9)


def test_a_table_without_suffix_is_known_by_its_column_names(file):
    assert len(read_spheres(file("two", "x,y,z,r,x_velocity\n0,0,0,1,0\n2,0,0,1,0\n"), "nm")) == 2


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("# only\n# comments\n", "floc.csv: expected a line that names the columns x, y, z and r, got only comments"),
        ("x,y,z,r\n", "floc.csv: expected rows of spheres below the column names, got none"),
        ("a,b,c,d\n0,0,0,1\n", r"line 1: expected column names x, y, z and r \(or .*\), got 'a, b, c, d'; rename"),
        ("x,y,z,X\n0,0,0,1\n", "line 1: two columns are the x: 'x' and 'X'; rename one"),
        ("x,y,z,r\n0,0,0,1\n2,0\n", r"line 3: expected 4 columns \(x y z r\), got 2; is the file truncated here"),
        ("x,y,z,r\n0,0,0,1\n2,0,one,1\n", "line 3: expected a number, got 'one'"),
        ("x,y,z,r\n0,0,0,1\n\n2,0,,1\n", "line 4: expected a number, got ''"),
        ("x,y,z,r\n0,0,0,1\n2,0,nan,1\n", "line 3: expected a finite number, got 'nan'"),
        ("x,y,z,r\n0,0,0,1\n2,0,inf,1\n", "line 3: expected a finite number, got 'inf'"),
        ("x,y,z,r\n0,0,0,1\n2,0,0,-1\n", "line 3: expected a positive radius, got -1 for sphere 1"),
        ("x,y,z,d\n0,0,0,0\n2,0,0,1\n", "line 2: expected a positive radius, got 0 for sphere 0"),
        ("x,y,z\n0,0,0\n", "expected a radius of every sphere, got only positions"),
    ],
)
def test_bad_input(text, message, file):
    with pytest.raises(FileFormatError, match=message):
        read_spheres(file("floc.csv", text))


def test_two_columns_of_the_same_meaning_in_a_file_without_suffix(file):
    with pytest.raises(FileFormatError, match="floc, line 1: two columns are the radius: 'r' and 'radius'; rename one"):
        read_spheres(file("floc", "x,y,z,r,radius\n0,0,0,1,1\n"))


def test_cell_without_end(file):
    with pytest.raises(FileFormatError, match="expected comma-separated values, got a cell that has no end"):
        read_spheres(file("floc.csv", 'x,y,z,r\n0,0,"' + "1" * 200_000))


def test_written_columns(aggregate, sphere_columns, tmp_path):
    write(tmp_path / "floc.csv", aggregate, unit="um", sphere_columns=sphere_columns)
    with open(tmp_path / "floc.csv", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert list(rows[0]) == ["x_um", "y_um", "z_um", "radius_um", "force_N_x", "force_N_y", "force_N_z", "depth"]
    assert [float(row["force_N_z"]) for row in rows] == sphere_columns["force_N"][:, 2].tolist()


class TestWriteTable:
    def test_numbers_words_and_vectors(self, tmp_path):
        third = 1 / 3
        write_table(
            tmp_path / "table.csv",
            {
                "contact": np.arange(2),
                "tension_N": [third, -np.inf],
                "normal": [[1, 0, third], [0, 1, np.nan]],
                "criterion": ["tension, first", "bending"],
                "broken": np.array([True, False]),
            },
        )
        assert (tmp_path / "table.csv").read_text() == (
            "contact,tension_N,normal_x,normal_y,normal_z,criterion,broken\n"
            f'0,{third!r},1.0,0.0,{third!r},"tension, first",True\n'
            "1,-inf,0.0,1.0,nan,bending,False\n"
        )

    def test_a_table_of_spheres_is_read_back(self, aggregate, tmp_path):
        x, y, z = aggregate.spheres.centers.T
        write_table(tmp_path / "table.csv", {"x_m": x, "y_m": y, "z_m": z, "radius_m": aggregate.spheres.radii})
        back = read_spheres(tmp_path / "table.csv")
        np.testing.assert_array_equal(back.centers, aggregate.spheres.centers)
        np.testing.assert_array_equal(back.radii, aggregate.spheres.radii)

    def test_no_rows_leave_the_header(self, tmp_path):
        write_table(tmp_path / "table.csv", {"rate": np.empty(0), "force": np.empty((0, 3))})
        assert (tmp_path / "table.csv").read_text() == "rate,force_x,force_y,force_z\n"

    @pytest.mark.parametrize(
        ("columns", "message"),
        [
            ({}, "columns: expected at least one column, got none"),
            ({"a": [1, 2], "b": [1]}, r"columns\['b'\]: expected 2 rows as in 'a', got 1"),
            ({"a": 1.0}, r"columns\['a'\]: expected shape \(n,\) or \(n, 3\), got \(\)"),
            ({"a": np.ones((2, 2))}, r"columns\['a'\]: expected shape \(n,\) or \(n, 3\), got \(2, 2\)"),
            ({"a": [1j]}, r"columns\['a'\]: expected real numbers or words, got an array of complex128"),
            ({"a": [[1, 2], [3]]}, r"columns\['a'\]: expected one value or three per row, got \[\[1, 2\], \[3\]\]"),
            ({"f": np.ones((2, 3)), "f_x": [1, 2]}, "columns: 'f_x' would be there twice; rename 'f_x'"),
        ],
    )
    def test_refusals_write_nothing(self, columns, message, tmp_path):
        with pytest.raises(ValueError, match=message):
            write_table(tmp_path / "table.csv", columns)
        assert list(tmp_path.iterdir()) == []

    def test_overwrite(self, tmp_path):
        write_table(tmp_path / "table.csv", {"a": [1]})
        with pytest.raises(FileExistsError, match=r"table.csv exists already; choose another name, or allow"):
            write_table(tmp_path / "table.csv", {"a": [2]})
        assert (tmp_path / "table.csv").read_text() == "a\n1\n"
        write_table(tmp_path / "table.csv", {"a": [2]}, overwrite=True)
        assert (tmp_path / "table.csv").read_text() == "a\n2\n"
