"""Campaigns: many aggregates in many flows and orientations, on the cores of one machine or on a cluster.

What is asked stands in `request` and `conditions`, one unit of work in `task` and `events`, how the work is run in
`local_pool` and `cluster`, what is kept in `store`. The package needs msgspec and pyarrow, the extra `survey`.
"""

from rheoclast.populations.campaign.request import Campaign, read_campaign
from rheoclast.populations.campaign.running import Survey, survey

__all__ = ["Campaign", "Survey", "read_campaign", "survey"]
