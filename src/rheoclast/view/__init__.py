"""Pictures of aggregates and of what they carry, without a display."""

from rheoclast.view.animation import animate_crack
from rheoclast.view.charts import (
    draw_convergence,
    draw_critical_rates,
    draw_fragment_distributions,
    draw_load_against_position,
    draw_load_distribution,
)
from rheoclast.view.crack import draw_crack
from rheoclast.view.fragments import draw_fragments
from rheoclast.view.picture import draw, save

__all__ = [
    "animate_crack",
    "draw",
    "draw_convergence",
    "draw_crack",
    "draw_critical_rates",
    "draw_fragment_distributions",
    "draw_fragments",
    "draw_load_against_position",
    "draw_load_distribution",
    "save",
]
