"""Validation at the public boundary: what passes, what is refused, and that the message helps."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import rheoclast as rc
from rheoclast import _checks


def test_real_array_copies_and_freezes():
    """The caller's array stays writable and later changes to it are not seen."""
    given = np.array([[1, 2, 3]])
    kept = _checks.real_array("x", given, ("N", 3))
    given[0, 0] = 9
    assert kept.dtype == np.float64
    assert kept.tolist() == [[1.0, 2.0, 3.0]]
    with pytest.raises(ValueError, match="read-only"):
        kept[0, 0] = 0.0


def test_frozen_returns_the_same_array():
    """Freezing does not copy."""
    array = np.zeros(3)
    assert _checks.frozen(array) is array
    assert not array.flags.writeable


@pytest.mark.parametrize(
    ("value", "shape", "message"),
    [
        ("nonsense", ("N", 3), r"^x: expected numbers in an array of shape \(N, 3\), got 'nonsense'$"),
        (
            [[1.0, 2.0], [3.0]],
            ("N", 2),
            r"^x: expected numbers in an array of shape \(N, 2\), got \[\[1\.0, 2\.0\], \[3\.0\]\]$",
        ),
        (None, (3,), r"^x: expected numbers in an array of shape \(3,\), got None$"),
        (1 + 2j, (), r"^x: expected a number, got \(1\+2j\)$"),
        ([1.0, 2.0], (3,), r"^x: expected shape \(3,\), got \(2,\)$"),
        ([1.0, 2.0], ("N", 3), r"^x: expected shape \(N, 3\), got \(2,\)$"),
        (np.zeros((4, 2)), ("N", 3), r"^x: expected shape \(N, 3\), got \(4, 2\)$"),
        ([[0, 0, 0], [0, np.nan, 0]], ("N", 3), r"^x\[1, 1\]: expected a finite number, got nan$"),
        ([0, 0, -np.inf], ("N",), r"^x\[2\]: expected a finite number, got -inf$"),
        (np.inf, (), r"^x: expected a finite number, got inf$"),
    ],
)
def test_real_array_says_what_is_wrong(value, shape, message):
    """The message has the name, what was expected, what came, and which entry."""
    with pytest.raises(ValueError, match=message):
        _checks.real_array("x", value, shape)


@pytest.mark.parametrize(
    ("value", "shape", "message"),
    [
        ([1.0, 0.0], ("N",), r"^x\[1\]: expected a positive number, got 0$"),
        ([1.0, 2.0, -0.25], ("N",), r"^x\[2\]: expected a positive number, got -0\.25$"),
        ([[1.0], [-2.0]], ("N", 1), r"^x\[1, 0\]: expected a positive number, got -2$"),
        (-3.0, (), r"^x: expected a positive number, got -3$"),
        ([1.0, np.nan], ("N",), r"^x\[1\]: expected a finite number, got nan$"),
    ],
)
def test_positive_array_refuses(value, shape, message):
    """Zero, negative and undefined entries are named."""
    with pytest.raises(ValueError, match=message):
        _checks.positive_array("x", value, shape)


def test_positive_and_not_negative_return_floats():
    """Zero is the only number on which the two differ."""
    assert _checks.positive("x", 2) == 2.0
    assert isinstance(_checks.positive("x", np.int64(2)), float)
    assert _checks.not_negative("x", 0) == 0.0
    with pytest.raises(ValueError, match=r"^x: expected a positive number, got 0$"):
        _checks.positive("x", 0)
    with pytest.raises(ValueError, match=r"^x: expected zero or a positive number, got -0\.5$"):
        _checks.not_negative("x", -0.5)
    with pytest.raises(ValueError, match=r"^x: expected shape \(\), got \(2,\)$"):
        _checks.not_negative("x", [1.0, 2.0])


def test_rotation_matrix_takes_matrices_and_scipy_rotations():
    """Both spellings of a rotation give the same matrix."""
    turn = Rotation.from_rotvec([0.3, -1.2, 0.7])
    np.testing.assert_array_equal(_checks.rotation_matrix("R", turn), turn.as_matrix())
    np.testing.assert_array_equal(_checks.rotation_matrix("R", turn.as_matrix().tolist()), turn.as_matrix())


@pytest.mark.parametrize(
    ("matrix", "message"),
    [
        (
            np.diag([1.0, 1.0, -1.0]),
            r"^R: expected a rotation matrix, got one with \|R Rᵀ − 1\| = 0 and determinant -1$",
        ),
        (2 * np.eye(3), r"^R: expected a rotation matrix, got one with \|R Rᵀ − 1\| = 3 and determinant 8$"),
        (np.eye(3) + 1e-6, r"^R: expected a rotation matrix, got one with \|R Rᵀ − 1\| = 2e-06 and determinant 1$"),
        (np.eye(2), r"^R: expected shape \(3, 3\), got \(2, 2\)$"),
    ],
)
def test_rotation_matrix_refuses(matrix, message):
    """Reflections, stretches and near-rotations are refused with the size of the deviation."""
    with pytest.raises(ValueError, match=message):
        _checks.rotation_matrix("R", matrix)


def test_instances_looks_at_the_classes_in_a_signature():
    """Positional and named arguments, subclasses too; others and None pass to the function as they are."""

    @_checks.instances
    def told(spheres: "Spheres", flow: "LinearFlow", other: int = 0) -> tuple[object, object, int]:
        """Its text."""
        return spheres, flow, other

    class Spheres: ...

    class Hollow(Spheres): ...

    class LinearFlow: ...

    hollow, flow = Hollow(), LinearFlow()
    assert told(hollow, flow=flow, other="any") == (hollow, flow, "any")
    assert told.__doc__ == "Its text."
    with pytest.raises(TypeError, match=r"^spheres: expected Spheres, got LinearFlow; make them with Spheres\("):
        told(flow, flow)
    with pytest.raises(TypeError, match=r"^flow: expected LinearFlow, got the class LinearFlow; for instance simple_"):
        told(hollow, flow=LinearFlow)
    with pytest.raises(TypeError, match="missing 1 required positional argument: 'flow'"):
        told(hollow)


def test_advice_is_there_for_every_class_that_is_named():
    assert {name for name in _checks.HOW_TO_MAKE if not hasattr(rc, name)} == set()


def test_seeded_gives_equal_numbers_for_equal_seeds():
    assert _checks.seeded(3).random() == _checks.seeded(np.int64(3)).random() != _checks.seeded(4).random()
    for seed in (-1, None, 1.0, True):
        with pytest.raises(ValueError, match=r"^seed: expected an integer of at least 0, got"):
            _checks.seeded(seed)
