"""Every format in the registry, by the same tests."""

import numpy as np
import pytest

from rheoclast.io import read, read_spheres, write
from rheoclast.io.formats import FORMATS

READ_BACK = [name for name, kind in FORMATS.items() if kind.read]
SUFFIXES = [(name, suffix) for name, kind in FORMATS.items() for suffix in kind.suffixes]


def test_all_but_vtp_are_read_back():
    assert set(FORMATS) - set(READ_BACK) == {"vtp"}


@pytest.mark.parametrize("name", READ_BACK)
def test_round_trip_restores_every_bit(name, aggregate, tmp_path):
    path = tmp_path / "floc"
    write(path, aggregate, format=name)
    back = read(path, format=name)
    np.testing.assert_array_equal(back.spheres.centers, aggregate.spheres.centers)
    np.testing.assert_array_equal(back.spheres.radii, aggregate.spheres.radii)
    np.testing.assert_array_equal(back.pairs, aggregate.pairs)


@pytest.mark.parametrize("name", READ_BACK)
@pytest.mark.parametrize("unit", ["nm", "\u00b5m", "angstrom", 3e-7, "dimensionless"])
def test_round_trip_in_another_unit(name, unit, aggregate, tmp_path):
    path = tmp_path / "floc"
    write(path, aggregate, unit=unit, format=name)
    back = read(path, unit, format=name)
    np.testing.assert_allclose(back.spheres.centers, aggregate.spheres.centers, rtol=1e-15)
    np.testing.assert_allclose(back.spheres.radii, aggregate.spheres.radii, rtol=1e-15)


@pytest.mark.parametrize(("name", "suffix"), SUFFIXES)
def test_the_suffix_tells_the_format(name, suffix, aggregate, tmp_path):
    by_suffix, by_name = tmp_path / f"a{suffix}", tmp_path / "b"
    write(by_suffix, aggregate)
    write(by_name, aggregate, format=name)
    assert by_suffix.read_bytes() == by_name.read_bytes()
    if FORMATS[name].read:
        np.testing.assert_array_equal(read(by_suffix).spheres.centers, aggregate.spheres.centers)


@pytest.mark.parametrize("name", READ_BACK)
def test_the_content_tells_the_format_of_an_unknown_suffix(name, aggregate, tmp_path):
    write(tmp_path / "floc.0001", aggregate, format=name)
    back = read(tmp_path / "floc.0001")
    np.testing.assert_array_equal(back.spheres.radii, aggregate.spheres.radii)


@pytest.mark.parametrize("name", [name for name in READ_BACK if "sphere_columns" in FORMATS[name].columns])
def test_further_columns_do_not_disturb_the_geometry(name, aggregate, sphere_columns, tmp_path):
    write(tmp_path / "floc", aggregate, format=name, sphere_columns=sphere_columns)
    back = read(tmp_path / "floc", format=name)
    np.testing.assert_array_equal(back.spheres.centers, aggregate.spheres.centers)
    np.testing.assert_array_equal(back.spheres.radii, aggregate.spheres.radii)


@pytest.mark.parametrize("name", FORMATS)
def test_columns_that_do_not_fit_a_format_are_refused_and_nothing_is_written(name, aggregate, tmp_path):
    given = {"sphere_columns": {"label": np.ones(5)}, "contact_columns": {"tension_N": np.ones(4)}}
    for argument, columns in given.items():
        if argument not in FORMATS[name].columns:
            with pytest.raises(ValueError, match=rf"{argument}: files of format '{name}' have no place for '\w+'; use"):
                write(tmp_path / "floc", aggregate, format=name, **{argument: columns})
    assert list(tmp_path.iterdir()) == []


def test_unknown_format_and_unknown_suffix(aggregate, tmp_path, file):
    with pytest.raises(ValueError, match=r"format: expected one of text, csv, .*, got 'stl'"):
        write(tmp_path / "floc.txt", aggregate, format="stl")
    with pytest.raises(ValueError, match=r"format: expected one of text, csv, .*, got 'stl'"):
        read(file("floc.txt", "0 0 0 1"), format="stl")
    with pytest.raises(
        ValueError, match=r"floc: expected a suffix that tells the format \(.txt, .*\); add one or pass"
    ):
        write(tmp_path / "floc", aggregate)


@pytest.mark.parametrize("name", ["floc.vtp", "floc"])
def test_vtp_is_not_read(name, aggregate, tmp_path):
    write(tmp_path / name, aggregate, format="vtp")
    with pytest.raises(ValueError, match="files of format 'vtp' are written but not read; keep"):
        read_spheres(tmp_path / name)
