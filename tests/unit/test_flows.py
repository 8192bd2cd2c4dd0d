"""Linear flows against the definitions of gradient, curl, strain rate and rotation."""

import dataclasses

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import rheoclast as rc

NAMED = [rc.simple_shear, rc.uniaxial_extension, rc.biaxial_extension, rc.planar_extension]


def random_flow(seed):
    gradient = np.random.default_rng(seed).normal(size=(3, 3))
    return rc.LinearFlow(gradient - np.trace(gradient) / 3 * np.eye(3))


def derivatives(flow, point, step=0.5):
    """du_i/dx_j by central differences, exact up to rounding for a linear flow."""
    columns = []
    for axis in range(3):
        offset = step * np.eye(3)[axis]
        columns.append((flow.velocity(point + offset) - flow.velocity(point - offset)) / (2 * step))
    return np.stack(columns, axis=1)


@pytest.mark.parametrize("seed", range(3))
def test_gradient_strain_and_spin_by_finite_differences(seed):
    """Γ, E and ½ curl u are what differences of the velocity say; the flow is incompressible."""
    flow = random_flow(seed)
    d = derivatives(flow, np.array([0.3, -0.7, 1.1]))
    np.testing.assert_allclose(flow.gradient, d, atol=1e-13)
    np.testing.assert_allclose(flow.strain_rate, (d + d.T) / 2, atol=1e-13)
    curl = np.array([d[2, 1] - d[1, 2], d[0, 2] - d[2, 0], d[1, 0] - d[0, 1]])
    np.testing.assert_allclose(flow.angular_velocity, curl / 2, atol=1e-13)
    assert abs(np.trace(d)) < 1e-13


def test_velocity_is_strain_plus_rigid_rotation():
    """The velocity is E·x + ω × x, zero at the origin of coordinates, for points in any batch."""
    flow = random_flow(5)
    points = np.random.default_rng(6).normal(size=(2, 4, 3))
    expected = points @ flow.strain_rate + np.cross(flow.angular_velocity, points)
    np.testing.assert_allclose(flow.velocity(points), expected, atol=1e-14)
    np.testing.assert_array_equal(flow.velocity(np.zeros(3)), np.zeros(3))
    assert flow.velocity(points).shape == (2, 4, 3)


def test_named_flows_by_definition_of_their_rate():
    """Shear rate is du_x/dy; extension rates are the rates of stretching along the named axes."""
    x, y, z = point = np.array([2.0, 3.0, 5.0])
    np.testing.assert_allclose(rc.simple_shear(7.0).velocity(point), [7 * y, 0, 0])
    np.testing.assert_allclose(rc.uniaxial_extension(7.0).velocity(point), [-3.5 * x, -3.5 * y, 7 * z])
    np.testing.assert_allclose(rc.biaxial_extension(7.0).velocity(point), [7 * x, 7 * y, -14 * z])
    np.testing.assert_allclose(rc.planar_extension(7.0).velocity(point), [7 * x, -7 * y, 0])


@pytest.mark.parametrize(
    ("named", "magnitude", "principal"),
    [
        (rc.simple_shear, 1.0, [0.5, 0.0, -0.5]),
        (rc.uniaxial_extension, np.sqrt(3), [1.0, -0.5, -0.5]),
        (rc.biaxial_extension, np.sqrt(12), [1.0, 1.0, -2.0]),
        (rc.planar_extension, 2.0, [1.0, 0.0, -1.0]),
    ],
)
def test_magnitude_and_principal_rates_of_named_flows(named, magnitude, principal):
    """sqrt(2 E:E) by hand; eigenvalues from the largest to the smallest; the quoted rate is kept."""
    flow = named(4.0)
    assert flow.rate == 4.0
    assert flow.magnitude == pytest.approx(4 * magnitude, rel=1e-14)
    np.testing.assert_allclose(flow.principal_rates, 4 * np.array(principal), atol=1e-14)


def test_extensions_do_not_spin_and_shear_turns_clockwise():
    """Only the simple shear has vorticity: −rate/2 about z."""
    for named in NAMED[1:]:
        np.testing.assert_array_equal(named(3.0).angular_velocity, np.zeros(3))
    np.testing.assert_allclose(rc.simple_shear(3.0).angular_velocity, [0, 0, -1.5])


def test_rate_defaults_to_the_magnitude():
    """A flow given by its gradient alone is quoted by sqrt(2 E:E), whatever its vorticity."""
    flow = random_flow(7)
    strain = (flow.gradient + flow.gradient.T) / 2
    assert flow.rate == pytest.approx(np.sqrt(2 * np.trace(strain @ strain)), rel=1e-14)
    assert rc.LinearFlow(rc.simple_shear(3.0).gradient).rate == pytest.approx(3.0)
    assert rc.LinearFlow(np.zeros((3, 3))).rate == 0.0
    assert rc.LinearFlow([[0, 0, 2], [0, 0, 0], [-2, 0, 0]]).rate == 0.0


@pytest.mark.parametrize("as_matrix", [True, False])
def test_rotated_flow_by_definition(as_matrix):
    """u'(R x) = R u(x): the turned flow at the turned point is the turned velocity; rates stay."""
    flow, turn = random_flow(8), Rotation.from_rotvec([0.4, 1.9, -0.6])
    turned = flow.rotated(turn.as_matrix() if as_matrix else turn)
    points = np.random.default_rng(9).normal(size=(5, 3))
    np.testing.assert_allclose(turned.velocity(turn.apply(points)), turn.apply(flow.velocity(points)), atol=1e-13)
    np.testing.assert_allclose(turned.angular_velocity, turn.as_matrix() @ flow.angular_velocity, atol=1e-14)
    np.testing.assert_allclose(turned.principal_rates, flow.principal_rates, atol=1e-13)
    assert turned.rate == flow.rate


def test_rotations_compose():
    """Turning by A and then by B is turning by BA."""
    flow = random_flow(10)
    first, second = Rotation.random(2, rng=np.random.default_rng(11))
    np.testing.assert_allclose(
        flow.rotated(first).rotated(second).gradient, flow.rotated(second * first).gradient, atol=1e-13
    )


def test_scaled_flow():
    """Twice as fast: gradient and rate double; the quoted kind of rate is kept."""
    fast = rc.uniaxial_extension(3.0).scaled(2.0)
    np.testing.assert_array_equal(fast.gradient, rc.uniaxial_extension(6.0).gradient)
    assert fast.rate == 6.0
    assert rc.simple_shear(3.0).scaled(0).rate == 0.0


def test_flow_is_frozen():
    """Neither attributes nor arrays can be changed, and the caller's array is copied."""
    given = np.diag([1.0, -1.0, 0.0])
    flow = rc.LinearFlow(given)
    given[0, 0] = 5.0
    assert flow.gradient[0, 0] == 1.0
    with pytest.raises(dataclasses.FrozenInstanceError):
        flow.rate = 2.0
    for array in (flow.gradient, flow.strain_rate, flow.angular_velocity, flow.principal_rates):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0.0


@pytest.mark.parametrize(
    ("gradient", "message"),
    [
        (
            np.eye(3),
            r"^gradient: expected zero trace \(an incompressible flow\), got 3; "
            r"subtract trace/3 = 1 from the diagonal if it is rounding$",
        ),
        (np.diag([1.0, -1.0, 1e-8]), r"^gradient: expected zero trace .* got 1e-08; subtract trace/3 = 3\.33\d*e-09 "),
        (np.zeros((3, 2)), r"^gradient: expected shape \(3, 3\), got \(3, 2\)$"),
        (np.zeros((2, 3, 3)), r"^gradient: expected shape \(3, 3\), got \(2, 3, 3\)$"),
        (np.full((3, 3), np.nan), r"^gradient\[0, 0\]: expected a finite number, got nan$"),
    ],
)
def test_refused_gradients(gradient, message):
    """Sources, wrong shapes and undefined numbers are refused."""
    with pytest.raises(ValueError, match=message):
        rc.LinearFlow(gradient)


@pytest.mark.parametrize("size", [1e-12, 1.0, 1e12])
def test_trace_is_judged_relative_to_the_gradient(size):
    """Rounding in the trace passes and a real one does not, in any unit of time."""
    rc.LinearFlow(size * np.diag([1.0, 1.0, -2.0 + 1e-12]))
    with pytest.raises(ValueError, match="expected zero trace"):
        rc.LinearFlow(size * np.diag([1.0, 1.0, -2.0 + 1e-6]))


@pytest.mark.parametrize("named", NAMED)
def test_refused_rates(named):
    """A rate is zero or positive and finite."""
    assert named(0.0).rate == 0.0
    with pytest.raises(ValueError, match=r"^rate: expected zero or a positive number, got -2$"):
        named(-2.0)
    with pytest.raises(ValueError, match=r"^rate: expected a finite number, got nan$"):
        named(np.nan)
    with pytest.raises(ValueError, match=r"^rate: expected zero or a positive number, got -1$"):
        rc.LinearFlow(np.zeros((3, 3)), rate=-1.0)
    with pytest.raises(ValueError, match=r"^factor: expected zero or a positive number, got -1$"):
        named(1.0).scaled(-1.0)


def test_improper_rotation_is_refused():
    """A reflection is not an orientation."""
    with pytest.raises(ValueError, match=r"^rotation: expected a rotation matrix, got one with .* determinant -1$"):
        rc.simple_shear(1.0).rotated(-np.eye(3))
