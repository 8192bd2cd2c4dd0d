"""Fractal dimension: of an ensemble from its law of size, of one aggregate from its pair correlation.

N = k (Rg/a)^D with Rg as in `morphology.radius_of_gyration` and a the geometric mean of the sphere radii.

Sources: the law and its prefactor, C. M. Sorensen, Aerosol Sci. Technol. 45 (2011) 765; the dimension from pairs of
points within a distance, P. Grassberger & I. Procaccia, Physica D 9 (1983) 189; the jackknife over blocks,
H. R. Künsch, Ann. Stat. 17 (1989) 1217.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from rheoclast import _checks
from rheoclast._checks import FloatArray, IntArray
from rheoclast.fits import CONFIDENCE, straight_line, student_quantile
from rheoclast.particles.aggregate import Aggregate
from rheoclast.particles.morphology import radius_of_gyration
from rheoclast.particles.spheres import Spheres

SHORTEST_DISTANCE = 5.0
"""Mean radii: below, the shells of neighbours show; at an even number, rounding would decide who is within."""
SMALLEST_GYRATION = 8.0
"""Mean radii; below, no range of distances is left to fit."""
LONGEST_DISTANCE = 1.0
"""Radii of gyration."""
CORE = 0.5
"""Radii of gyration around the centre of mass within which spheres count their surroundings."""
DISTANCES = 30
HALVINGS = 3


@dataclass(frozen=True)
class FractalLaw:
    """N = prefactor (Rg/a)^dimension, each with the bounds of its confidence interval."""

    dimension: float
    dimension_interval: tuple[float, float]
    prefactor: float
    prefactor_interval: tuple[float, float]

    def count(self, gyration: float) -> float:
        """Number of spheres at a radius of gyration in sphere radii."""
        return self.prefactor * gyration**self.dimension


@dataclass(frozen=True)
class PairCorrelationDimension:
    """Fractal dimension of one aggregate, the bounds of its confidence interval and the range of distances in m."""

    dimension: float
    interval: tuple[float, float]
    distances: tuple[float, float]


def fractal_law(aggregates: Sequence[Aggregate], confidence: float = CONFIDENCE) -> FractalLaw:
    """Fractal dimension and prefactor by least squares of ln (Rg/a) on ln N over aggregates of several sizes.

    The number of spheres is what is chosen and the radius of gyration what scatters; the fit of ln N on ln Rg would
    take this scatter for a lower dimension. The intervals are Student's, for independent aggregates, and carry over
    to dimension and prefactor to first order. Aggregates of few spheres lie off the law, which they do not tell.

    Raises
    ------
    ValueError
        For fewer than three aggregates, if all have the same number of spheres, or if they do not grow with it.
    """
    for k, aggregate in enumerate(aggregates):
        _checks.instance(f"aggregates[{k}]", aggregate, Aggregate, "pass a sequence of aggregates")
    count = len(aggregates)
    if count < 3:
        raise ValueError(f"aggregates: expected at least 3, got {count}; add aggregates of other sizes")
    sizes = np.log([len(aggregate) for aggregate in aggregates])
    gyrations = np.log([_relative_gyration(aggregate.spheres) for aggregate in aggregates])
    if np.ptp(sizes) == 0:
        raise ValueError(f"aggregates: expected several sizes, got {count} of {len(aggregates[0])} spheres")
    line = straight_line(sizes, gyrations, confidence)
    if line.slope <= 0:
        raise ValueError("aggregates: expected radii of gyration that grow with the number of spheres, got a fall")
    intercept = -line.intercept / line.slope
    of_intercept = line.reach_at(intercept) / line.slope
    return FractalLaw(
        dimension=1 / line.slope,
        dimension_interval=(
            1 / (line.slope + line.slope_reach),
            1 / (line.slope - line.slope_reach) if line.slope_reach < line.slope else np.inf,
        ),
        prefactor=float(np.exp(intercept)),
        prefactor_interval=(float(np.exp(intercept - of_intercept)), float(np.exp(intercept + of_intercept))),
    )


def pair_correlation_dimension(aggregate: Aggregate, confidence: float = CONFIDENCE) -> PairCorrelationDimension:
    """Fractal dimension of one aggregate: the slope of the mean number of spheres within a distance r of a sphere.

    ln n(r), the sphere itself counted, is fitted over equal steps of ln r from 5 mean radii to one radius of gyration.
    Only spheres within half a radius of gyration of the centre of mass count their surroundings, so that the outer
    boundary does not lower the slope; the rest are counted.

    The interval is from a jackknife over eight compact blocks of the counting spheres. It tells the scatter within
    this aggregate only: aggregates of one law scatter more, by ± 0.1 to 0.2 at some hundred spheres. The range is
    below one decade up to thousands of spheres, and for dense packings the shells of neighbours still show (± 0.1).

    Raises
    ------
    ValueError
        If the radius of gyration is below 8 mean radii, or fewer than 16 spheres lie in the inner region.
    """
    _checks.instance("aggregate", aggregate, Aggregate, "make one with Aggregate.touching(spheres)")
    quantile = student_quantile(confidence, 2**HALVINGS - 1)
    radius = _mean_radius(aggregate.spheres)
    longest = LONGEST_DISTANCE * _relative_gyration(aggregate.spheres)
    centers = (aggregate.spheres.centers - aggregate.spheres.center_of_mass) / radius
    counting = centers[np.linalg.norm(centers, axis=1) <= CORE * longest]
    _refuse_small(longest, len(counting))
    distances = np.geomspace(SHORTEST_DISTANCE, longest, DISTANCES)
    counts = _counts_within(centers, counting, distances)
    slope = _slope(distances, counts)
    half = quantile * _jackknife_error(distances, counts, _compact_blocks(counting))
    return PairCorrelationDimension(slope, (slope - half, slope + half), (SHORTEST_DISTANCE * radius, longest * radius))


def _refuse_small(gyration: float, counting: int) -> None:
    least = 2 * 2**HALVINGS
    advice = "take a larger aggregate, or fractal_law over several"
    if gyration < SMALLEST_GYRATION:
        raise ValueError(
            f"aggregate: expected a radius of gyration of at least {SMALLEST_GYRATION:g} mean sphere radii, "
            f"got {gyration:.3g}; {advice}"
        )
    if counting < least:
        raise ValueError(
            f"aggregate: expected at least {least} spheres within {CORE:g} radii of gyration of the centre of mass, "
            f"got {counting}; {advice}"
        )


def _counts_within(centers: FloatArray, counting: FloatArray, distances: FloatArray) -> FloatArray:
    """Number (M, R) of centres within each distance of each counting centre, itself included."""
    tree = cKDTree(centers)
    columns = [tree.query_ball_point(counting, distance, return_length=True) for distance in distances]
    return np.stack(columns, axis=1).astype(float)


def _compact_blocks(points: FloatArray) -> IntArray:
    """Label (M,) of the block of each point, from halving the set repeatedly across its longest extent."""
    block = np.zeros(len(points), dtype=np.intp)
    for _ in range(HALVINGS):
        whole, block = block, 2 * block
        for label in range(int(whole.max()) + 1):
            members = np.flatnonzero(whole == label)
            axis = int(np.ptp(points[members], axis=0).argmax())
            order = members[np.argsort(points[members, axis], kind="stable")]
            block[order[len(order) // 2 :]] += 1
    return block


def _jackknife_error(distances: FloatArray, counts: FloatArray, block: IntArray) -> float:
    """Standard error of the slope, from leaving out one block of counting spheres at a time."""
    labels = np.unique(block)
    without = np.array([_slope(distances, counts[block != label]) for label in labels])
    return float(np.sqrt((len(labels) - 1) * without.var()))


def _slope(distances: FloatArray, counts: FloatArray) -> float:
    return float(np.polyfit(np.log(distances), np.log(counts.mean(axis=0)), 1)[0])


def _relative_gyration(spheres: Spheres) -> float:
    return radius_of_gyration(spheres) / _mean_radius(spheres)


def _mean_radius(spheres: Spheres) -> float:
    """Geometric mean of the radii."""
    return float(np.exp(np.log(spheres.radii).mean()))
