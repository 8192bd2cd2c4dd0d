"""Measures of shape and coordination against closed forms, definitions and a convex optimizer."""

import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.spatial.transform import Rotation

import rheoclast as rc
from rheoclast.particles.morphology import (
    anisotropy,
    coordination_distribution,
    enclosing_porosity,
    enclosing_radius,
    enclosing_sphere,
    gyration_tensor,
    loops,
    mean_coordination,
    porosity,
    radius_of_gyration,
    relative_shape_anisotropy,
)

BALL = rc.Spheres([[3.0, -1, 2]], 2.0)


def scattered(seed, count, largest=2.0):
    """Spheres of many sizes anywhere, overlap allowed."""
    rng = np.random.default_rng(seed)
    return rc.Spheres(9 * rng.normal(size=(count, 3)), rng.uniform(0.1, largest, count), overlap_tolerance=2.0)


def chain(count):
    return rc.Spheres(np.stack([2.0 * np.arange(count), np.zeros(count), np.zeros(count)], axis=1), 1.0)


def square(side):
    """Layer of side × side touching spheres."""
    x, y = np.divmod(np.arange(side**2), side)
    return rc.Spheres(2.0 * np.stack([x, y, 0 * x], axis=1), 1.0)


def test_gyration_tensor_of_a_ball_and_a_chain():
    """A ball has a²/5 in every direction; a chain adds the spread (N² − 1)/3 of its centres along itself."""
    np.testing.assert_allclose(gyration_tensor(BALL), 4 / 5 * np.eye(3), rtol=1e-14, atol=1e-15)
    expected = np.diag([(7**2 - 1) / 3, 0, 0]) + 0.2 * np.eye(3)
    np.testing.assert_allclose(gyration_tensor(chain(7)), expected, rtol=1e-14, atol=1e-15)


@pytest.mark.parametrize("seed", range(3))
def test_gyration_tensor_laws(seed):
    """Its trace is the squared radius of gyration; it turns with the spheres and does not move with them."""
    spheres = scattered(seed, 12)
    tensor = gyration_tensor(spheres)
    assert np.trace(tensor) == pytest.approx(radius_of_gyration(spheres) ** 2, rel=1e-13)
    turn = Rotation.random(random_state=seed)
    expected = turn.as_matrix() @ tensor @ turn.as_matrix().T
    np.testing.assert_allclose(gyration_tensor(spheres.rotated(turn)), expected, rtol=1e-11, atol=1e-11)
    moved = rc.Spheres(spheres.centers + np.array([5.0, -2, 1]), spheres.radii, overlap_tolerance=2.0)
    np.testing.assert_allclose(gyration_tensor(moved), tensor, rtol=1e-11, atol=1e-11)


def test_anisotropies_of_ball_chain_and_layer():
    """Ball 1 and 0; chain of N ratio 1 + 5 (N² − 1)/3; long chain κ² → 1; wide layer κ² → 1/4."""
    assert anisotropy(BALL) == pytest.approx(1, rel=1e-14)
    assert relative_shape_anisotropy(BALL) == pytest.approx(0, abs=1e-15)
    assert anisotropy(chain(10)) == pytest.approx(1 + 5 * 99 / 3, rel=1e-13)
    assert relative_shape_anisotropy(chain(500)) == pytest.approx(1, abs=1e-4)
    assert relative_shape_anisotropy(square(40)) == pytest.approx(1 / 4, abs=1e-3)


@pytest.mark.parametrize("seed", range(3))
def test_relative_shape_anisotropy_by_its_eigenvalues(seed):
    """1 − 3 (λ1 λ2 + λ2 λ3 + λ3 λ1) / (λ1 + λ2 + λ3)²."""
    spheres = scattered(seed, 8)
    a, b, c = np.linalg.eigvalsh(gyration_tensor(spheres))
    assert relative_shape_anisotropy(spheres) == pytest.approx(
        1 - 3 * (a * b + b * c + c * a) / (a + b + c) ** 2, rel=1e-12
    )


def test_enclosing_sphere_closed_forms():
    """One ball; balls inside another; two apart; four at the corners of a tetrahedron; a cube of eight; a chain."""
    assert enclosing_radius(BALL) == 2
    np.testing.assert_allclose(enclosing_sphere(BALL)[0], [3, -1, 2], rtol=1e-14)
    nested = rc.Spheres([[0, 0, 0], [2, 0, 0], [0.1, 0.2, 1]], [5.0, 3.0, 0.5], overlap_tolerance=2.0)
    assert enclosing_radius(nested) == pytest.approx(5, rel=1e-13)
    center, radius = enclosing_sphere(rc.Spheres([[0, 0, 0], [0, 0, 10]], [1.0, 3.0]))
    assert radius == pytest.approx(7, rel=1e-13)
    np.testing.assert_allclose(center, [0, 0, 6], atol=1e-12)
    tetrahedron = rc.Spheres(np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) / np.sqrt(2), 1.0)
    assert enclosing_radius(tetrahedron) == pytest.approx(1 + np.sqrt(3 / 2), rel=1e-13)
    cube = rc.Spheres(2.0 * np.stack(np.meshgrid([0, 1], [0, 1], [0, 1]), axis=-1).reshape(-1, 3), 1.0)
    assert enclosing_radius(cube) == pytest.approx(1 + np.sqrt(3), rel=1e-13)
    assert enclosing_radius(chain(400)) == pytest.approx(400, rel=1e-13)


@pytest.mark.parametrize(("seed", "count"), [(0, 2), (1, 3), (2, 5), (3, 60), (4, 300)])
def test_enclosing_sphere_by_convex_optimization(seed, count):
    """It encloses every sphere, and no sphere that does is smaller."""
    spheres = scattered(seed, count, largest=6.0)
    center, radius = enclosing_sphere(spheres)
    reach = np.linalg.norm(spheres.centers - center, axis=1) + spheres.radii
    assert reach.max() <= radius * (1 + 1e-11)
    best = minimize(
        lambda y: y[3],
        [*spheres.centers.mean(axis=0), 100.0],
        jac=lambda y: np.array([0, 0, 0, 1.0]),
        constraints={
            "type": "ineq",
            "fun": lambda y: y[3] - spheres.radii - np.linalg.norm(spheres.centers - y[:3], axis=1),
        },
        method="SLSQP",
        options={"ftol": 1e-14, "maxiter": 300},
    )
    assert radius == pytest.approx(best.fun, rel=1e-7)


def test_porosities():
    """None in one ball; a chain of N has 1 − N / (5/3 Rg²)^(3/2) and 1 − 1/N²; both keep their value in other units."""
    assert porosity(BALL) == pytest.approx(0, abs=1e-14)
    assert enclosing_porosity(BALL) == pytest.approx(0, abs=1e-14)
    gyration2 = (10**2 - 1) / 3 + 0.6
    assert porosity(chain(10)) == pytest.approx(1 - 10 / (5 / 3 * gyration2) ** 1.5, rel=1e-12)
    assert enclosing_porosity(chain(10)) == pytest.approx(1 - 1 / 100, rel=1e-12)
    assert porosity(chain(10).scaled(1e-7)) == pytest.approx(porosity(chain(10)), rel=1e-12)
    assert enclosing_porosity(chain(10).scaled(1e-7)) == pytest.approx(0.99, rel=1e-12)


def test_coordination_of_a_square_layer():
    """Side s: 2 s (s − 1) contacts, four corners with 2, 4 (s − 2) edges with 3, the rest with 4; (s − 1)² loops."""
    layer = rc.Aggregate.touching(square(5))
    np.testing.assert_allclose(coordination_distribution(layer), np.array([0, 0, 4, 12, 9]) / 25, rtol=1e-15)
    assert mean_coordination(layer) == pytest.approx(80 / 25, rel=1e-15)
    assert loops(layer) == 16


def test_coordination_of_a_tree():
    """2 − 2/N contacts per sphere and no loop; the distribution sums to one and has the mean as its mean."""
    tree = rc.Aggregate.touching(chain(9))
    assert mean_coordination(tree) == pytest.approx(2 - 2 / 9, rel=1e-15)
    assert loops(tree) == 0
    share = coordination_distribution(tree)
    assert share.sum() == pytest.approx(1, rel=1e-15)
    assert share @ np.arange(len(share)) == pytest.approx(mean_coordination(tree), rel=1e-15)
