"""The first failure of one aggregate in every flow and orientation.

It needs no more than the linear map from strain rate to contact loads, so that all orientations are worked out at once.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import pyarrow as pa

from rheoclast.breakup.initiation import initiations
from rheoclast.campaigns.setting import Flows, Setting

IN_WHICH = {"flow": pa.string(), "orientation": pa.int32()}
"""Name of the flow, and position of the orientation among those of the aggregate."""

FIRST_FAILURE = pa.struct(
    {
        **IN_WHICH,
        "initiation_rate_per_s": pa.float64(),
        "contact": pa.int32(),
        "i": pa.int32(),
        "j": pa.int32(),
        "criterion": pa.string(),
        "margin": pa.float64(),
        "radial_position": pa.float64(),
        "depth": pa.float64(),
    }
)
"""Contact and what is known of it are null, and the rate is infinite, where no rate breaks any."""


def first_failure_columns(setting: Setting, flows: Flows) -> Iterator[dict[str, Any]]:
    """Columns of `FIRST_FAILURE`, flow by flow, with one row per orientation."""
    for name, flow in flows.named.items():
        rotations = flows.turns(flow, setting)
        found = initiations(setting.table, setting.bonds, flow, rotations, criterion=setting.criterion)
        contact, number = found.contact, len(rotations)
        i, j = setting.aggregate.pairs[contact].T
        known = (contact, i, j, np.array(found.criteria)[found.criterion], found.margin, *setting.places[:, contact])
        columns = (np.ma.array(each, mask=contact < 0) for each in known)
        yield dict(zip(FIRST_FAILURE.names, ([name] * number, np.arange(number), found.rate, *columns), strict=True))
