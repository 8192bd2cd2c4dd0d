"""SphereLoads: the one value that crosses from fluid to structure."""

import dataclasses

import numpy as np
import pytest

import rheoclast as rc


@pytest.mark.parametrize("batch", [(), (4,), (2, 3), (0,)])
def test_batches_keep_their_shape(batch):
    """Batch axes first, then sphere, then component."""
    force, torque = np.random.default_rng(1).normal(size=(2, *batch, 5, 3))
    loads = rc.SphereLoads(force, torque)
    np.testing.assert_array_equal(loads.force, force)
    np.testing.assert_array_equal(loads.torque, torque)


def test_lists_are_taken():
    """One load case may be written out."""
    loads = rc.SphereLoads([[1, 0, 0], [-1, 0, 0]], [[0, 0, 0], [0, 0, 0]])
    np.testing.assert_array_equal(loads.force, [[1.0, 0, 0], [-1.0, 0, 0]])


def test_loads_are_frozen_copies():
    """Later changes of the caller's arrays are not seen, and nothing can be assigned."""
    force = np.zeros((2, 3))
    loads = rc.SphereLoads(force, force)
    force[0, 0] = 1.0
    assert loads.force[0, 0] == 0.0
    with pytest.raises(dataclasses.FrozenInstanceError):
        loads.force = force
    for array in (loads.force, loads.torque):
        with pytest.raises(ValueError, match="read-only"):
            array[0, 0] = 1.0


def test_stacked_is_a_batch_with_the_largest_rounding():
    rng = np.random.default_rng(1)
    each = [rc.SphereLoads(*rng.normal(size=(2, 4, 3)), rounding) for rounding in (1e-9, 3e-9, 2e-9)]
    batch = rc.SphereLoads.stacked(each)
    assert batch.force.shape == batch.torque.shape == (3, 4, 3)
    for k, loads in enumerate(each):
        np.testing.assert_array_equal(batch.force[k], loads.force)
        np.testing.assert_array_equal(batch.torque[k], loads.torque)
    assert batch.rounding == 3e-9


@pytest.mark.parametrize(
    ("force", "torque", "message"),
    [
        (np.zeros(3), np.zeros(3), r"^force: expected shape \(N, 3\), got \(3,\)$"),
        (np.zeros((4, 2)), np.zeros((4, 2)), r"^force: expected shape \(N, 3\), got \(4, 2\)$"),
        (np.zeros((4, 3)), np.zeros((5, 3)), r"^torque: expected shape \(4, 3\), got \(5, 3\)$"),
        (np.zeros((2, 4, 3)), np.zeros((4, 3)), r"^torque: expected shape \(2, 4, 3\), got \(4, 3\)$"),
        ([[0, 0, 0], [0, np.nan, 0]], np.zeros((2, 3)), r"^force\[1, 1\]: expected a finite number, got nan$"),
        (np.zeros((2, 3)), [[0, 0, 0], [0, 0, np.inf]], r"^torque\[1, 2\]: expected a finite number, got inf$"),
        ("abc", np.zeros((2, 3)), r"^force: expected numbers in an array of shape \(N, 3\), got 'abc'$"),
    ],
)
def test_refused_loads(force, torque, message):
    """Force and torque come in pairs of one shape and are finite."""
    with pytest.raises(ValueError, match=message):
        rc.SphereLoads(force, torque)
