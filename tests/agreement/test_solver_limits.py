"""The iterative solver at its limits: octrees of few spheres, unequal radii, memory, overlap, odd geometries."""

import numpy as np
import psutil
import pytest

import rheoclast as rc
from rheoclast.stokes import fast_mobility as module
from rheoclast.stokes.basis import MultipoleBasis
from rheoclast.stokes.dense import DenseCholesky
from rheoclast.stokes.far_field import far_field
from rheoclast.stokes.iterative import BlockConjugateGradients
from rheoclast.stokes.mobility import Mobility
from rheoclast.stokes.preconditioner import coarse_to_fine, inverse_factor

from .clusters import sticking_cluster

POLYDISPERSE = sticking_cluster(60, 2, (0.5, 1.5))


@pytest.fixture
def small_octrees(monkeypatch):
    monkeypatch.setattr(module, "FEWEST_IN_OCTREE", 100)
    monkeypatch.setattr(module, "FEWEST_IN_OCTREE_OF_BLOCKS", 100)
    monkeypatch.setattr("rheoclast.stokes.far_field.LEAF_SIDES", (6,))


@pytest.mark.parametrize("order", [1, 2, 3])
def test_fast_operator_with_octree_is_the_mobility_to_its_accuracy(order, small_octrees):
    """Unequal radii, whose order in the octree differs from that given; the lower order alike."""
    mobility = Mobility(*sticking_cluster(450, 4, (0.6, 1.2)), MultipoleBasis(order))
    fast = module.fast_mobility(mobility, accuracy=1e-4)
    for operator in [fast] if order == 1 else [fast, fast.lowered()]:
        direct, basis = operator.mobility, operator.mobility.basis
        assert operator.far.levels > 0
        tractions = np.random.default_rng(order).normal(size=(450, basis.size, 2))
        expected = direct @ tractions
        others = expected - basis.self_mobility[:, None] / direct.radii[:, None, None] * tractions
        assert np.linalg.norm(operator @ tractions - expected) < 1e-4 * np.linalg.norm(others)


def test_tolerance_beyond_the_far_field_is_not_refused(small_octrees):
    """The far field then has its finest accuracy, the residual is that of the approximate operator."""
    mobility = Mobility(*sticking_cluster(150, 7), MultipoleBasis(1))
    (solution,) = BlockConjugateGradients(1e-9).solve(mobility, mobility.ambient_velocities())
    assert solution.convergence.residual <= 1e-9


@pytest.mark.parametrize(("order", "expected"), [(1, [1]), (2, [1, 2]), (3, [1, 2, 3]), (4, [2, 3, 4])])
def test_orders_that_are_solved(order, expected):
    """Up to two below, each to its own tolerance: 3e-3 (2/p)^4 for those that serve the error bar of order p."""
    mobility = Mobility(*POLYDISPERSE, MultipoleBasis(order))
    found = BlockConjugateGradients(1e-6).solve(mobility, mobility.ambient_velocities())
    assert [each.order for each in found] == expected
    rough = 3e-3 * (2 / max(order, 2)) ** 4
    for each in found[:-1]:
        exact = DenseCholesky().solve(mobility, mobility.ambient_velocities())[each.order - 1].tractions
        assert each.convergence.residual <= rough
        assert np.abs(each.tractions - exact).max() < 3 * rough * np.abs(exact).max()


@pytest.mark.parametrize("order", [1, 2, 3, 4])
def test_iterations_of_every_order_are_few_for_unequal_radii(order):
    """At 1e-6; the lower orders with the factor of the highest."""
    mobility = Mobility(*POLYDISPERSE, MultipoleBasis(order))
    found = BlockConjugateGradients(1e-6).solve(mobility, mobility.ambient_velocities())
    assert all(each.convergence.iterations <= limit for each, limit in zip(found[::-1], (20, 10, 10), strict=False))


@pytest.mark.parametrize("order", [1, 2, 3])
def test_factor_with_all_spheres_is_the_inverse(order):
    """Conditioned on all before it, U Uᵀ is A⁻¹ to single precision times the condition number, below 1e3."""
    centers, radii = sticking_cluster(12, 5, (0.5, 1.5))
    basis = MultipoleBasis(order)
    factor, transposed = inverse_factor(centers, radii, basis, reach=1e3)
    unknowns = 12 * basis.size
    unit = np.eye(unknowns).reshape(12, basis.size, unknowns)
    upper, lower = ((each @ unit).reshape(unknowns, -1) for each in (factor, transposed))
    np.testing.assert_array_equal(upper, lower.T)
    matrix = Mobility(centers, radii, basis).matrix().transpose(1, 0, 3, 2).reshape(unknowns, unknowns)
    np.testing.assert_allclose(lower @ matrix @ upper, np.eye(unknowns), rtol=0, atol=1e-4)


def test_coarse_to_fine_is_maximin():
    """Each point is, of those left, the farthest from all before it, at the distance that is told."""
    points = np.random.default_rng(1).normal(size=(40, 3))
    order, scale = coarse_to_fine(points)
    assert order[0] == np.linalg.norm(points - points.mean(axis=0), axis=1).argmin()
    np.testing.assert_array_equal(np.sort(order), np.arange(40))
    for k in range(1, 40):
        nearest = np.linalg.norm(points[:, None] - points[order[:k]], axis=-1).min(axis=1)
        assert scale[k] == pytest.approx(nearest.max(), rel=1e-12)
        assert nearest[order[k]] == pytest.approx(nearest.max(), rel=1e-12)


def test_rows_in_pieces_make_no_difference(monkeypatch):
    mobility = Mobility(*POLYDISPERSE, MultipoleBasis(2))
    whole = mobility.matrix()
    for rows in (1, 7, 59):
        monkeypatch.setattr("rheoclast.stokes.mobility.ROWS_AT_A_TIME", rows)
        np.testing.assert_array_equal(mobility.matrix(), whole)


@pytest.mark.parametrize(("count", "order"), [(200, 2), (200, 3), (400, 3)])
def test_memory_of_the_iterative_solution_covers_what_is_kept(count, order):
    """Factor twice, near blocks, far field and eight blocks of vectors at least; not five times as much."""
    mobility = Mobility(*sticking_cluster(count, 1), MultipoleBasis(order))
    operator = module.fast_mobility(mobility, 2e-5)
    kept = sum(each.numbers.nbytes for each in inverse_factor(mobility.centers, mobility.radii, mobility.basis, 2.0))
    kept += operator.near.blocks.numbers.nbytes if order > 2 else 0
    kept += operator.far.memory if operator.far is not None else 0
    kept += 8 * 8 * 11 * count * mobility.basis.size
    assert 0.8 * kept < BlockConjugateGradients().memory(count, mobility.basis) < 5 * kept


def test_iterative_solution_refuses_what_does_not_fit(monkeypatch):
    mobility = Mobility(*sticking_cluster(40, 1), MultipoleBasis(3))
    needed = BlockConjugateGradients().memory(40, mobility.basis)
    free = type("Memory", (), {"available": 0.99 * needed})
    monkeypatch.setattr(psutil, "virtual_memory", lambda: free)
    with pytest.raises(MemoryError, match="order 3 of 40 spheres needs"):
        BlockConjugateGradients().solve(mobility, mobility.ambient_velocities())


def test_stored_blocks_refuse_what_does_not_fit(monkeypatch):
    mobility = Mobility(*sticking_cluster(40, 1), MultipoleBasis(3))
    free = type("Memory", (), {"available": 40 * 39 * 26**2 * 4 - 1})
    monkeypatch.setattr(psutil, "virtual_memory", lambda: free)
    with pytest.raises(MemoryError, match="order 3 of 40 spheres needs"):
        module.fast_mobility(mobility, 1e-4)


@pytest.mark.parametrize("layers", [(400, 1, 1), (20, 20, 1)], ids=["straight chain", "plane"])
def test_octants_without_a_box(layers):
    """Along an axis and in a plane some octants are empty at every level."""
    centers = 2.0 * np.indices(layers).reshape(3, -1).T
    field = far_field(centers, np.ones(400), MultipoleBasis(1), 1e-3, 4)
    assert field.levels > 1
    assert np.isfinite(field.apply(np.ones((400, 3, 2)))).all()


@pytest.mark.parametrize("count", [1, 2, 3])
def test_fewer_modes_than_right_sides_are_refused(count):
    mobility = Mobility(*sticking_cluster(count, 1), MultipoleBasis(2))
    message = f"11 right-hand sides need at least 4 spheres, got {count}; use DenseCholesky"
    with pytest.raises(ValueError, match=message):
        BlockConjugateGradients().solve(mobility, mobility.ambient_velocities())


@pytest.mark.parametrize("order", [1, 2, 3])
def test_four_spheres_are_enough(order):
    mobility = Mobility(*sticking_cluster(4, 1), MultipoleBasis(order))
    velocities = mobility.ambient_velocities()
    found = BlockConjugateGradients(1e-6).solve(mobility, velocities)[-1].tractions
    exact = DenseCholesky().solve(mobility, velocities)[-1].tractions
    np.testing.assert_allclose(found, exact, rtol=0, atol=1e-5 * np.abs(exact).max())


def test_iterative_solution_of_overlapping_spheres_says_so():
    spheres = rc.Spheres(np.array([[0.0, 0, 0], [0, 0, 1.5], [0, 1.5, 0], [1.5, 0, 0]]), 1.0, overlap_tolerance=1.0)
    with pytest.raises(rc.GeometryError, match="not positive definite"):
        rc.rigid_response(spheres, rc.StokesianDynamics(6, solver=BlockConjugateGradients()), viscosity=1.0)


def test_progress_stays_between_none_and_all():
    """Whatever the tolerance; one that is no share is refused."""
    mobility = Mobility(*POLYDISPERSE, MultipoleBasis(2))
    for tolerance in (0.99, 1e-3):
        steps = []
        solver = BlockConjugateGradients(tolerance)
        solver.solve(mobility, mobility.ambient_velocities(), lambda *step, to=steps: to.append(step))
        assert all(0 <= fraction <= 1 for _, fraction in steps)
    with pytest.raises(ValueError, match="tolerance: expected a share below 1, got 1"):
        BlockConjugateGradients(1.0)
