import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rheoclast import Aggregate, FileFormatError, Spheres
from rheoclast.io import read, read_spheres, write

HEADER = """\
# generation_info:
#   script_name: PyFracVAL
# simulation_parameters:
#   N: 3
# aggregate_properties:
#   N_particles_actual: 3
#   center_of_mass:
#   - -5692.286286566426
"""
ROWS = "0 0 0 1\n2 0 0 1\n4 0 0 1\n"


@pytest.mark.parametrize(
    ("name", "count", "contacts"),
    [("fracval_n300_df1.8.dat", 300, 299), ("fracval_n200_df1.9_polydisperse.dat", 200, 199)],
)
def test_output_of_fracval(name, count, contacts, data):
    floc = read(data / name, "nm")
    assert len(floc) == count
    assert len(floc.pairs) == contacts
    assert floc.is_tree
    rows = np.loadtxt(data / name)
    np.testing.assert_allclose(floc.spheres.centers, 1e-9 * rows[:, :3], rtol=1e-15)
    np.testing.assert_allclose(floc.spheres.radii, 1e-9 * rows[:, 3], rtol=1e-15)


def test_fracval_cut_off_between_rows(data, file):
    lines = (data / "fracval_n300_df1.8.dat").read_text().splitlines(keepends=True)
    message = r"cut.dat: expected 300 spheres, as line 16 states, got 289 rows; the file is truncated"
    stated = 1 + next(k for k, line in enumerate(lines) if "N_particles_actual" in line)
    with pytest.raises(FileFormatError, match=message.replace("16", str(stated))):
        read(file("cut.dat", "".join(lines[:-11])), "nm")


def test_fracval_cut_off_within_a_row(data, file):
    text = (data / "fracval_n300_df1.8.dat").read_text()
    line = len(text.splitlines())
    with pytest.raises(
        FileFormatError, match=rf"line {line}: expected 4 columns \(x y z r\), got 3; is the file trunc"
    ):
        read(file("cut.dat", text[:-22]), "nm")


def test_more_rows_than_stated(file):
    with pytest.raises(FileFormatError, match="expected 3 spheres, as line 6 states, got 4 rows; correct the count"):
        read(file("floc.dat", HEADER + ROWS + "6 0 0 1\n"))


@pytest.mark.parametrize(
    "text",
    [
        "0 0 0 1\n2 0 0 1\n",
        "0\t0\t0\t1\n2\t0\t0\t1",
        "0, 0, 0, 1\n2, 0, 0, 1\n",
        "0;0;0;1;\n2;0;0;1;\n",
        "\n# comment\n  0 0 0 1  # first\n\n2 0 0 1\n# end\n",
        "# x y z r\n0 0 0 1\n2 0 0 1\n",
        "x y z radius\n0 0 0 1\n2 0 0 1\n",
        "#id  R  X  Y  Z\n7 1 0 0 0\n8 1 2 0 0\n",
        "# x y z d name\n0 0 0 2 first\n2 0 0 2 second\n",
    ],
)
def test_ways_to_write_two_spheres(text, file):
    spheres = read_spheres(file("two.txt", text), "nm")
    np.testing.assert_allclose(spheres.centers, [[0, 0, 0], [2e-9, 0, 0]])
    np.testing.assert_allclose(spheres.radii, 1e-9)


def test_numbers_with_exponent_and_without_leading_digit(file):
    spheres = read_spheres(file("two.txt", "-.5E+1 +1e0 0. 1.25\n"), "um")
    np.testing.assert_allclose(spheres.centers, [[-5e-6, 1e-6, 0]])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (HEADER, "floc.dat: expected rows x y z .r., got a header and no rows"),
        ("x y z r\n", "expected rows x y z .r., got a header and no rows"),
        ("0 0 0 1\n2 0 0\n", r"line 2: expected 4 columns \(x y z r\), got 3; is the file truncated here"),
        ("0 0 0 1\n2 0 0 1 5\n", r"line 2: expected 4 columns \(x y z r\), got 5; remove the surplus"),
        ("0 0\n", r"line 1: expected 3 or 4 columns \(x y z \[r\]\), got 2: '0 0'; name other columns"),
        ("\n1 0 0 0 1\n", r"line 2: expected 3 or 4 columns \(x y z \[r\]\), got 5: '1 0 0 0 1'"),
        ("0 0 0 1\n2 zero 0 1\n", r"line 2: expected a number, got 'zero'"),
        ("0 0 0 1\n2,,0,1\n", r"line 2: expected a number, got ''"),
        ("0 0 0 1\n2 1_0 0 1\n", r"line 2: expected a number, got '1_0'"),
        ("a b c d\n0 0 0 1\n", r"line 1: expected a number, got 'a'"),
        ("0 0 0 1\n2 NaN 0 1\n", r"line 2: expected a finite number, got 'NaN'"),
        ("0 0 0 1\n\n2 0 0 -inf\n", r"line 3: expected a finite number, got '-inf'"),
        ("0 0 0 1\n2 0 0 1e999\n", r"line 2: expected a finite number, got '1e999'"),
        ("# x y z r\n0 0 0 0\n", r"line 2: expected a positive radius, got 0 for sphere 0"),
        ("# x y z r radius\n0 0 0 1 1\n", r"line 1: two columns are the radius: 'r' and 'radius'; rename one"),
        ("# x y z R_g R_h\n0 0 0 1 1\n", r"expected a radius of every sphere, got only positions"),
    ],
)
def test_bad_input(text, message, file):
    with pytest.raises(FileFormatError, match=message):
        read(file("floc.dat", text))


def test_written_header_states_count_and_columns(aggregate, sphere_columns, tmp_path):
    write(tmp_path / "floc.txt", aggregate, unit="nm", sphere_columns=sphere_columns)
    lines = (tmp_path / "floc.txt").read_text().splitlines()
    assert lines[:2] == ["# spheres: 5", "# x_nm y_nm z_nm r_nm force_N_x force_N_y force_N_z depth"]
    rows = np.loadtxt(tmp_path / "floc.txt")
    np.testing.assert_array_equal(rows[:, 4:7], sphere_columns["force_N"])
    np.testing.assert_array_equal(rows[:, 7], sphere_columns["depth"])


def test_a_written_file_that_lost_its_end_is_refused(aggregate, tmp_path):
    write(tmp_path / "floc.txt", aggregate)
    text = (tmp_path / "floc.txt").read_text()
    (tmp_path / "floc.txt").write_text(text[: text.rindex("\n", 0, -1) + 1])
    with pytest.raises(
        FileFormatError, match="expected 5 spheres, as line 1 states, got 4 rows; the file is truncated"
    ):
        read(tmp_path / "floc.txt")


@settings(max_examples=50, deadline=None)
@given(
    radii=st.lists(st.floats(1e-9, 1e-4), min_size=1, max_size=12),
    origin=st.tuples(*[st.floats(-1e-6, 1e-6)] * 3),
    name=st.sampled_from(["text", "csv"]),
)
def test_any_chain_is_restored_to_the_last_bit(radii, origin, name, tmp_path_factory):
    radii = np.array(radii)
    along = np.concatenate([[0], np.cumsum(radii[1:] + radii[:-1])])
    spheres = Spheres(np.array(origin) + along[:, None] * np.array([0.6, 0.0, 0.8]), radii, 1e-2)
    floc = Aggregate.touching(spheres, 1e-2)
    path = tmp_path_factory.mktemp("chain") / "floc"
    write(path, floc, format=name)
    back = read(path, format=name, tolerance=1e-2, overlap_tolerance=1e-2)
    np.testing.assert_array_equal(back.spheres.centers, floc.spheres.centers)
    np.testing.assert_array_equal(back.spheres.radii, floc.spheres.radii)
    np.testing.assert_array_equal(back.pairs, floc.pairs)
