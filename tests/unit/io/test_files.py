"""Files that take their place in one step."""

import os

import pytest

from rheoclast.io.files import replacing


def write(path, text):
    with replacing(path, overwrite=True) as temporary:
        temporary.write_text(text)
        if text != "whole":
            raise KeyboardInterrupt


def test_a_file_is_on_the_disk_before_it_takes_its_place(tmp_path, monkeypatch):
    order = []

    def remember(name, real):
        monkeypatch.setattr(os, name, lambda *given: order.append(name) or real(*given))

    remember("fsync", os.fsync)
    remember("replace", os.replace)
    write(tmp_path / "a.txt", "whole")
    assert order == ["fsync", "replace"]
    assert (tmp_path / "a.txt").read_text() == "whole"


def test_what_fails_leaves_the_old_file_alone(tmp_path):
    (tmp_path / "a.txt").write_text("old")
    with pytest.raises(KeyboardInterrupt):
        write(tmp_path / "a.txt", "half")
    assert [(path.name, path.read_text()) for path in tmp_path.iterdir()] == [("a.txt", "old")]


def test_a_folder_that_takes_no_files_is_told_by_the_name_that_was_given(tmp_path):
    with (
        pytest.raises(OSError, match=r"^/proc/floc.csv: cannot be written \(.*\); choose another folder$"),
        replacing("/proc/floc.csv") as temporary,
    ):
        temporary.write_text("x")
