"""A long solution stopped from outside: a real process and a real signal."""

import os
import signal
import subprocess
import sys
import time

import pytest

import rheoclast as rc

UNTIL_SOLVING = 8.0  # seconds; the whole takes over 15


@pytest.mark.skipif(os.name == "nt", reason="Windows has no such signal")
def test_interrupt_during_the_solution(tmp_path):
    """One line, the status of an interrupted program, at once, and no results."""
    rc.write(tmp_path / "floc.dat", rc.generation.cluster_cluster(20_000, 1e-6), unit="um")
    command = [sys.executable, "-m", "rheoclast", "stress", "floc.dat", "--unit", "um", "--output", "results"]
    with subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        time.sleep(UNTIL_SOLVING)
        assert process.poll() is None
        process.send_signal(signal.SIGINT)
        sent = time.monotonic()
        out, err = process.communicate(timeout=60)
        assert time.monotonic() - sent < 20
    assert process.returncode == 130
    assert err.strip().splitlines()[-1] == "interrupted; nothing was written"
    assert out == ""
    assert not (tmp_path / "results").exists() or not list((tmp_path / "results").iterdir())
