"""Pictures of aggregates and of what they carry, without a display."""

from rheoclast.view.picture import draw, save

__all__ = ["draw", "save"]
