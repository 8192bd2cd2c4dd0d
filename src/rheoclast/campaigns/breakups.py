"""The breakup of one aggregate in every flow and orientation, followed contact by contact, one after the other."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pyarrow as pa

from rheoclast.breakup.crack import break_up_each
from rheoclast.breakup.event import Breakup
from rheoclast.campaigns.first_failures import IN_WHICH
from rheoclast.campaigns.setting import Flows, Setting

BREAKUP = pa.struct(
    {
        **IN_WHICH,
        "outcome": pa.string(),
        "initiation_rate_per_s": pa.float64(),
        "breakup_rate_per_s": pa.float64(),
        "surface": pa.int32(),
        "inwardness": pa.float64(),
        "fragments": pa.list_(pa.int32()),
        "contacts": pa.list_(pa.int32()),
        "rates_per_s": pa.list_(pa.float64()),
        "criteria": pa.list_(pa.string()),
    }
)
"""Numbers of spheres of the fragments, the largest first; contacts, rates and criteria of all failures, in order."""


def breakup_columns(setting: Setting, flows: Flows) -> Iterator[dict[str, Any]]:
    """Columns of `BREAKUP`, flow by flow, with one row per orientation."""
    for name, flow in flows.named.items():
        broken = break_up_each(
            setting.aggregate,
            setting.response,
            setting.bonds,
            (flow.rotated(each) for each in flows.turns(flow, setting)),
            rule=setting.rule,
            criterion=setting.criterion,
            up_to=flows.up_to,
        )
        rows = [{"flow": name, "orientation": k, **_breakup_row(each)} for k, each in enumerate(broken)]
        yield {key: [row[key] for row in rows] for key in BREAKUP.names}


def _breakup_row(breakup: Breakup) -> dict[str, Any]:
    return {
        "outcome": breakup.outcome,
        "initiation_rate_per_s": breakup.initiation_rate,
        "breakup_rate_per_s": breakup.breakup_rate,
        "surface": len(breakup.surface),
        "inwardness": breakup.inwardness,
        "fragments": [len(spheres) for spheres in breakup.spheres],
        "contacts": [failure.contact for failure in breakup.failures],
        "rates_per_s": [failure.rate for failure in breakup.failures],
        "criteria": [failure.criterion for failure in breakup.failures],
    }
