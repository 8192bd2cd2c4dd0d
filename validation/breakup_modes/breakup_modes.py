"""What the events tell: modes of breakup against coordination and density, with intervals and figures.

python validation/breakup_modes/breakup_modes.py

Reads `results/`, which `events.py` makes, and writes modes.csv, variants.csv and the figures beside this file.
"""

from __future__ import annotations

import csv
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from events import FAMILIES, FLOWS, RESULTS, VARIANTS
from matplotlib.lines import Line2D

import rheoclast as rc

HERE = Path(__file__).parent
RESAMPLES, CONFIDENCE = 2000, 0.95
COLOURS = {"extension": "#0072b2", "shear": "#d55e00"}
Row = Mapping[str, str]


def number(name: str) -> Callable[[Row], float]:
    """The value of a column."""
    return lambda row: float(row[name])


MEASURES: Mapping[str, Callable[[Row], float]] = {
    "single_bond": lambda row: float(row["outcome"] == "bond"),
    "failures": number("failures"),
    "surface": number("surface"),
    "first_radial": number("first_radial"),
    "first_depth": number("first_depth"),
    "inwardness": number("inwardness"),
    "inner_minus_early_depth": lambda row: float(row["depth_middle"]) - float(row["depth_early"]),
    "smaller": number("smaller"),
    "smaller_of_single_bond": lambda row: float(row["smaller"]) if row["outcome"] == "bond" else np.nan,
    "breakup_over_initiation": lambda row: float(row["breakup_rate"]) / float(row["initiation_rate"]),
}
PANELS = {
    "single_bond": "share that breaks at a single bond",
    "failures": "failed contacts per event",
    "surface": "failed contacts between fragments",
    "first_radial": "first failure: distance from centre / Rg",
    "inwardness": "inwardness of the crack",
    "smaller": "spheres outside the largest fragment, share",
}
LOGARITHMIC = ("failures", "surface")
MARKERS = {"open tree": "o", "dense tree": "^", "compacted": "s", "packed ball": "D", "thinned fcc": "v"}


def read(pattern: str) -> list[Row]:
    """Rows of all files of a name."""
    found: list[Row] = []
    for path in sorted(RESULTS.glob(pattern)):
        with path.open(newline="") as file:
            found += csv.DictReader(file)
    return found


def estimate(rows: Sequence[Row], measure: Callable[[Row], float]) -> tuple[float, float, float]:
    """Mean over clusters of a measure, and its interval by resampling whole clusters: events of one are alike."""
    seeds = sorted({row["seed"] for row in rows})
    values = {seed: [measure(row) for row in rows if row["seed"] == seed] for seed in seeds}
    means = np.array(
        [np.mean(np.array(each)[np.isfinite(each)]) for each in values.values() if np.isfinite(each).any()]
    )
    if not len(means):
        return np.nan, np.nan, np.nan
    drawn = np.random.default_rng(1).choice(means, (RESAMPLES, len(means))).mean(axis=1)
    low, high = np.quantile(drawn, [(1 - CONFIDENCE) / 2, (1 + CONFIDENCE) / 2])
    return float(means.mean()), float(low), float(high)


def modes(rows: Sequence[Row]) -> list[dict[str, float | str]]:
    """One row per family and flow."""
    table = []
    for family in FAMILIES:
        for flow in FLOWS:
            own = [row for row in rows if (row["family"], row["flow"]) == (family, flow)]
            if not own:
                continue
            entry: dict[str, float | str] = {"family": family, "flow": flow, "events": len(own)}
            entry["clusters"] = len({row["seed"] for row in own})
            entry["coordination"] = float(np.mean([float(row["coordination"]) for row in own]))
            entry["density"] = 1 - float(np.mean([float(row["porosity"]) for row in own]))
            entry["unbroken"] = float(np.mean([row["outcome"] == "whole" for row in own]))
            for name, measure in MEASURES.items():
                entry[name], entry[f"{name}_low"], entry[f"{name}_high"] = estimate(own, measure)
            table.append(entry)
    return table


def variants(rows: Sequence[Row]) -> list[dict[str, float | str]]:
    """One row per variant and family, both flows together, against the same events of the standard."""
    table = []
    standard = {_event(row): row for row in rows if row["variant"] == "standard"}
    for variant in VARIANTS:
        for family in dict.fromkeys(row["family"] for row in rows):
            own = [row for row in rows if (row["variant"], row["family"]) == (variant, family)]
            pairs = [(row, standard[_event(row)]) for row in own if _event(row) in standard]
            if not pairs:
                continue
            entry: dict[str, float | str] = {"variant": variant, "family": family, "events": len(pairs)}
            entry["same_first_contact"] = float(np.mean([a["first_contact"] == b["first_contact"] for a, b in pairs]))
            entry["initiation_rate_ratio"] = _median_ratio(pairs, "initiation_rate")
            entry["breakup_rate_ratio"] = _median_ratio(pairs, "breakup_rate")
            entry["undetermined"] = float(np.mean([float(row["undetermined"]) for row in own]))
            for name in ("single_bond", "failures", "surface", "first_radial", "inwardness", "smaller"):
                entry[name], entry[f"{name}_low"], entry[f"{name}_high"] = estimate(own, MEASURES[name])
            table.append(entry)
    return table


def _event(row: Row) -> tuple[str, ...]:
    return tuple(row[name] for name in ("family", "seed", "flow", "orientation"))


def _median_ratio(pairs: Sequence[tuple[Row, Row]], name: str) -> float:
    return float(np.median([float(a[name]) / float(b[name]) for a, b in pairs if np.isfinite(float(a[name]))]))


def draw(table: Sequence[Mapping[str, float | str]], against: str, label: str) -> plt.Figure:
    """Six measures against a measure of the clusters, both flows, with intervals; a marker for every kind of family."""
    figure, panels = plt.subplots(2, 3, figsize=(9.6, 6.2), layout="constrained", sharex=True)
    for panel, (name, title) in zip(panels.flat, PANELS.items(), strict=True):
        for row in table:
            x, y, low, high = (float(row[key]) for key in (against, name, f"{name}_low", f"{name}_high"))
            style = {"fmt": MARKERS[_kind(row)], "ms": 4.5, "capsize": 2, "lw": 1, "color": COLOURS[row["flow"]]}
            filled = {"mfc": "white"} if row["flow"] == "shear" else {}
            panel.errorbar(x, y, [[y - low], [high - y]], **style, **filled)
        panel.set_title(title, size=9)
        panel.set_yscale("log" if name in LOGARITHMIC else "linear")
        panel.grid(alpha=0.3, lw=0.5)
    for panel in panels[1]:
        panel.set_xlabel(label)
    flows = [Line2D([], [], lw=3, color=colour, label=flow) for flow, colour in COLOURS.items()]
    kinds = [Line2D([], [], ls="", marker=marker, color="#444444", label=kind) for kind, marker in MARKERS.items()]
    figure.legend(handles=[*flows, *kinds], loc="outside lower center", ncols=7, frameon=False, fontsize=9)
    return figure


def _kind(row: Mapping[str, float | str]) -> str:
    """Family, all degrees of compaction alike."""
    return str(row["family"]).removesuffix(" %").rstrip("0123456789").strip()


def main() -> None:
    """Tables and figures from all events that are there."""
    table = modes(read("all_*.csv"))
    compared = variants([row for variant in VARIANTS for row in read(f"{variant.replace(' ', '-')}_*.csv")])
    for name, rows in (("modes", table), ("variants", compared)):
        rc.write_table(HERE / f"{name}.csv", {key: np.array([row[key] for row in rows]) for key in rows[0]}, True)
    for against, label in (("coordination", "mean coordination number"), ("density", "share of solid")):
        draw(table, against, label).savefig(HERE / f"modes_against_{against}.png", dpi=130)


if __name__ == "__main__":
    main()
