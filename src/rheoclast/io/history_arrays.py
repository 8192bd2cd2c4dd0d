"""Velocity-gradient histories in files of arrays: NumPy's NPY and NPZ, and HDF5."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterator
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np
from numpy.typing import NDArray

from rheoclast._checks import FloatArray
from rheoclast.errors import FileFormatError
from rheoclast.histories import GradientHistory
from rheoclast.io.history_samples import PER_SECOND, SECONDS, Samples, inverse_time_unit

Units = tuple[str | None, str | None]


def read_npy(path: Path, arrays: tuple[str, str]) -> Iterator[Samples]:
    """Paths in one array (T, 10) or (K, T, 10), which has no name."""
    with _opened(path, np.load) as found:
        if not isinstance(found, np.ndarray) or found.ndim not in (2, 3) or found.shape[-1] != 10:
            shape = getattr(found, "shape", "an archive of arrays")
            raise FileFormatError(f"{path}: expected an array (T, 10) or (K, T, 10), a time and nine, got {shape}")
        return _split(path, found[..., 0], found[..., 1:])


def write_npy(path: Path, histories: tuple[GradientHistory, ...]) -> None:
    """One array (T, 10), or (K, T, 10) for several histories."""
    times, gradients = _joined(histories)
    with path.open("wb") as stream:
        np.save(stream, np.concatenate([times[..., None], gradients.reshape(*times.shape, 9)], axis=-1))


def read_npz(path: Path, arrays: tuple[str, str]) -> Iterator[Samples]:
    """Paths in two arrays."""
    with _opened(path, np.load) as archive:
        times, gradients = (_taken(path, archive, name) for name in arrays)
        return _split(path, times, gradients)


def write_npz(path: Path, histories: tuple[GradientHistory, ...]) -> None:
    """Arrays `t` and `gradient`."""
    times, gradients = _joined(histories)
    with path.open("wb") as stream:
        np.savez(stream, t=times, gradient=gradients)


def read_hdf5(path: Path, arrays: tuple[str, str]) -> Iterator[Samples]:
    """Paths in two datasets; units in their attributes `unit` are heeded."""
    with _opened(path, _h5py().File) as file:
        times, gradients = (_taken(path, file, name) for name in arrays)
        units = (_unit(file[arrays[0]], SECONDS), _unit(file[arrays[1]], PER_SECOND))
        return _split(path, times, gradients, units)


def write_hdf5(path: Path, histories: tuple[GradientHistory, ...]) -> None:
    """Datasets `t` and `gradient`, with their units."""
    times, gradients = _joined(histories)
    with _h5py().File(path, "w") as file:
        file.create_dataset("t", data=times).attrs["unit"] = "s"
        file.create_dataset("gradient", data=gradients).attrs["unit"] = "1/s"


def _unit(dataset: Any, known: Container[str]) -> str | None:
    """What the attribute `unit` of a dataset says, if it is understood."""
    given = dataset.attrs.get("unit")
    unit = inverse_time_unit(given.decode("utf-8", "replace") if isinstance(given, bytes) else str(given))
    return unit if unit in known else None


def _h5py() -> Any:
    try:
        return import_module("h5py")
    except ImportError:
        raise ImportError("HDF5 files need the package h5py: pip install 'rheoclast[hdf5]', or use NPZ") from None


@contextmanager
def _opened(path: Path, opening: Callable[[Path], Any]) -> Iterator[Any]:
    """A file of arrays as its library opens it."""
    if not path.is_file():
        raise FileNotFoundError(f"{path}: there is no such file; check its name and the current folder, {Path.cwd()}")
    try:
        found = opening(path)
    except (OSError, ValueError, EOFError, BadZipFile) as error:
        raise FileFormatError(f"{path}: expected a file of arrays as its suffix or format= says ({error})") from None
    try:
        yield found
    finally:
        if not isinstance(found, np.ndarray):
            found.close()


def _taken(path: Path, holder: Any, name: str) -> NDArray[Any]:
    """One array of an archive by its name."""
    if isinstance(holder, np.ndarray) or name not in holder:
        found = "one array without a name" if isinstance(holder, np.ndarray) else repr(", ".join(holder))
        raise FileFormatError(
            f"{path}: expected an array {name!r}, got {found:.80}; "
            "pass arrays= with the names of the instants and of the gradients"
        )
    try:
        return np.asarray(holder[name])
    except (OSError, ValueError, TypeError) as error:
        raise FileFormatError(f"{path}: expected numbers in {name!r}, got what cannot be read ({error})") from None


def _split(path: Path, times: NDArray[Any], gradients: NDArray[Any], units: Units = (None, None)) -> Iterator[Samples]:
    """Samples of every path from arrays of all; the units of instants and gradients where the file says them."""
    if times.dtype.kind not in "iuf" or gradients.dtype.kind not in "iuf":
        raise FileFormatError(f"{path}: expected numbers, got arrays of {times.dtype} and {gradients.dtype}")
    if gradients.shape[-1:] == (9,):
        gradients = gradients.reshape(*gradients.shape[:-1], 3, 3)
    instants = gradients.shape[:-2]
    if gradients.shape[-2:] != (3, 3) or len(instants) not in (1, 2) or times.shape not in (instants, instants[-1:]):
        raise FileFormatError(
            f"{path}: expected instants (T,) or (K, T) and gradients (T, 3, 3) or (K, T, 3, 3), "
            f"got {times.shape} and {gradients.shape}"
        )
    if len(instants) == 1:
        return iter([Samples("", times, gradients, *units)])
    times = np.broadcast_to(times, instants)
    return (Samples(f"trajectory {k}", *each, *units) for k, each in enumerate(zip(times, gradients, strict=True)))


def _joined(histories: tuple[GradientHistory, ...]) -> tuple[FloatArray, FloatArray]:
    """Instants (T,) and gradients (T, 3, 3) of one history, (K, T) and (K, T, 3, 3) of several."""
    times = np.stack([history.times for history in histories])
    gradients = np.stack([history.gradients for history in histories])
    return (times[0], gradients[0]) if len(histories) == 1 else (times, gradients)
