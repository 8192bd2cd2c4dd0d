"""Refusals, and that a file appears whole or not at all."""

import os
import stat

import numpy as np
import pytest

from rheoclast.io import write
from rheoclast.io.files import replacing
from rheoclast.io.formats import FORMATS


@pytest.mark.parametrize(
    ("columns", "message"),
    [
        ({"force": np.ones((4, 3))}, r"sphere_columns\['force'\]: expected shape \(5,\) or \(5, 3\), got \(4, 3\)"),
        ({"force": np.ones((5, 2))}, r"sphere_columns\['force'\]: expected shape \(5,\) or \(5, 3\), got \(5, 2\)"),
        ({"force": ["a"] * 5}, r"sphere_columns\['force'\]: expected numbers, got \['a', 'a'"),
        (
            {"force (N)": np.ones(5)},
            r"sphere_columns: expected names of letters, digits and _ such as 'force_N', got 'force \(N\)'",
        ),
        ({"σ_Pa": np.ones(5)}, "sphere_columns: expected names of letters, digits and _ such as 'force_N', got 'σ_Pa'"),
        ({"": np.ones(5)}, "sphere_columns: expected names of letters, digits and _ such as 'force_N', got ''"),
        ({3: np.ones(5)}, "sphere_columns: expected names of letters, digits and _ such as 'force_N', got 3"),
        ({"radius": np.ones(5)}, "sphere_columns: 'radius' is a column of the geometry itself; choose another name"),
        ({"x_nm": np.ones(5)}, "sphere_columns: 'x_nm' is a column of the geometry itself; choose another name"),
        ({"id": np.ones(5)}, "sphere_columns: 'id' is a column of the geometry itself; choose another name"),
        ({"f": np.ones((5, 3)), "f_y": np.ones(5)}, "columns: 'f_y' would be there twice; rename 'f_y'"),
    ],
)
@pytest.mark.parametrize("name", ["text", "csv", "xyz", "lammps-dump", "vtp"])
def test_bad_columns_write_nothing(name, columns, message, aggregate, tmp_path):
    with pytest.raises(ValueError, match=message):
        write(tmp_path / "floc", aggregate, sphere_columns=columns, format=name)
    assert list(tmp_path.iterdir()) == []


def test_bad_contact_columns(aggregate, tmp_path):
    with pytest.raises(ValueError, match=r"contact_columns\['t'\]: expected shape \(4,\) or \(4, 3\), got \(5,\)"):
        write(tmp_path / "floc.vtp", aggregate, contact_columns={"t": np.ones(5)})
    with pytest.raises(ValueError, match="unit: expected one of"):
        write(tmp_path / "floc.vtp", aggregate, unit="inch")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", FORMATS)
def test_an_existing_file_is_replaced_only_when_allowed(name, aggregate, tmp_path):
    path = tmp_path / "floc"
    path.write_text("old")
    with pytest.raises(FileExistsError, match=r"floc exists already; choose another name, or allow it to be replaced"):
        write(path, aggregate, format=name)
    assert path.read_text() == "old"
    write(path, aggregate, format=name, overwrite=True)
    assert path.read_text() != "old"
    assert [each.name for each in tmp_path.iterdir()] == ["floc"]


def test_missing_folder(aggregate, tmp_path):
    with pytest.raises(FileNotFoundError, match=r"floc.csv: the folder .*out does not exist; create it first"):
        write(tmp_path / "out" / "floc.csv", aggregate)
    assert list(tmp_path.iterdir()) == []


def test_a_folder_is_never_replaced(aggregate, tmp_path):
    (tmp_path / "floc.csv").mkdir()
    with pytest.raises(FileExistsError, match=r"floc.csv: expected the name of a file, got a folder or a device"):
        write(tmp_path / "floc.csv", aggregate, overwrite=True)


def test_a_failure_within_leaves_everything_as_it_was(aggregate, tmp_path, monkeypatch):
    def half_written(stream, _contents):
        stream.write("half")
        raise RuntimeError("disk full")

    monkeypatch.setitem(FORMATS, "text", type(FORMATS["text"])(None, half_written, (".txt",)))
    (tmp_path / "old.txt").write_text("old")
    for name in ("old.txt", "new.txt"):
        with pytest.raises(RuntimeError, match="disk full"):
            write(tmp_path / name, aggregate, overwrite=True)
    assert [(path.name, path.read_text()) for path in tmp_path.iterdir()] == [("old.txt", "old")]


class TestReplacing:
    def test_the_temporary_file_has_the_same_folder_and_suffix(self, tmp_path):
        with replacing(tmp_path / "picture.png") as temporary:
            assert temporary.parent == tmp_path
            assert temporary.suffix == ".png"
            temporary.write_bytes(b"picture")
            assert not (tmp_path / "picture.png").exists()
        assert (tmp_path / "picture.png").read_bytes() == b"picture"
        assert not temporary.exists()

    def test_an_interruption_leaves_nothing(self, tmp_path):
        with pytest.raises(KeyboardInterrupt), replacing(tmp_path / "picture.png") as temporary:  # noqa: PT012
            temporary.write_bytes(b"half")
            raise KeyboardInterrupt
        assert list(tmp_path.iterdir()) == []

    @pytest.mark.skipif(os.name != "posix", reason="modes and links of POSIX")
    def test_mode_and_link_survive(self, tmp_path):
        real, link = tmp_path / "real.txt", tmp_path / "link.txt"
        real.write_text("old")
        real.chmod(0o640)
        link.symlink_to(real)
        with replacing(link, overwrite=True) as temporary:
            temporary.write_text("new")
        assert link.is_symlink()
        assert real.read_text() == "new"
        assert stat.S_IMODE(real.stat().st_mode) == 0o640

    @pytest.mark.skipif(os.name != "posix", reason="devices of POSIX")
    def test_a_device_is_never_replaced(self):
        with (
            pytest.raises(FileExistsError, match="/dev/null: expected the name of a file"),
            replacing("/dev/null", True),
        ):
            pass
