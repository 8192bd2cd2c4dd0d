"""Ballistic aggregates whose spheres migrate after first touch to a second contact (BAM1), or to a third (BAM2).

Y. Shen, B. T. Draine and E. T. Johnson, Astrophys. J. 689 (2008) 260.
"""

from __future__ import annotations

from rheoclast import _checks
from rheoclast.generation import _growth
from rheoclast.particles.aggregate import Aggregate

MOST_MIGRATIONS = 2


def ballistic_migration(
    count: int, radius: float = 1.0, *, spread: float = 0.0, seed: int = 0, migrations: int = 1
) -> Aggregate:
    """Aggregate of `count` spheres that arrived on straight lines and rolled on to a second or third contact.

    First migration: the sphere rolls over the sphere that it touched by the shortest arc on which it touches another.
    Second migration: it rolls over these two, the shorter way round, until it touches a third. Every sphere so gains
    one contact with each migration, save the first few and the rare one that finds no other sphere within its roll.

    Parameters
    ----------
    count
        Number of spheres.
    radius
        Median radius in m.
    spread
        Standard deviation of ln radius, from 0 to 1.
    seed
        Equal seeds give equal aggregates.
    migrations
        1 or 2.

    Raises
    ------
    ValueError
        If a parameter is out of range.
    """
    radii, rng = _growth.begin(count, radius, spread, seed)
    if _checks.whole_number("migrations", migrations, 1) > MOST_MIGRATIONS:
        raise ValueError(f"migrations: expected 1 or 2, got {migrations}; a sphere on three others rests")
    from rheoclast.generation._deposition import deposited

    return _growth.finished(deposited(radii, migrations, rng), radii, radius)
