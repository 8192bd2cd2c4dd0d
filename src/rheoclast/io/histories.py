"""Histories of the velocity gradient, from and to files.

A file holds, for one path or several, instants t and nine entries A_ij of the gradient at each. Which derivative an
entry is must be said, because a gradient and its transpose look alike: they have the same trace, strain rate and
invariants, and opposite rotation. With `order="row"`, A_ij = ∂u_i/∂x_j, each row belonging to one velocity component;
with `order="column"`, A_ij = ∂u_j/∂x_i. Where nine numbers stand in a line they are A11 A12 A13 A21 … A33.

| format | layout |
|---|---|
| csv | rows of t and nine entries, parted by commas, semicolons, tabs or blanks |
| npy | array (T, 10) or (K, T, 10): t and nine entries |
| npz, hdf5 | arrays `t` (T,) or (K, T) and `gradient` (T, 3, 3) or (K, T, 3, 3), or 9 in place of 3, 3 |

Tables may name their columns, as `rheoclast.io.history_table` describes.
"""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.errors import FileFormatError
from rheoclast.flows import TRACE_TOLERANCE
from rheoclast.histories import GradientHistory
from rheoclast.io.files import replacing
from rheoclast.io.history_arrays import read_hdf5, read_npy, read_npz, write_hdf5, write_npy, write_npz
from rheoclast.io.history_samples import PER_SECOND, SECONDS, Samples
from rheoclast.io.history_table import read_table, write_table

PathName = str | os.PathLike[str]

UNEVEN = 10.0


def read_histories(
    path: PathName,
    *,
    time_unit: str | float = "s",
    gradient_unit: str | float = "1/s",
    order: Literal["row", "column"] = "row",
    tolerance: float = TRACE_TOLERANCE,
    arrays: tuple[str, str] = ("t", "gradient"),
    format: str | None = None,
) -> tuple[GradientHistory, ...]:
    """Histories of the velocity gradient in a file, one per path, in the order in which the paths appear.

    Parameters
    ----------
    path
        File of histories, in one of the layouts below.
    time_unit
        Unit of the instants: "s", "ms", "us", "min", "h", "dimensionless", or its value in s.
    gradient_unit
        Unit of the gradients: "1/s", "1/ms", "1/us", "1/min", "1/h", "dimensionless", or its value in 1/s.
    order
        "row" where entry A_ij is ∂u_i/∂x_j, "column" where it is ∂u_j/∂x_i. No check can tell them apart.
    tolerance
        Largest trace, as a fraction of the largest entry, that is taken away as an error of the data; by default
        rounding only. Simulated fields that were interpolated may need 0.01 to 0.1.
    arrays
        Names of the arrays of instants and gradients in an NPZ or HDF5 file.
    format
        "csv", "npy", "npz" or "hdf5"; by default told from the suffix, tables having .csv, .tsv, .txt or .dat.

    Raises
    ------
    FileNotFoundError
        If there is no such file.
    FileFormatError
        If the file cannot be understood, with the line where there is one; if a number is missing or not finite, times
        do not increase, a trace exceeds the tolerance, or the file contradicts `time_unit`, `gradient_unit` or
        `order` by its names or attributes.
    ImportError
        If HDF5 is to be read and h5py is not installed.

    Warns
    -----
    UserWarning
        If a step is more than ten times the median of its path: samples may be missing.

    Notes
    -----
    Tables (.csv, .tsv, .txt, .dat): one row per instant with the time and nine entries A11 A12 A13 A21 … A33, parted by
    commas, semicolons, tabs or blanks. A first line, with or without # in front, may name the columns, which then come
    in any order: `t`; the entries by their places, `A11` or `g_xy`, or by their meaning, `dudx` … `dwdz` or
    `du_x/dy`, which then decides instead of `order`; ``trajectory``, `id`, `track` or `particle`, a number that tells
    the paths apart. Units may stand behind the names: `t_ms`, `dudx (1/ms)`. Other columns are passed over.

    NPY: an array (T, 10), or (K, T, 10) of K paths, of times and entries.

    NPZ and HDF5: two arrays, by default named `t`, (T,) for all paths or (K, T), and `gradient`, (T, 3, 3) or
    (K, T, 3, 3), or 9 in place of 3, 3. In HDF5 an attribute `unit` of a dataset is held against `time_unit` or
    `gradient_unit`.
    """
    seconds, per_second = _value("time_unit", time_unit, SECONDS), _value("gradient_unit", gradient_unit, PER_SECOND)
    if order not in ("row", "column"):
        raise ValueError(f"order: expected 'row' or 'column', got {order!r:.60}")
    histories = []
    for samples in _format(path, format).read(Path(path), arrays):
        _refuse_other_unit(path, "time", time_unit, seconds, samples.time_unit, SECONDS)
        _refuse_other_unit(path, "gradient", gradient_unit, per_second, samples.gradient_unit, PER_SECOND)
        _refuse_other_order(path, samples, order)
        entries = samples.entries if order == "row" else np.swapaxes(samples.entries, 1, 2)
        with _named(path, samples.label):
            history = GradientHistory(seconds * samples.times, per_second * entries, tolerance)
        _warn_of_gap(path, samples.label, history.times)
        histories.append(history)
    return tuple(histories)


def write_histories(
    path: PathName,
    histories: GradientHistory | Iterable[GradientHistory],
    *,
    format: str | None = None,
    overwrite: bool = False,
) -> None:
    """Write histories to a file, in s and 1/s and in row order, with all digits.

    Parameters
    ----------
    path
        File to write; it appears complete or not at all.
    histories
        One history or several. Formats other than "csv" need the same number of instants in all.
    format
        "csv", "npy", "npz" or "hdf5"; by default told from the suffix.
    overwrite
        Whether an existing file may be replaced.

    Raises
    ------
    FileExistsError
        If the file exists and may not be replaced.
    FileNotFoundError
        If its folder does not exist.
    ValueError
        If there are no histories, the format is not known, or the numbers of instants differ.
    ImportError
        If HDF5 is to be written and h5py is not installed.
    """
    kind = _format(path, format)
    several = (histories,) if isinstance(histories, GradientHistory) else tuple(histories)
    if not several:
        raise ValueError("histories: expected at least one history, got none")
    for k, history in enumerate(several):
        _checks.instance(f"histories[{k}]", history, GradientHistory, "make one from times and gradients")
        if kind.equal_lengths and len(history) != len(several[0]):
            raise ValueError(
                f"histories[{k}]: expected {len(several[0])} instants as in the first history, got {len(history)}; "
                "write CSV, which can hold histories of different lengths"
            )
    with replacing(path, overwrite) as temporary:
        kind.write(temporary, several)


@dataclass(frozen=True)
class _Format:
    read: Callable[[Path, tuple[str, str]], Iterator[Samples]]
    write: Callable[[Path, tuple[GradientHistory, ...]], None]
    suffixes: tuple[str, ...]
    equal_lengths: bool = True


HISTORY_FORMATS = {
    "csv": _Format(read_table, write_table, (".csv", ".tsv", ".txt", ".dat"), equal_lengths=False),
    "npy": _Format(read_npy, write_npy, (".npy",)),
    "npz": _Format(read_npz, write_npz, (".npz",)),
    "hdf5": _Format(read_hdf5, write_hdf5, (".h5", ".hdf5")),
}


def _format(path: PathName, name: str | None) -> _Format:
    """Format by its name, else by the suffix of the file."""
    if name is not None and name not in HISTORY_FORMATS:
        raise ValueError(f"format: expected one of {', '.join(HISTORY_FORMATS)}, got {name!r:.60}")
    suffix = Path(path).suffix.lower()
    for each, kind in HISTORY_FORMATS.items():
        if name == each or (name is None and suffix in kind.suffixes):
            return kind
    suffixes = ", ".join(suffix for kind in HISTORY_FORMATS.values() for suffix in kind.suffixes)
    raise ValueError(f"{path}: expected a suffix that tells the format ({suffixes}); pass format=")


def _value(name: str, unit: str | float, known: Mapping[str, float]) -> float:
    if not isinstance(unit, str):
        return _checks.positive(name, unit)
    if unit not in known:
        raise ValueError(f"{name}: expected one of {', '.join(known)}, or its value as a number, got {unit!r:.60}")
    return known[unit]


def _refuse_other_unit(
    path: PathName, quantity: str, asked: str | float, value: float, found: str | None, known: Mapping[str, float]
) -> None:
    """Refuse a unit that the file gainsays: the error would be a factor."""
    if found and asked != "dimensionless" and not np.isclose(known[found], value, atol=0):
        raise FileFormatError(
            f"{path}: expected {quantity}s in {asked}, got a column in {found} by its name; "
            f"pass {quantity}_unit={found!r} or rename the column"
        )


def _refuse_other_order(path: PathName, samples: Samples, order: str) -> None:
    """Refuse an order that the names of the columns gainsay: the error would be the wrong rotation."""
    if order == "column" and not samples.transposable:
        raise FileFormatError(
            f"{path}: expected entries that order='column' can transpose, got columns named as derivatives, "
            "which say their order themselves; leave order out"
        )


@contextmanager
def _named(path: PathName, label: str) -> Iterator[None]:
    """Put the name of the file and of the path in front of what is wrong with a history."""
    try:
        yield
    except ValueError as error:
        raise FileFormatError(f"{path}{label and ', '}{label}: {error}") from None


def _warn_of_gap(path: PathName, label: str, times: FloatArray) -> None:
    steps = np.diff(times)
    widest, usual = int(np.argmax(steps)), float(np.median(steps))
    if steps[widest] > UNEVEN * usual:
        warnings.warn(
            f"{path}{label and ', '}{label}: the step after {times[widest]:g} s is {steps[widest]:.3g} s, the median "
            f"{usual:.3g} s; a straight line bridges it, so split the history there if samples are missing",
            UserWarning,
            stacklevel=3,
        )
