"""Validation at the public boundary: every value is checked once, and arrays become read-only.

Messages say what was expected, what came, which item, and what to do.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from inspect import signature
from itertools import chain
from typing import Any, ParamSpec, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.intp]

P = ParamSpec("P")
T = TypeVar("T")

HOW_TO_MAKE = {
    "Spheres": "make them with Spheres(centers, radii), or take aggregate.spheres",
    "Aggregate": "make one with Aggregate.touching(spheres)",
    "Material": "for instance MATERIALS['polystyrene']",
    "Bonds": "make them with jkr_bonds(aggregate, material)",
    "LinearFlow": "for instance simple_shear(1e5)",
    "HydrodynamicModel": "for instance StokesianDynamics(order=2)",
    "RigidResponse": "make one with rigid_response(spheres, model, viscosity)",
    "ContactResponse": "make one with contact_response(aggregate, response, bonds)",
    "SphereLoads": "for instance response.loads(flow)",
    "ContactLoads": "for instance contact_loads(aggregate, response.loads(flow), bonds)",
    "Criterion": "for instance Tension()",
    "Initiation": "make one with initiation(table, bonds, flow)",
    "Trajectory": "make one with trajectory(response, flow)",
    "LoadHistory": "make one with load_history(trajectory, table, bonds)",
    "WaitingTimes": "make them with first_failure_times(histories)",
    "EventRate": "make one with breakage_rate(waiting)",
    "FragmentDistribution": "make one with fragment_distribution(breakups)",
    "Breakup": "make one with break_up(aggregate, response, bonds, flow)",
}


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


def seeded(seed: Any) -> np.random.Generator:
    """Random numbers that are the same for equal seeds."""
    return np.random.default_rng(whole_number("seed", seed, 0))


def rotation_matrix(name: str, value: Any, shape: tuple[int | str, ...] = (3, 3)) -> FloatArray:
    """Proper orthogonal matrices (..., 3, 3), from matrices or a `scipy.spatial.transform.Rotation`."""
    as_matrix = getattr(value, "as_matrix", None)
    matrix = real_array(name, value if as_matrix is None else as_matrix(), shape)
    deviation = np.abs(matrix @ np.swapaxes(matrix, -1, -2) - np.eye(3)).max(axis=(-2, -1))
    determinant = np.linalg.det(matrix)
    bad = np.argwhere((deviation > 1e-9) | (determinant < 0))
    if len(bad):
        index = tuple(int(k) for k in bad[0])
        raise ValueError(
            f"{name}{list(index) if index else ''}: expected a rotation matrix, "
            f"got one with |R Rᵀ − 1| = {deviation[index]:.2g} and determinant {determinant[index]:.3g}"
        )
    return matrix


def frozen(array: NDArray[Any]) -> NDArray[Any]:
    """The same array, made read-only."""
    array.flags.writeable = False
    return array


def _shown(shape: tuple[int | str, ...]) -> str:
    return "(" + ", ".join(map(str, shape)) + ("," if len(shape) == 1 else "") + ")"


def instance(name: str, value: object, kind: type | str, advice: str | None = None) -> None:
    """Refuse a value of another type, given as a class or by the name of one.

    Raises
    ------
    TypeError
        With the types expected and received, and what to do: the advice, by default that of `HOW_TO_MAKE`.
    """
    wanted = kind if isinstance(kind, str) else kind.__name__
    names = [each.__name__ for each in type(value).__mro__]
    if not (wanted in names if isinstance(kind, str) else isinstance(value, kind)):
        got = f"the class {value.__name__}" if isinstance(value, type) else type(value).__name__
        raise TypeError(f"{name}: expected {wanted}, got {got}; {advice or HOW_TO_MAKE[wanted]}")


def instances(function: Callable[P, T]) -> Callable[P, T]:
    """The function, which now refuses arguments that are not of the classes in its signature, as `instance` does."""
    names = signature(function).parameters
    wanted = {name: each.annotation for name, each in names.items() if each.annotation in HOW_TO_MAKE}

    @wraps(function)
    def checked(*args: P.args, **kwargs: P.kwargs) -> T:
        for name, value in chain(zip(names, args, strict=False), kwargs.items()):
            if name in wanted:
                instance(name, value, wanted[name])
        return function(*args, **kwargs)

    return checked


def set_fields(frozen_instance: object, **values: Any) -> None:
    """Give a frozen dataclass its fields, which only its own `__init__` or `__post_init__` may do."""
    for name, value in values.items():
        object.__setattr__(frozen_instance, name, value)
