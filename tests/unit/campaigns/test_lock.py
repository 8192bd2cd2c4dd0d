"""The lock on a folder."""

import errno
import subprocess
import sys

import pytest

pytest.importorskip("msgspec")
pytest.importorskip("pyarrow")

from rheoclast.campaigns.lock import locked

HOLD = """
import sys, time
from pathlib import Path
from rheoclast.campaigns.lock import locked
with locked(Path(sys.argv[1])):
    print("locked", flush=True)
    time.sleep(60)
"""


def test_a_killed_process_leaves_no_lock(tmp_path):
    with subprocess.Popen([sys.executable, "-c", HOLD, tmp_path], stdout=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout.readline() == "locked\n"
            with pytest.raises(BlockingIOError, match="another process works in this folder"), locked(tmp_path):
                pass
        finally:
            process.kill()
    with locked(tmp_path):
        pass


def test_a_file_system_without_locks_is_let_pass(tmp_path, monkeypatch):
    def without(descriptor):
        raise OSError(errno.ENOLCK, "no locks")

    monkeypatch.setattr("rheoclast.campaigns.lock._lock", without)
    with locked(tmp_path):
        pass
