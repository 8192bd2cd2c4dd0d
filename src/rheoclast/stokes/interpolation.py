"""Flows of spheres in a cubic box, seen from afar: few coefficients, and the constant operators between them.

Lengths are in sides of the box, so that one set of operators serves all levels of an octree: the Oseen tensor
G = 1/r + rr/r³ only scales. Tractions are first spread to forces on a grid of Chebyshev nodes,

    w_β = ∫ ψ(u) L_β(x + a u) du,    L_β the interpolation polynomials of the box enlarged by the radius,

(Fong & Darve, J. Comput. Phys. 228 (2009) 8712). A Stokes flow outside a cube is given by its values on the cube, so
the flow of everything in the box is known beyond its neighbours once known on the surface of the cube of 27 boxes.
There the flows of spheres in the box span few directions X to any accuracy: the singular vectors of (flow on the
surface) ← (forces on the nodes) ← (tractions of spheres). A flow's components on X are the *coefficients* of the box,
c = Zᵀ w, and w is replaced by S c. Box to box: C_t = Sᵀ K_t S with K_t the Oseen tensor between the nodes; the
transpose of every step brings the velocity back, which keeps the whole symmetric.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, cached_property
from itertools import permutations, product
from typing import NamedTuple

import numpy as np
from scipy.linalg import svd
from scipy.spatial import cKDTree

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.stokes.basis import MultipoleBasis
from rheoclast.stokes.harmonics import real_harmonics, sphere_quadrature

QUADRATURE_DEGREE = 6  # of the polynomials resolved on a sphere, beyond the modes' own
SAMPLES = 1000  # flows that the coefficients are chosen by, at least; several times their number
Offset = tuple[int, int, int]


class Precision(NamedTuple):
    """Nodes per dimension, and the singular value relative to the largest at which coefficients end."""

    nodes: int
    truncation: float


@dataclass(frozen=True)
class Grid:
    """Tensor grid of Chebyshev nodes, n per dimension, in the cube |x_k| ≤ `half_width`."""

    count: int
    half_width: float

    @cached_property
    def line(self) -> FloatArray:
        """Nodes (n,) along one dimension."""
        return self.half_width * np.cos(np.pi * (np.arange(self.count) + 0.5) / self.count)

    @cached_property
    def points(self) -> FloatArray:
        """Nodes (n³, 3)."""
        return _cubed(self.line)

    def values(self, coordinates: FloatArray) -> FloatArray:
        """Interpolation polynomials (..., n) of one dimension at coordinates (...)."""
        at_nodes = 2 * np.polynomial.chebyshev.chebvander(self.line / self.half_width, self.count - 1) / self.count
        at_nodes[:, 0] /= 2
        return np.polynomial.chebyshev.chebvander(coordinates / self.half_width, self.count - 1) @ at_nodes.T


@dataclass(frozen=True, eq=False)
class BoxOperators:
    """The constant operators of boxes that hold spheres of a basis with radii up to `reach` sides.

    Attributes
    ----------
    project
        Z (3, n³, R), forces on the nodes to coefficients.
    represent
        S (3, n³, R), coefficients to forces on the nodes.
    transfers
        (8, R, R) coefficients of a child (row) to those of the parent (column); the octant's bits are x, y, z.
    kernels
        For one offset of each class under the symmetries of the cube, the factors (R, R_t) of C_t = Q_t R_tᵀ.
    symmetries
        Each signed permutation matrix of the cube, as bytes, with its matrix (R, R) on the coefficients.
    """

    basis: MultipoleBasis
    grid: Grid
    project: FloatArray
    represent: FloatArray
    transfers: FloatArray
    kernels: dict[Offset, tuple[FloatArray, FloatArray]]
    symmetries: dict[bytes, FloatArray]

    @property
    def rank(self) -> int:
        """Number R of coefficients."""
        return self.project.shape[2]

    def coefficients(self, centers: FloatArray, radii: FloatArray) -> FloatArray:
        """Coefficients (n, M, R) of unit tractions on spheres, (n, 3) from the centre of the box and of radii (n,)."""
        spread = _spread(self.basis.order, self.grid, centers, radii)
        nodes, count = spread.shape[2], len(radii)
        projected = np.stack(
            [(spread.reshape(-1, nodes) @ axis).reshape(count, -1, self.rank) for axis in self.project], axis=1
        )
        return _components(self.basis).reshape(self.basis.size, -1) @ projected.reshape(count, -1, self.rank)

    def factors(self, offset: Offset) -> tuple[FloatArray, FloatArray]:
        """Q and R (R, R_t), target and source coefficients, of the flow of a source box `offset` sides away."""
        matrix = self.symmetries[_turn_to(offset).tobytes()]
        target, source = self.kernels[_standard(offset)]
        return matrix @ target, matrix @ source


@cache
def box_operators(order: int, sides_per_radius: float, precision: Precision) -> BoxOperators:
    """Operators for spheres up to multipole order `order` and boxes of a side in largest radii."""
    basis, reach = MultipoleBasis(order), 1 / sides_per_radius
    grid = Grid(precision.nodes, 0.5 + reach)
    surface, weights = _cube_surface(1.5 - reach, precision.nodes + 2)
    flow = _oseen(surface, grid.points) * np.sqrt(np.tile(weights, 3))[:, None]
    samples = _samples(order, grid, reach)
    left, values, right = svd(flow @ samples, full_matrices=False, check_finite=False)
    rank = int(np.count_nonzero(values > precision.truncation * values[0]))
    modes = left[:, :rank]
    represent = samples @ (right[:rank].T / values[:rank])
    project = flow.T @ modes
    nodes = grid.count**3
    return BoxOperators(
        basis,
        grid,
        _checks.frozen(project.reshape(3, nodes, rank)),
        _checks.frozen(represent.reshape(3, nodes, rank)),
        _checks.frozen(_transfers(grid, project, represent)),
        _kernels(grid, represent, values[:rank] / values[0], precision.truncation),
        _symmetries(surface, modes),
    )


def _samples(order: int, grid: Grid, reach: float) -> FloatArray:
    """Forces (3 n³, …) on the nodes from all tractions of spheres on a grid that has the symmetry of the cube.

    Modes beyond order two are weak and smooth enough to be covered by the others.
    """
    basis = MultipoleBasis(min(order, 2))
    line = np.polynomial.legendre.leggauss(int(np.ceil(np.cbrt(SAMPLES / basis.size))))[0]
    centers = _cubed(line / 2)
    spread = _spread(basis.order, grid, centers, np.full(len(centers), reach))
    return np.einsum("mkl,nlb->kbnm", _components(basis), spread, optimize=True).reshape(3 * grid.count**3, -1)


def _components(basis: MultipoleBasis) -> FloatArray:
    """Cartesian components (M, 3, p²) of the modes on the harmonics of all ranks."""
    components = np.zeros((basis.size, 3, basis.order**2))
    for family, where in zip(basis.families, basis.slices, strict=True):
        components[where, :, family.rank**2 : (family.rank + 1) ** 2] = family.components.transpose(2, 0, 1)
    return components


def _spread(order: int, grid: Grid, centers: FloatArray, radii: FloatArray) -> FloatArray:
    """∫ Y_lm(u) L_β(x + a u) du for ranks l below the order, (n, p², nodes)."""
    directions, weights = sphere_quadrature(order - 1 + QUADRATURE_DEGREE)
    harmonics = np.concatenate([real_harmonics(rank, directions) for rank in range(order)], axis=1)
    x, y, z = np.moveaxis(grid.values(centers[:, None] + radii[:, None, None] * directions), 2, 0)
    plane = (weights[:, None] * harmonics).T[:, :, None] * x[:, None]  # (n, p², Q, n_x)
    depth = (y[..., :, None] * z[..., None, :]).reshape(len(radii), len(directions), -1)
    return (plane.transpose(0, 1, 3, 2).reshape(len(radii), -1, len(directions)) @ depth).reshape(
        len(radii), order**2, -1
    )


def _oseen(points: FloatArray, sources: FloatArray) -> FloatArray:
    """Oseen tensor (3 P, 3 S), component before point, between points (P, 3) and sources (S, 3)."""
    separation = points.T[:, :, None] - sources.T[:, None, :]
    inverse = 1 / np.sqrt(np.einsum("kps,kps->ps", separation, separation))
    tensor = np.empty((3, len(points), 3, len(sources)))
    for row, column in product(range(3), repeat=2):
        tensor[row, :, column] = separation[row] * separation[column] * inverse**2 + (row == column)
        tensor[row, :, column] *= inverse
    return tensor.reshape(3 * len(points), -1)


def _transfers(grid: Grid, project: FloatArray, represent: FloatArray) -> FloatArray:
    """Zᵀ (interpolation from the child's nodes to the parent's) S for the eight octants, transposed: (8, R, R)."""
    count, rank = grid.count, project.shape[1]
    line = [grid.values(grid.line / 2 + shift) for shift in (-0.25, 0.25)]  # (child's node, parent's polynomial)
    transfers = np.empty((8, rank, rank))
    for octant in range(8):
        x, y, z = (line[octant >> bit & 1] for bit in (2, 1, 0))
        forces = represent.reshape(3, count, count, count, rank)
        forces = np.einsum("kabcr,ai,bj,cl->kijlr", forces, x, y, z, optimize=True)
        transfers[octant] = forces.reshape(-1, rank).T @ project
    return transfers


def _kernels(
    grid: Grid, represent: FloatArray, weights: FloatArray, truncation: float
) -> dict[Offset, tuple[FloatArray, FloatArray]]:
    """Factors of C_t for the offsets 0 ≤ x ≤ y ≤ z, cut where the remainder times both weights is negligible."""
    standard = [(x, y, z) for z in (2, 3) for y in range(z + 1) for x in range(y + 1)]
    dense = {t: represent.T @ (_oseen(grid.points, grid.points + np.array(t)) @ represent) for t in standard}
    scaled = {t: weights[:, None] * matrix * weights for t, matrix in dense.items()}
    smallest = 0.3 * truncation * max(float(np.abs(matrix).max()) for matrix in scaled.values())
    return {t: _low_rank(matrix, weights, smallest) for t, matrix in scaled.items()}


def _low_rank(scaled: FloatArray, weights: FloatArray, smallest: float) -> tuple[FloatArray, FloatArray]:
    """Factors of the matrix with scaled elements, to a Frobenius norm `smallest` of the scaled remainder."""
    left, values, right = svd(scaled, check_finite=False)
    remainder = np.sqrt(np.cumsum(values[::-1] ** 2)[::-1])
    rank = max(1, int(np.count_nonzero(remainder > smallest)))
    return left[:, :rank] * values[:rank] / weights[:, None], right[:rank].T / weights[:, None]


def _symmetries(surface: FloatArray, modes: FloatArray) -> dict[bytes, FloatArray]:
    """How coefficients turn with the box, for the 48 signed permutations."""
    points = cKDTree(surface)
    fields = modes.reshape(3, len(surface), -1)
    symmetries = {}
    for turn in _turns():
        origin = np.asarray(points.query(surface @ turn)[1])  # turn⁻¹ of every point
        turned = np.einsum("kj,jpr->kpr", turn, fields[:, origin]).reshape(len(modes), -1)
        symmetries[turn.tobytes()] = modes.T @ turned
    return symmetries


@cache
def _turns() -> tuple[FloatArray, ...]:
    """The 48 signed permutation matrices."""
    return tuple(
        np.eye(3)[list(axes)] * np.array(signs)[:, None]
        for axes in permutations(range(3))
        for signs in product((1.0, -1.0), repeat=3)
    )


def _standard(offset: Offset) -> Offset:
    x, y, z = sorted(map(abs, offset))
    return x, y, z


def _turn_to(offset: Offset) -> FloatArray:
    """A signed permutation that carries the standard offset of its class to this one."""
    standard = np.array(_standard(offset))
    return next(turn for turn in _turns() if np.array_equal(turn @ standard, offset))


def _cube_surface(half_width: float, count: int) -> tuple[FloatArray, FloatArray]:
    """Gauss points (6 n², 3) and weights (6 n²,) on the surface of a cube."""
    line, weights = np.polynomial.legendre.leggauss(count)
    first, second = (half_width * a.ravel() for a in np.meshgrid(line, line, indexing="ij"))
    faces = [
        np.roll(np.stack([np.full(count**2, sign * half_width), first, second], axis=1), axis, axis=1)
        for axis, sign in product(range(3), (-1, 1))
    ]
    return np.concatenate(faces), np.tile(half_width**2 * np.outer(weights, weights).ravel(), 6)


def _cubed(line: FloatArray) -> FloatArray:
    return np.stack(np.meshgrid(line, line, line, indexing="ij"), axis=-1).reshape(-1, 3)
