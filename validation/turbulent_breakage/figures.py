"""The figures: rates, the lengths that scale loads and rates, fragments."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from ensembles import Ensemble, local_exponents
from findings import EROSIVE, RATES_OF_FRAGMENTS, breakages, large
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator
from records import MODELS

import rheoclast as rc

TREES = {"open tree": ("Blues", "o"), "dense tree": ("Oranges", "s"), "unequal tree": ("Purples", "^")}
TONES = {16: 0.45, 32: 0.55, 64: 0.65, 128: 0.8, 256: 0.95}
SHOWN = (2, 16, 64, 256)  # spheres; the tables have all
TITLES = {"gaussian": "Gaussian gradients", "recent-deformation": "recent-deformation model"}
MODEL = "recent-deformation"  # of the figures that show one
SYMBOLS = {"gyration": ("radius of gyration", "Rg"), "hydrodynamic": ("hydrodynamic radius", "Rh")}


def style(ensemble: Ensemble) -> dict[str, Any]:
    """Colour by family and size, mark by family."""
    if ensemble.family == "doublet":
        return {"color": "black", "ls": "--", "lw": 1.3}
    tones, mark = TREES[ensemble.family]
    colour = plt.get_cmap(tones)(TONES[ensemble.spheres])
    return {"color": colour, "marker": mark, "ms": 3, "lw": 0.9, "label": f"{ensemble.family}, {ensemble.spheres}"}


def draw_rates(found: Sequence[Ensemble]) -> Figure:
    """Rates against dissipation, and their local exponents against the rate, for both models."""
    figure, panels = plt.subplots(2, 2, figsize=(9.0, 8.0), layout="constrained", sharey="row", sharex="row")
    for (top, bottom), model in zip(panels.T, MODELS, strict=True):
        for each in (each for each in found if each.model == model and each.spheres in SHOWN):
            values = np.array([rate.measured.rate for rate in each.rates])
            errors = np.abs(np.array([rate.interval for rate in each.rates]).T - values)
            top.errorbar([rate.dissipation for rate in each.rates], values, errors, elinewidth=0.7, **style(each))
            bottom.plot(values, local_exponents(each.rates), **style(each))
        top.set(xscale="log", yscale="log", xlabel="dissipation ε / [ν (F/μa²)²]", title=TITLES[model])
        top.text(0.02, 0.03, "doublet")
        bottom.set(xscale="log", yscale="log", xlabel="failures per Kolmogorov time", ylim=(0.4, 12))
        _ticks(bottom.yaxis, (0.5, 1, 2, 5, 10))
    panels[0, 0].set_ylabel("failures per Kolmogorov time")
    panels[1, 0].set_ylabel("local exponent  d ln f / d ln ε")
    _quiet(panels.flat)
    _legend(figure, panels[0, 0])
    return figure


def draw_lengths(found: Sequence[Ensemble]) -> Figure:
    """Mean largest tension against two lengths, and the rates that each of them brings together."""
    figure, panels = plt.subplots(2, 2, figsize=(9.0, 7.4), layout="constrained", sharey="col")
    trees = [each for each in found if each.model == MODEL and each.family in TREES]
    for (left, right), (length, (name, symbol)) in zip(panels, SYMBOLS.items(), strict=True):
        for family in TREES:
            _tension_law(left, [each for each in trees if each.family == family], length)
        for each in trees:
            load = [each.mean(length) ** 2 * rate.dissipation**0.5 for rate in each.rates]
            right.plot(load, [rate.measured.rate for rate in each.rates], **style(each))
        left.set(xscale="log", yscale="log", xlabel=f"{name} {symbol} / a", ylabel="mean largest tension · τ / μa²")
        right.set(xscale="log", yscale="log", xlabel=f"μ (ε/ν)^½ {symbol}² / F", ylabel="failures per Kolmogorov time")
        _ticks(left.xaxis, (3, 5, 10, 20))
        _ticks(right.xaxis, (0.05, 0.1, 0.2, 0.5, 1))
        left.legend(frameon=False, fontsize=8)
    _quiet(panels.flat)
    _legend(figure, panels[0, 1])
    return figure


def _tension_law(panel: Axes, own: Sequence[Ensemble], length: str) -> None:
    """All clusters of a family, and the power law through them."""
    size, tension = (np.concatenate([each.clusters[name] for each in own]) for name in (length, "tension"))
    tones, mark = TREES[own[0].family]
    colour = plt.get_cmap(tones)(0.75)
    law, ends = rc.power_law(size, tension), np.array([size.min(), size.max()])
    panel.plot(size, tension, mark, ms=3, mec="none", color=colour, alpha=0.5)
    panel.plot(ends, law(ends), color=colour, lw=1.2, label=f"{own[0].family}: exponent {law.exponent:.2f}")


def draw_fragments(found: Sequence[Ensemble]) -> Figure:
    """Cumulative mass of all fragments, and cumulative number of the smaller ones, at several dissipations."""
    figure, panels = plt.subplots(2, len(TREES), figsize=(10.5, 7.2), layout="constrained", sharey=True, sharex="row")
    place = np.linspace(0, 1, 401)
    for (top, bottom), family in zip(panels.T, TREES, strict=True):
        for rate, tone in zip(RATES_OF_FRAGMENTS, np.linspace(0.0, 0.85, len(RATES_OF_FRAGMENTS)), strict=True):
            share, _ = breakages(large(found, MODEL, family), rate)
            line = {"color": plt.get_cmap("viridis")(tone), "lw": 1.3, "label": f"{rate:g} failures / τ"}
            parts = np.sort(np.concatenate([share, 1 - share]))
            cumulative = np.append(0.0, np.cumsum(parts)) / len(share)
            top.plot(place, cumulative[np.searchsorted(parts, place, side="right")], **line)
            bottom.plot(place / 2, np.searchsorted(np.sort(share), place / 2, side="right") / len(share), **line)
        top.plot(place, place**2, "k--", lw=1, label="quadratic: uniform")
        bottom.plot(place / 2, place, "k--", lw=1, label="linear: uniform")
        bottom.plot(place / 2, place**2, "k:", lw=1.3, label="quadratic")
        bottom.axvspan(0, EROSIVE, color="0.9", lw=0)
        top.set(title=f"{family}s", xlabel="x, mass fraction of a fragment")
        bottom.set_xlabel("y, mass fraction of the smaller fragment")
    panels[0, 0].set_ylabel("share of the mass in fragments up to x")
    panels[1, 0].set_ylabel("share of smaller fragments up to y")
    for panel in panels[:, 0]:
        panel.legend(frameon=False, fontsize=7.5, loc="upper left")
    _quiet(panels.flat)
    return figure


def _ticks(axis: Axis, places: Sequence[float]) -> None:
    """Ticks at round numbers of a logarithmic axis, in plain digits."""
    axis.set_ticks(places, [f"{place:g}" for place in places])
    axis.set_minor_locator(NullLocator())


def _legend(figure: Figure, panel: Axes) -> None:
    """What all panels share, a column per family, below them."""
    handles, labels = panel.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=len(TREES), frameon=False, fontsize=8)


def _quiet(panels: Iterable[Axes]) -> None:
    for panel in panels:
        panel.grid(alpha=0.3, lw=0.5)
        panel.spines[["top", "right"]].set_visible(False)
