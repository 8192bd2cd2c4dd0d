"""Pictures of aggregates and of what they carry, without a display."""

from rheoclast.view.animation import animate_crack
from rheoclast.view.crack import draw_crack
from rheoclast.view.fragments import draw_fragments
from rheoclast.view.picture import draw, save

__all__ = ["animate_crack", "draw", "draw_crack", "draw_fragments", "save"]
