"""The first failure of one aggregate as it is carried along histories of the velocity gradient.

Loads are proportional to the velocity gradient, which is proportional to the inverse Kolmogorov time. Orbit and load
ratios are therefore worked out once for every history, in units of that time, and serve all dissipations.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import pyarrow as pa

from rheoclast.breakup.crack import break_up_each
from rheoclast.breakup.event import Breakup
from rheoclast.breakup.load_history import FirstFailure, load_history
from rheoclast.campaigns.histories import Histories
from rheoclast.campaigns.setting import Orbits, Setting
from rheoclast.flows import LinearFlow
from rheoclast.hydrodynamics.response import RigidResponse
from rheoclast.hydrodynamics.trajectory import trajectory
from rheoclast.populations.orientations import random_orientations

HISTORY = pa.struct(
    {
        "history": pa.int32(),
        "dissipation_m2_per_s3": pa.float64(),
        "kolmogorov_time_s": pa.float64(),
        "time_s": pa.float64(),
        "failed": pa.bool_(),
        "overloaded": pa.bool_(),
        "largest_load_ratio": pa.float64(),
        "contact": pa.int32(),
        "i": pa.int32(),
        "j": pa.int32(),
        "criterion": pa.string(),
        "radial_position": pa.float64(),
        "depth": pa.float64(),
        "fragments": pa.list_(pa.int32()),
        "smaller_share": pa.float64(),
        "breakup_over_initiation": pa.float64(),
    }
)
"""Time from the start to the first failure, or to the end where nothing failed: then it is censored, and contact and
what follows are null. An overloaded aggregate fails at once. The largest load ratio is that of the whole history.

Fragments are those of the flow at the moment of failure, raised as far as it takes to split the aggregate, with their
numbers of spheres, the largest first; the smaller share is that of all spheres outside the largest. The last column
says how far the flow was raised: by a factor of 1 where the first failure splits the aggregate, as it does any tree.
"""


@dataclass(frozen=True, eq=False)
class _Passage:
    """An aggregate on one history at one dissipation: how long it lasts, and in what flow what then fails."""

    history: int
    dissipation: float
    kolmogorov_time: float
    lasted: float
    largest: float
    failure: FirstFailure | None
    flow: LinearFlow | None


def orbits(
    response: RigidResponse, histories: Histories, viscosity: float, history_seed: int, orientation_seed: int
) -> Orbits:
    """How an aggregate turns along every one of its histories, from random orientations on."""
    paths = histories.drawn(history_seed)
    starts = random_orientations(len(paths), orientation_seed)
    turning = {
        number: trajectory(response, path, duration=histories.duration, start=start)
        for (number, path), start in zip(paths.items(), starts, strict=True)
    }
    return Orbits(turning, histories.kolmogorov_times(viscosity), histories.fragments)


def history_columns(setting: Setting, along: Orbits) -> Iterator[dict[str, Any]]:
    """Columns of `HISTORY`, history by history, with one row per dissipation."""
    passages = list(_passages(setting, along))
    flows = [passage.flow for passage in passages if passage.flow is not None] if along.fragments else []
    whole = (setting.aggregate, setting.response, setting.bonds)
    broken = break_up_each(*whole, flows, rule=setting.rule, criterion=setting.criterion)
    rows = []
    for passage in passages:
        row = _row(passage)
        if passage.failure is not None:
            row |= _contact(setting, passage.failure)
            row |= _fragments(next(broken)) if along.fragments else {}
        rows.append(row)
    yield {name: [row.get(name) for row in rows] for name in HISTORY.names}


def _passages(setting: Setting, along: Orbits) -> Iterator[_Passage]:
    for number, orbit in along.numbered.items():
        loads = load_history(orbit, setting.table, setting.bonds, criterion=setting.criterion)
        start, end = orbit.times[[0, -1]].tolist()
        for dissipation, unit in along.kolmogorov_times.items():
            failure = loads.first_failure(level=unit)
            until = end if failure is None else failure.time
            flow = None if failure is None else orbit.flow(failure.time)
            largest = loads.maximum.ratio / unit
            yield _Passage(number, dissipation, unit, (until - start) * unit, largest, failure, flow)


def _row(passage: _Passage) -> dict[str, Any]:
    failed = passage.failure is not None
    return {
        "history": passage.history,
        "dissipation_m2_per_s3": passage.dissipation,
        "kolmogorov_time_s": passage.kolmogorov_time,
        "time_s": passage.lasted,
        "failed": failed,
        "overloaded": failed and passage.lasted == 0,
        "largest_load_ratio": passage.largest,
    }


def _contact(setting: Setting, failure: FirstFailure) -> dict[str, Any]:
    i, j = setting.aggregate.pairs[failure.contact].tolist()
    radial, below = setting.places[:, failure.contact].tolist()
    return {
        "contact": failure.contact,
        "i": i,
        "j": j,
        "criterion": failure.criterion,
        "radial_position": radial,
        "depth": below,
    }


def _fragments(breakup: Breakup) -> dict[str, Any]:
    sizes = [len(spheres) for spheres in breakup.spheres]
    return {
        "fragments": sizes,
        "smaller_share": 1 - sizes[0] / sum(sizes),
        "breakup_over_initiation": breakup.breakup_rate / breakup.initiation_rate,
    }
