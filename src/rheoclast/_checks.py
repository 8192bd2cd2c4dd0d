"""Validation at the public boundary: every value is checked once, and arrays become read-only.

Messages say what was expected, what came, which item, and what to do.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.intp]


def real_array(
    name: str, value: ArrayLike, shape: tuple[int | str, ...], *, infinite_allowed: bool = False
) -> FloatArray:
    """Read-only float array of a given shape with finite entries.

    A string in `shape` stands for any length and names it in the message; the first axis counts the items.
    """
    try:
        given = np.asarray(value)
        if given.dtype.kind not in "biuf":
            raise TypeError
        array = given.astype(np.float64)
    except (TypeError, ValueError):
        if not shape:
            raise ValueError(f"{name}: expected a number, got {value!r:.60}") from None
        raise ValueError(f"{name}: expected numbers in an array of shape {_shown(shape)}, got {value!r:.60}") from None
    fits = array.ndim == len(shape) and all(
        isinstance(want, str) or want == got for want, got in zip(shape, array.shape, strict=True)
    )
    if not fits:
        raise ValueError(f"{name}: expected shape {_shown(shape)}, got {_shown(array.shape)}")
    bad = np.argwhere(np.isnan(array) if infinite_allowed else ~np.isfinite(array))
    if len(bad):
        index = tuple(int(k) for k in bad[0])
        raise ValueError(f"{name}{list(index) if index else ''}: expected a finite number, got {array[index]}")
    return frozen(array)


def positive_array(
    name: str, value: ArrayLike, shape: tuple[int | str, ...], *, infinite_allowed: bool = False
) -> FloatArray:
    """Like `real_array`, every entry greater than zero."""
    array = real_array(name, value, shape, infinite_allowed=infinite_allowed)
    bad = np.argwhere(array <= 0)
    if len(bad):
        index = tuple(int(k) for k in bad[0])
        where = f"{name}{list(index)}" if index else name
        raise ValueError(f"{where}: expected a positive number, got {array[index]:g}")
    return array


def positive(name: str, value: Any) -> float:
    """A finite number greater than zero."""
    return float(positive_array(name, value, ()))


def not_negative(name: str, value: Any) -> float:
    """A finite number that is zero or greater."""
    number = float(real_array(name, value, ()))
    if number < 0:
        raise ValueError(f"{name}: expected zero or a positive number, got {number:g}")
    return number


def whole_number(name: str, value: Any, least: int) -> int:
    """An integer of at least `least`."""
    if isinstance(value, bool | np.bool_) or not isinstance(value, int | np.integer) or value < least:
        raise ValueError(f"{name}: expected an integer of at least {least}, got {value!r}")
    return int(value)


def rotation_matrix(name: str, value: Any) -> FloatArray:
    """Proper orthogonal (3, 3) matrix, from a matrix or a `scipy.spatial.transform.Rotation`."""
    as_matrix = getattr(value, "as_matrix", None)
    matrix = real_array(name, value if as_matrix is None else as_matrix(), (3, 3))
    deviation = float(np.abs(matrix @ matrix.T - np.eye(3)).max())
    if deviation > 1e-9 or np.linalg.det(matrix) < 0:
        raise ValueError(
            f"{name}: expected a rotation matrix, got one with |R Rᵀ − 1| = {deviation:.2g} "
            f"and determinant {np.linalg.det(matrix):.3g}"
        )
    return matrix


def frozen(array: NDArray[Any]) -> NDArray[Any]:
    """The same array, made read-only."""
    array.flags.writeable = False
    return array


def _shown(shape: tuple[int | str, ...]) -> str:
    return "(" + ", ".join(map(str, shape)) + ("," if len(shape) == 1 else "") + ")"


def instance(name: str, value: object, kind: type, advice: str) -> None:
    """Refuse a value of another type.

    Raises
    ------
    TypeError
        With the types expected and received, and what to do.
    """
    if not isinstance(value, kind):
        got = f"the class {value.__name__}" if isinstance(value, type) else type(value).__name__
        raise TypeError(f"{name}: expected {kind.__name__}, got {got}; {advice}")
