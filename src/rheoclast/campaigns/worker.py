"""What the ways to run a campaign have in common."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class WorkerLost:
    """In place of a result: the process that worked on it ended, again and again.

    Attributes
    ----------
    reason
        What is known about it.
    """

    reason: str
