"""A campaign that is killed and goes on gives the files of one that was left in peace, byte by byte.

Real processes and real signals: of the command line, of its workers, and of a cluster's scheduler and workers.
"""

import json
import os
import signal
import subprocess
import sys
import time
from contextlib import contextmanager, suppress

import psutil
import pytest

pytest.importorskip("msgspec")
pytest.importorskip("pyarrow")
pytestmark = pytest.mark.skipif(os.name == "nt", reason="Windows has no such signals")

TABLES = ("events.parquet", "aggregates.parquet")
TASKS = 16
PATIENCE = 60.0  # seconds for what takes a few
REQUEST = f"""
event = "breakup"
viscosity = 1e-3
radius = 1e-6
sizes = [60]
seeds = {{ number = {TASKS} }}
flows = ["shear"]
orientations = {{ number = 3 }}
materials = ["polystyrene"]
hydrodynamics = {{ model = "free-draining" }}
families = [{{ name = "thinned-fcc-ball", coordination = 6.0 }}]
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("campaign")
    (folder / "campaign.toml").write_text(REQUEST, encoding="utf-8")
    return folder


@contextmanager
def command(folder, output, *options):
    """The command line in a session of its own, which does not outlive the block."""
    arguments = [sys.executable, "-m", "rheoclast", "survey", "campaign.toml", "--output", output, *options]
    with subprocess.Popen(
        arguments, cwd=folder, start_new_session=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as process:
        try:
            yield process
        finally:
            with suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)


def complete(folder, output, *options):
    with command(folder, output, *options) as process:
        _, told = process.communicate(timeout=PATIENCE)
        assert process.returncode == 0, told


def finished(folder, output):
    """Finished tasks with the times at which they were written."""
    return {path.name: path.stat().st_mtime_ns for path in (folder / output / "tasks").glob("[!.]*.parquet")}


def until(condition, process=None):
    """Wait for what must come while a process runs."""
    start = time.monotonic()
    while not condition():
        assert time.monotonic() - start < PATIENCE
        assert process is None or process.poll() is None, process.stderr.read()
        time.sleep(0.01)


def workers(process):
    """Processes of a pool; beside them runs one that looks after what they share."""
    children = psutil.Process(process.pid).children()
    return [child for child in children if "spawn_main" in " ".join(child.cmdline())]


@pytest.fixture(scope="module")
def undisturbed(folder):
    complete(folder, "undisturbed", "--workers", "1")
    return {name: (folder / "undisturbed" / name).read_bytes() for name in TABLES}


def assert_same(folder, output, undisturbed):
    assert len(finished(folder, output)) == TASKS
    for name in TABLES:
        assert (folder / output / name).read_bytes() == undisturbed[name]


def test_a_killed_worker_costs_nothing(folder, undisturbed):
    with command(folder, "worker", "--workers", "2") as process:
        until(lambda: len(finished(folder, "worker")) >= 2, process)
        workers(process)[0].kill()
        _, told = process.communicate(timeout=PATIENCE)
    assert process.returncode == 0, told
    assert_same(folder, "worker", undisturbed)


def test_all_killed_goes_on_where_it_was(folder, undisturbed):
    with command(folder, "group", "--workers", "1") as process:
        until(lambda: len(finished(folder, "group")) >= 3, process)
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate(timeout=PATIENCE)
    kept = finished(folder, "group")
    assert 3 <= len(kept) < TASKS
    assert not any((folder / "group" / name).exists() for name in TABLES)
    complete(folder, "group", "--workers", "2")
    assert_same(folder, "group", undisturbed)
    assert kept.items() <= finished(folder, "group").items()  # not written again


def test_interrupt_is_one_line_and_what_is_finished_stays(folder, undisturbed):
    with command(folder, "interrupt", "--workers", "1") as process:
        until(lambda: len(finished(folder, "interrupt")) >= 1, process)
        os.killpg(process.pid, signal.SIGINT)
        shown, told = process.communicate(timeout=PATIENCE)
    assert process.returncode == 130
    (line,) = told.strip().splitlines()
    kept = len(finished(folder, "interrupt"))
    assert line.startswith("interrupted; ")
    assert line.endswith(
        f"of {TASKS} aggregates are finished and kept in interrupt; to go on, give the same command again"
    )
    assert 1 <= kept < TASKS
    assert shown == ""


def test_workers_do_not_outlive_the_command(folder):
    with command(folder, "orphans", "--workers", "1") as process:
        until(lambda: len(finished(folder, "orphans")) >= 1, process)
        alive = workers(process)
        assert alive
        process.kill()
        assert psutil.wait_procs(alive, timeout=PATIENCE)[1] == []
        process.communicate(timeout=PATIENCE)


@contextmanager
def dask(folder, *arguments):
    """A program of dask, which does not outlive the block."""
    with subprocess.Popen(
        [sys.executable, "-m", "dask", *arguments],
        cwd=folder,
        start_new_session=True,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    ) as process:
        try:
            yield process
        finally:
            with suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)


def test_a_cluster_that_loses_a_worker(folder, undisturbed):
    pytest.importorskip("distributed")
    file = folder / "scheduler.json"
    worker = ("worker", "--scheduler-file", file.name, "--no-nanny", "--nthreads", "1", "--no-dashboard")
    scheduler = ("scheduler", "--host", "127.0.0.1", "--port", "0", "--scheduler-file", file.name, "--no-dashboard")
    with dask(folder, *scheduler):
        until(file.exists)
        address = json.loads(file.read_text())["address"]
        with (
            dask(folder, *worker, "--name", "first") as first,
            dask(folder, *worker, "--name", "second"),
            command(folder, "cluster", "--scheduler", address) as process,
        ):
            until(lambda: len(finished(folder, "cluster")) >= 2, process)
            first.kill()
            _, told = process.communicate(timeout=PATIENCE)
    assert process.returncode == 0, told
    assert_same(folder, "cluster", undisturbed)
