"""Kernels in files come back as they were, with the meaning of every column."""

import sys

import numpy as np
import pytest

from rheoclast.io.csv_table import named_rows
from rheoclast.io.files import load
from rheoclast.io.kernel_files import write_kernel
from rheoclast.populations.breakage_rate import poisson_rate
from rheoclast.populations.kernel_table import KERNEL_COLUMNS, KernelEntry, kernel_table

TABLE = kernel_table(
    [KernelEntry(300, 1e-5, 0.1, poisson_rate(7, 20.3), 0.4), KernelEntry(12, 5e-6, 2, poisson_rate(0, 3))]
)


def test_csv(tmp_path):
    write_kernel(tmp_path / "kernel.csv", TABLE)
    rows = [cells for _, cells in named_rows(load(tmp_path / "kernel.csv"))]
    assert rows[0] == list(TABLE)
    np.testing.assert_array_equal(np.array(rows[1:], float), np.stack(list(TABLE.values()), axis=1))
    lines = (tmp_path / "kernel.csv").read_text().splitlines()
    assert lines[: len(TABLE)] == [f"# {name}: {meaning}" for name, meaning in KERNEL_COLUMNS.items()]


def test_some_columns(tmp_path):
    write_kernel(tmp_path / "kernel.csv", {"spheres": [3, 5], "rate": [0.1, 0.2]})
    lines = (tmp_path / "kernel.csv").read_text().splitlines()
    assert [line.split(":")[0] for line in lines] == ["# spheres", "# rate", "spheres,rate", "3.0,0.1", "5.0,0.2"]


def test_parquet(tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet")
    write_kernel(tmp_path / "kernel.parquet", TABLE)
    found = parquet.read_table(tmp_path / "kernel.parquet")
    assert found.column_names == list(TABLE)
    for name, values in TABLE.items():
        np.testing.assert_array_equal(found[name].to_numpy(), values)
        assert found.schema.field(name).metadata == {b"description": KERNEL_COLUMNS[name].encode()}


def test_parquet_without_pyarrow(tmp_path, monkeypatch):
    def missing(name):
        raise ModuleNotFoundError(name)

    monkeypatch.setattr(sys.modules[write_kernel.__module__], "import_module", missing)
    with pytest.raises(ImportError, match=r"need the package pyarrow: pip install 'rheoclast\[parquet\]'"):
        write_kernel(tmp_path / "kernel.parquet", TABLE)
    assert not list(tmp_path.iterdir())


def test_refused(tmp_path):
    with pytest.raises(ValueError, match=r"expected a name that ends in .csv or .parquet, got '.txt'; rename the file"):
        write_kernel(tmp_path / "kernel.txt", TABLE)
    with pytest.raises(ValueError, match="table: expected columns of kernel_table, got 'speed'; they are spheres, "):
        write_kernel(tmp_path / "kernel.csv", {"speed": [1.0]})
    with pytest.raises(ValueError, match="table: expected columns of kernel_table, got none"):
        write_kernel(tmp_path / "kernel.csv", {})
    with pytest.raises(ValueError, match=r"table\['rate'\]: expected shape \(1,\), got \(2,\); give one value per row"):
        write_kernel(tmp_path / "kernel.csv", {"spheres": [1.0], "rate": [1.0, 2.0]})
    assert not list(tmp_path.iterdir())
    write_kernel(tmp_path / "kernel.csv", TABLE)
    with pytest.raises(FileExistsError, match="exists already"):
        write_kernel(tmp_path / "kernel.csv", TABLE)
    write_kernel(tmp_path / "kernel.csv", TABLE, overwrite=True)


def test_replacing_a_file_is_asked_for_by_name(tmp_path):
    with pytest.raises(TypeError, match="positional argument"):
        write_kernel(tmp_path / "kernel.csv", TABLE, True)
