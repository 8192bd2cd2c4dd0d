"""Cluster–cluster aggregates with prescribed fractal dimension and prefactor.

Two clusters with masses m₁, m₂ and radii of gyration R₁, R₂ are joined at the distance Γ of their centres of mass for
which the union, of mass m, has the radius of gyration R of the fractal law: m₁ m₂ Γ² = m (m R² − m₁ R₁² − m₂ R₂²).
A. V. Filippov, M. Zurita and D. E. Rosner, J. Colloid Interface Sci. 229 (2000) 261; for unequal spheres J. Morán,
A. Fuentes, F. Liu and J. Yon, Comput. Phys. Commun. 239 (2019) 225. Other than there, growth starts from single
spheres, and the angles of a contact are drawn rather than scanned.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.errors import GeometryError
from rheoclast.generation import _growth
from rheoclast.particles.aggregate import Aggregate

if TYPE_CHECKING:
    from rheoclast.generation._clusters import Cluster

DENSEST_PACKING = np.pi / np.sqrt(18)
SHARES = (2, 4, 8, 16, 32, 64, 128, 256)
"""The union over the second piece in all joins of an attempt, one attempt after the other."""
TRIALS_PER_SPHERE = 100
MANY_TRIALS = 1_000
TRIALS_OF_THE_WHOLE = 20
"""Times those of a piece: the last join must succeed at the very distance."""
STEPS_OF_SLACK = 5


def cluster_cluster(
    count: int,
    radius: float = 1.0,
    *,
    fractal_dimension: float = 1.8,
    prefactor: float = 1.3,
    spread: float = 0.0,
    seed: int = 0,
) -> Aggregate:
    """Aggregate of `count` spheres that obeys N = k (R_g / a)^D with prescribed dimension D and prefactor k.

    R_g is the radius of gyration at uniform density, the spheres' own extent 3/5 a² included, as in
    `radius_of_gyration`; a is the geometric mean of the radii drawn. The aggregate obeys the law to rounding. So do the
    pieces that it is joined from where they can: those that overlap, mostly of few spheres, are joined at a distance
    larger by up to a diameter, those that cannot be so long are stretched, and the next join makes up for it. The
    pieces of a join are alike; for laws so dense that no such join succeeds, the second is a fourth of the union, an
    eighth, and so on down to a single sphere.

    Parameters
    ----------
    count
        Number of spheres N, at least 2.
    radius
        Median radius in m.
    fractal_dimension
        D, from 1 to 3.
    prefactor
        k, positive.
    spread
        Standard deviation of ln radius, from 0 to 1.
    seed
        Equal seeds give equal aggregates.

    Raises
    ------
    ValueError
        If a parameter is out of range.
    GeometryError
        If the law asks for more than a straight chain or a denser aggregate than any packing, or if no arrangement
        without overlap was found.
    """
    radii, rng = _growth.begin(count, radius, spread, seed, least=2)
    law = SizeLaw(_dimension(fractal_dimension), _checks.positive("prefactor", prefactor))
    _refuse_impossible(law, radii)
    grown = _grown(radii, law, rng)
    return _growth.finished(grown.centers, grown.radii, radius)


@dataclass(frozen=True)
class SizeLaw:
    """N = k (R_g / a)^D with a the geometric mean radius."""

    dimension: float
    prefactor: float

    def gyration2(self, radii: FloatArray) -> float:
        """Square of the radius of gyration of spheres with radii (N,)."""
        mean = np.exp(np.mean(np.log(radii)))
        return float(mean**2 * (len(radii) / self.prefactor) ** (2 / self.dimension))


class _NoPlaceError(Exception):
    """Two pieces overlap wherever they touch at the distance of the law."""


def _dimension(value: float) -> float:
    dimension = _checks.positive("fractal_dimension", value)
    if not 1 <= dimension <= 3:
        raise ValueError(f"fractal_dimension: expected a number from 1 to 3, got {dimension:g}")
    return dimension


def _refuse_impossible(law: SizeLaw, radii: FloatArray) -> None:
    """Refuse a law whose radius of gyration no arrangement can have."""
    asked, count = np.sqrt(law.gyration2(radii)), len(radii)
    equal = bool((radii == radii[0]).all())
    longest = np.sqrt((count**2 - 1) / 3 + 0.6) if equal else radii.sum()
    density = DENSEST_PACKING if equal else 1.0
    shortest = np.sqrt(0.6) * (np.sum(radii**3) / density) ** (1 / 3)
    request = f"{count} spheres with dimension {law.dimension:g} and prefactor {law.prefactor:g}"
    if asked > longest * (1 + 1e-12):
        raise GeometryError(
            f"{request} have a radius of gyration of {asked:.4g} radii, more than that of a straight chain, "
            f"{longest:.4g}; raise the prefactor or the dimension"
        )
    if asked < shortest:
        raise GeometryError(
            f"{request} have a radius of gyration of {asked:.4g} radii, less than that of the densest packing, "
            f"{shortest:.4g}; lower the prefactor or the dimension"
        )


def _grown(radii: FloatArray, law: SizeLaw, rng: np.random.Generator) -> Cluster:
    from rheoclast.generation._hierarchy import hierarchy

    def join(first: Cluster, second: Cluster) -> Cluster:
        return _joined(first, second, law, len(radii), rng)

    for share in SHARES:
        try:
            return hierarchy(radii, join, share)
        except _NoPlaceError:
            continue
    raise GeometryError(
        f"no arrangement of {len(radii)} spheres with dimension {law.dimension:g} and prefactor {law.prefactor:g} was "
        f"found, which is a radius of gyration of {np.sqrt(law.gyration2(radii)):.4g} radii; "
        "lower the prefactor or the dimension if it is too dense, raise them if it is too open, or take another seed"
    )


def _joined(first: Cluster, second: Cluster, law: SizeLaw, count: int, rng: np.random.Generator) -> Cluster:
    """Union of two pieces at the distance of the law, or near it unless it is the whole of `count` spheres."""
    from rheoclast.generation._clusters import union
    from rheoclast.generation._contact_at_distance import contact_at_distance

    size = len(first.radii) + len(second.radii)
    trials = min(TRIALS_PER_SPHERE * size, MANY_TRIALS + size // 4)
    if size == count:
        trials *= TRIALS_OF_THE_WHOLE
    for distance in _distances(first, second, law, size == count):
        found, rotation, shift = contact_at_distance(first, second, distance, trials, rng)
        if found:
            return union(first, second, rotation, shift)
    raise _NoPlaceError


def _distances(first: Cluster, second: Cluster, law: SizeLaw, exact: bool) -> FloatArray:
    """Distances of the centres of mass to try one after the other; if `exact`, that of the law or none."""
    from rheoclast.generation._clusters import extent

    squared = _squared_distance(first, second, law)
    if exact:
        return np.sqrt([squared]) if squared >= 0 else np.empty(0)
    diameter = 2 * max(first.radii.max(), second.radii.max())
    distances = np.sqrt(max(squared, 0.0)) + diameter * np.linspace(0, 1, STEPS_OF_SLACK) ** 2
    return np.minimum(distances, extent(first) + extent(second))


def _squared_distance(first: Cluster, second: Cluster, law: SizeLaw) -> float:
    """Γ² of the centres of mass of two pieces whose union obeys the law, negative if they are too large for it."""
    mass1, moment1 = _mass_and_moment(first)
    mass2, moment2 = _mass_and_moment(second)
    mass = mass1 + mass2
    excess = mass * law.gyration2(np.concatenate([first.radii, second.radii])) - moment1 - moment2
    return mass * excess / (mass1 * mass2)


def _mass_and_moment(piece: Cluster) -> tuple[float, float]:
    """Mass m and m R_g² of a piece at unit density but for a common factor."""
    mass = piece.radii**3
    return float(mass.sum()), float(mass @ (np.sum(piece.centers**2, axis=1) + 0.6 * piece.radii**2))
