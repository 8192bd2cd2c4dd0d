"""What may happen to one aggregate, as rows of an Arrow table."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Generic, TypeVar

import pyarrow as pa

from rheoclast.campaigns.breakups import BREAKUP, breakup_columns
from rheoclast.campaigns.first_failures import FIRST_FAILURE, first_failure_columns
from rheoclast.campaigns.passages import HISTORY, history_columns
from rheoclast.campaigns.setting import Flows, Orbits, Setting

Met = TypeVar("Met", Flows, Orbits)

IN_FLOWS = ("flows", "orientations")
ALONG_HISTORIES = ("histories",)


@dataclass(frozen=True)
class Event(Generic[Met]):
    """A kind of event: the type of its rows, and what computes their columns, some rows at a time.

    Attributes
    ----------
    needs
        The keys of a campaign that say what the aggregates meet.
    """

    type: pa.StructType
    columns: Callable[[Setting, Met], Iterator[dict[str, Any]]]
    needs: tuple[str, ...]

    def rows(self, setting: Setting, met: Met) -> pa.StructArray:
        """One row for every flow and orientation, or history and dissipation, that an aggregate meets."""
        return pa.concat_arrays([_rows(self.type, columns) for columns in self.columns(setting, met)])


def _rows(kind: pa.StructType, columns: Mapping[str, Any]) -> pa.StructArray:
    fields = list(kind)
    return pa.StructArray.from_arrays(
        [pa.array(columns[field.name], type=field.type) for field in fields], fields=fields
    )


EVENTS: Mapping[str, Event[Any]] = MappingProxyType(
    {
        "first failure": Event[Flows](FIRST_FAILURE, first_failure_columns, IN_FLOWS),
        "breakup": Event[Flows](BREAKUP, breakup_columns, IN_FLOWS),
        "history": Event[Orbits](HISTORY, history_columns, ALONG_HISTORIES),
    }
)
"""What a campaign may ask for."""
