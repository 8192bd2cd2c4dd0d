"""Speed of a campaign: two workers against one, and the time of a thousand aggregates from that of some.

Clusters of 200 spheres by Stokesian dynamics of order 2, the first failure in 1000 orientations of each with all that
is kept of it. The time to start the workers is measured by itself, as it does not grow with the campaign.

python benchmarks/survey.py [--count 400]
"""

from __future__ import annotations

import argparse
import tempfile
import time
from pathlib import Path

from rich.console import Console
from rich.table import Table

from rheoclast.campaigns import Campaign, survey
from rheoclast.campaigns.conditions import Orientations
from rheoclast.campaigns.request import Seeds

WHOLE = 1_000


def campaign(count: int) -> Campaign:
    """A number of aggregates."""
    return Campaign(
        viscosity=1e-3,
        radius=0.5e-6,
        flows=("shear",),
        orientations=Orientations(1_000),
        materials=("polystyrene",),
        families=({"name": "cluster-cluster"},),
        sizes=(200,),
        seeds=Seeds(count),
    )


def seconds(count: int, workers: int) -> tuple[float, float]:
    """Time until the first aggregate of each worker is finished, and from then on until the tables are written."""
    times: list[float] = []
    with tempfile.TemporaryDirectory() as folder:
        survey(
            campaign(count),
            Path(folder) / "out",
            workers=workers,
            progress=lambda *_: times.append(time.perf_counter()),
        )
        return times[workers] - times[0], time.perf_counter() - times[workers]


def main() -> None:
    """Run and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=400)
    count = parser.parse_args().count
    table = Table("workers", "start, s", "aggregates per second", f"{WHOLE} aggregates, min", "against one")
    single = 0.0
    for workers in (1, 2):
        start, rest = seconds(count, workers)
        speed = (count - workers) / rest
        single = single or speed
        whole = (start + WHOLE / speed) / 60
        table.add_row(str(workers), f"{start:.1f}", f"{speed:.2f}", f"{whole:.1f}", f"{speed / single:.2f}")
    Console().print(table)


if __name__ == "__main__":
    main()
