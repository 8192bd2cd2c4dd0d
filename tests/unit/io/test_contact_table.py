"""Contacts read from a table."""

import pytest

import rheoclast as rc
from rheoclast.errors import FileFormatError
from rheoclast.io.contact_table import read_pairs

SQUARE = "0 0 0 1\n2 0 0 1\n2 2 0 1\n0 2 0 1\n"


@pytest.fixture
def square(tmp_path):
    path = tmp_path / "square.dat"
    path.write_text(SQUARE)
    return path


def table(folder, text):
    path = folder / "contacts.csv"
    path.write_text(text)
    return path


def test_only_the_contacts_of_the_table(square, tmp_path):
    assert len(rc.read(square, "dimensionless").pairs) == 4
    chain = rc.read(
        square, "dimensionless", contacts=table(tmp_path, "contact,i,j,tension\n0,0,1,2\n1,2,1,x\n2,2,3,\n")
    )
    assert chain.pairs.tolist() == [[0, 1], [1, 2], [2, 3]]


def test_what_was_written_is_read_back(square, tmp_path):
    i, j = rc.read(square, "dimensionless").pairs.T
    rc.write_table(tmp_path / "kept.csv", {"i": i, "j": j})
    assert read_pairs(tmp_path / "kept.csv").tolist() == [[0, 1], [0, 3], [1, 2], [2, 3]]


def test_a_single_sphere_has_none(tmp_path):
    assert read_pairs(table(tmp_path, "i,j\n")).shape == (0, 2)


@pytest.mark.parametrize(
    ("text", "error", "message"),
    [
        ("a,b\n0,1\n", FileFormatError, r"contacts.csv: expected columns i and j, .* got 'a, b'"),
        ("# nothing\n", FileFormatError, r"expected columns i and j"),
        (
            "i,j\n0,1\n1,two\n",
            FileFormatError,
            r"csv, line 3: expected the numbers of two spheres, got '1, two'",
        ),
        ("i,j\n0\n", FileFormatError, r"line 2: expected the numbers of two spheres"),
        (
            "i,j\n0,1\n1,2\n2,4\n",
            ValueError,
            r"contacts.csv: pairs\[2\] = \[2, 4\]: expected indices of spheres",
        ),
        ("i,j\n0,1\n", rc.GeometryError, r"contacts.csv: the aggregate is in 3 parts"),
    ],
)
def test_refusals(square, tmp_path, text, error, message):
    with pytest.raises(error, match=message):
        rc.read(square, "dimensionless", contacts=table(tmp_path, text))
