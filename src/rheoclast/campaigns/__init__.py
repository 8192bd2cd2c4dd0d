"""Campaigns: many aggregates in many flows or along many histories, on the cores of one machine or on a cluster.

What is asked stands in `request`, `conditions` and `histories`, one unit of work in `task`, what may happen to an
aggregate in `events` and the modules of every kind (`first_failures`, `breakups`, `passages`), how the work is run in
`local_pool` and `cluster`, what is kept in `store`. The package needs msgspec and pyarrow, the extra `survey`.
"""

from rheoclast.campaigns.request import Campaign, read_campaign
from rheoclast.campaigns.running import Survey, survey

__all__ = ["Campaign", "Survey", "read_campaign", "survey"]
