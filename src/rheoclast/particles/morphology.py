"""Measures of an aggregate's size, shape and coordination. Lengths are in m; mass is at uniform density.

Sources: relative shape anisotropy, D. N. Theodorou & U. W. Suter, Macromolecules 18 (1985) 1206; ratio of the squared
principal radii, W. R. Heinson, C. M. Sorensen & A. Chakrabarti, Aerosol Sci. Technol. 44 (2010) i; smallest enclosing
ball of balls, K. Fischer & B. Gärtner, Int. J. Comput. Geom. Appl. 14 (2004) 341.
"""

from __future__ import annotations

from itertools import combinations

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial import ConvexHull, QhullError

from rheoclast._checks import FloatArray, IntArray, instances, real_array
from rheoclast.particles.aggregate import Aggregate
from rheoclast.particles.spheres import Spheres

ENCLOSING_ROUNDING = 1e-12


@instances
def radius_of_gyration(spheres: Spheres) -> float:
    """Radius of gyration in m, at uniform density, the spheres' own extent included.

    Rg² = Σ m (|x − x_c|² + 3/5 a²) / Σ m with m the volume of each sphere.
    """
    distance2 = np.sum((spheres.centers - spheres.center_of_mass) ** 2, axis=1)
    return float(np.sqrt(np.average(distance2 + 0.6 * spheres.radii**2, weights=spheres.volumes)))


@instances
def gyration_tensor(spheres: Spheres) -> FloatArray:
    """Gyration tensor (3, 3) in m² about the centre of mass, the spheres' own extent included; its trace is Rg².

    G = Σ m ((x − x_c)(x − x_c)ᵀ + a²/5 I) / Σ m with m the volume of each sphere.
    """
    offset = spheres.centers - spheres.center_of_mass
    share = spheres.volumes / spheres.volumes.sum()
    return np.einsum("n,ni,nj->ij", share, offset, offset) + 0.2 * np.dot(share, spheres.radii**2) * np.eye(3)


@instances
def anisotropy(spheres: Spheres) -> float:
    """Ratio of the largest to the smallest eigenvalue of the gyration tensor: 1 for a ball, finite for a chain too."""
    smallest, _, largest = np.linalg.eigvalsh(gyration_tensor(spheres))
    return float(largest / smallest)


@instances
def relative_shape_anisotropy(spheres: Spheres) -> float:
    """Relative shape anisotropy κ² of the gyration tensor: 0 for a ball, towards 1/4 for a disc and 1 for a rod.

    κ² = 1 − 3 (λ1 λ2 + λ2 λ3 + λ3 λ1) / (λ1 + λ2 + λ3)² with λ the eigenvalues.
    """
    tensor = gyration_tensor(spheres)
    deviator = tensor - np.trace(tensor) / 3 * np.eye(3)
    return float(1.5 * np.sum(deviator**2) / np.trace(tensor) ** 2)


@instances
def porosity(spheres: Spheres) -> float:
    """Share of void in the homogeneous ball of equal radius of gyration, whose radius is sqrt(5/3) Rg; in [0, 1).

    It weighs all of the mass, so that a single protruding branch does not decide it as in `enclosing_porosity`.
    """
    return _void_share(spheres, np.sqrt(5 / 3) * radius_of_gyration(spheres))


@instances
def enclosing_porosity(spheres: Spheres) -> float:
    """Share of void in the smallest sphere that encloses all spheres; in [0, 1)."""
    return _void_share(spheres, enclosing_radius(spheres))


def _void_share(spheres: Spheres, radius: float) -> float:
    return max(0.0, 1 - float(np.sum((spheres.radii / radius) ** 3)))


@instances
def enclosing_radius(spheres: Spheres) -> float:
    """Radius in m of the smallest sphere that encloses all spheres entirely."""
    return enclosing_sphere(spheres)[1]


@instances
def enclosing_sphere(spheres: Spheres) -> tuple[FloatArray, float]:
    """Centre (3,) and radius of the smallest sphere that encloses all spheres entirely, in m, exact but for rounding.

    At most four spheres support it. The farthest sphere outside the support's own enclosing sphere enters the support
    until none is outside; as the radius grows with every exchange, the same support cannot return.
    """
    length = float(spheres.radii.max())
    origin = spheres.center_of_mass
    balls = np.column_stack([spheres.centers - origin, spheres.radii]) / length
    support = balls[:1]
    center, radius = support[0, :3], support[0, 3]
    while True:
        reach = np.linalg.norm(balls[:, :3] - center, axis=1) + balls[:, 3]
        farthest = int(reach.argmax())
        if reach[farthest] <= radius * (1 + ENCLOSING_ROUNDING):
            return origin + length * center, length * float(radius)
        previous = radius
        support, center, radius = _smallest_support(np.vstack([support, balls[farthest]]))
        if radius <= previous:
            return origin + length * center, length * float(reach[farthest])


def _smallest_support(balls: FloatArray) -> tuple[FloatArray, FloatArray, float]:
    """Those of at most five balls (B, 4) that support their smallest enclosing sphere, its centre and radius."""
    best = balls, np.zeros(3), np.inf
    for size in range(1, min(len(balls), 4) + 1):
        for chosen in combinations(range(len(balls)), size):
            support = balls[list(chosen)]
            for center, radius in _tangent_spheres(support):
                reach = np.linalg.norm(balls[:, :3] - center, axis=1) + balls[:, 3]
                if radius < best[2] and reach.max() <= radius * (1 + ENCLOSING_ROUNDING):
                    best = support, center, radius
    return best


def _tangent_spheres(balls: FloatArray) -> list[tuple[FloatArray, float]]:
    """Spheres that all balls (B, 4) touch from inside, with their centre in the affine hull of the balls' centres.

    With x measured from the first ball, of radius a, and s = R − a, the equations |x − d_k| = s + a − a_k less |x| = s
    are linear in x and s, so that x = u + s v on the hull, and |u + s v|² = s² is quadratic in s.
    """
    first, larger = balls[0, :3], balls[1:, 3] - balls[0, 3]
    difference = balls[1:, :3] - first
    inverse = np.linalg.pinv(difference) if len(difference) else np.zeros((3, 0))
    u = inverse @ (0.5 * (np.sum(difference**2, axis=1) - larger**2))
    v = inverse @ larger
    roots = np.roots([v @ v - 1, 2 * u @ v, u @ u])
    return [(first + u + s * v, float(balls[0, 3] + s)) for s in roots[np.isreal(roots)].real if s >= 0]


@instances
def coordination_numbers(aggregate: Aggregate) -> IntArray:
    """Number of contacts of every sphere, (N,)."""
    return np.bincount(aggregate.pairs.ravel(), minlength=len(aggregate)).astype(np.intp)


@instances
def coordination_distribution(aggregate: Aggregate) -> FloatArray:
    """Share (K,) of the spheres that have 0, 1, … K − 1 contacts, with K − 1 the largest number that occurs."""
    return np.bincount(coordination_numbers(aggregate)) / len(aggregate)


@instances
def mean_coordination(aggregate: Aggregate) -> float:
    """Mean number of contacts of a sphere, 2 C / N: 2 − 2 / N for a tree."""
    return 2 * len(aggregate.pairs) / len(aggregate)


@instances
def loops(aggregate: Aggregate) -> int:
    """Number of independent cycles of contacts, C − N + 1: zero for a tree."""
    return len(aggregate.pairs) - len(aggregate) + 1


@instances
def depth(aggregate: Aggregate, points: ArrayLike) -> FloatArray:
    """How deep points (P, 3) between the spheres lie below the convex hull of the aggregate, (P,), in mean radii.

    The hull is that of the centres, moved outwards by the mean radius: exact for equal spheres. Contacts of planar and
    straight aggregates are at depth 1.
    """
    places = real_array("points", points, ("P", 3))
    length, origin = aggregate.spheres.mean_radius, aggregate.spheres.center_of_mass
    try:
        faces = ConvexHull((aggregate.spheres.centers - origin) / length).equations
    except (QhullError, ValueError):  # flat, straight, or fewer than four spheres
        return np.ones(len(places))
    below = -((places - origin) / length @ faces[:, :3].T + faces[:, 3])
    return 1 + below.min(axis=1)


@instances
def radial_position(aggregate: Aggregate, points: ArrayLike) -> FloatArray:
    """Distance (...) of points (..., 3) from the centre of mass over the radius of gyration."""
    offset = real_array("points", points, (*np.shape(points)[:-1], 3)) - aggregate.spheres.center_of_mass
    return np.linalg.norm(offset, axis=-1) / radius_of_gyration(aggregate.spheres)
