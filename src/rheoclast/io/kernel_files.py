"""Breakage kernels in files: comma-separated values, and Parquet where pyarrow is installed."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from rheoclast._checks import FloatArray
from rheoclast.io import csv_table
from rheoclast.io.files import replacing
from rheoclast.populations.kernel_table import KERNEL_COLUMNS


def write_kernel(path: str | os.PathLike[str], table: Mapping[str, FloatArray], *, overwrite: bool = False) -> None:
    """Write a table of breakage kernels together with the meaning of its columns.

    A file .csv begins with one line ``# column: meaning`` per column, before the line with the names; in a file
    .parquet the metadata of every column hold its meaning under the key ``description``.

    Parameters
    ----------
    path
        File to write; it appears complete or not at all. Its suffix tells the format.
    table
        Columns (n,) as from `kernel_table`, all of them or some.
    overwrite
        Whether an existing file may be replaced.

    Raises
    ------
    ValueError
        If the suffix is neither .csv nor .parquet, or a column is not one of `KERNEL_COLUMNS` or of another length.
    ImportError
        If Parquet is asked for and pyarrow is not installed.
    FileExistsError
        If the file exists and may not be replaced.
    FileNotFoundError
        If its folder does not exist.
    """
    columns = _checked(table)
    suffix = Path(path).suffix.lower()
    if suffix not in WRITERS:
        raise ValueError(f"{path}: expected a name that ends in .csv or .parquet, got {suffix!r}; rename the file")
    with replacing(path, overwrite) as temporary:
        WRITERS[suffix](temporary, columns)


def _checked(table: Mapping[str, Any]) -> dict[str, FloatArray]:
    unknown = [name for name in table if name not in KERNEL_COLUMNS]
    if unknown or not table:
        got = repr(unknown[0]) if unknown else "none"
        raise ValueError(f"table: expected columns of kernel_table, got {got}; they are {', '.join(KERNEL_COLUMNS)}")
    columns = {name: np.array(values, dtype=np.float64) for name, values in table.items()}
    length = np.size(next(iter(columns.values())))
    for name, values in columns.items():
        if values.shape != (length,):
            raise ValueError(f"table[{name!r}]: expected shape ({length},), got {values.shape}; give one value per row")
    return columns


def _write_csv(path: Path, columns: Mapping[str, FloatArray]) -> None:
    with path.open("w", encoding="utf-8", newline="\n") as stream:
        stream.writelines(f"# {name}: {KERNEL_COLUMNS[name]}\n" for name in columns)
        csv_table.write_columns(stream, columns)


def _write_parquet(path: Path, columns: Mapping[str, FloatArray]) -> None:
    arrow, parquet = (_pyarrow(name) for name in ("pyarrow", "pyarrow.parquet"))
    fields = [arrow.field(name, arrow.float64(), metadata={"description": KERNEL_COLUMNS[name]}) for name in columns]
    parquet.write_table(arrow.table(dict(columns), schema=arrow.schema(fields)), path)


def _pyarrow(name: str) -> Any:
    try:
        return import_module(name)
    except ImportError:
        raise ImportError("Parquet files need the package pyarrow: pip install 'rheoclast[parquet]'") from None


WRITERS: Mapping[str, Callable[[Path, Mapping[str, FloatArray]], None]] = {
    ".csv": _write_csv,
    ".parquet": _write_parquet,
}
