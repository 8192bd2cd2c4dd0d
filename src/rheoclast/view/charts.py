"""Charts of loads, critical rates, fragments and convergence, in one quiet style for print and the colour-blind."""

from __future__ import annotations

from collections.abc import Mapping
from textwrap import fill
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.breakup.contact_response import ContactResponse
from rheoclast.flows import LinearFlow
from rheoclast.particles.aggregate import Aggregate
from rheoclast.particles.morphology import radial_position
from rheoclast.populations.fragment_distribution import FragmentDistribution
from rheoclast.populations.power_law import PowerLaw
from rheoclast.view.labels import EXTENDED, FAINT_INK, INK, SHORTENED, SMALL, TINY
from rheoclast.view.quantities import prefixed

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure

BARS = 40
DWARFING = 30  # times the usual height of a bar
# M. Okabe and K. Ito, Color universal design (2008): told apart with every kind of colour vision.
SERIES = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9")
MARKERS = "os^Dv>"
SIZE = (5.6, 3.8)  # inches
LINE_HEIGHT = 0.17  # inches of a line of the legend
WIDEST_LABEL, HIGHEST_LABEL, LEGEND_WIDTH = 55, 46, 80  # letters
MANY, SMALLEST_DOT = 1000, 1.2  # points of a chart, and the diameter of a dot in points
ROUNDING = 1e-9  # of forces or moments: smaller loads vanish by symmetry


def draw_load_distribution(values: ArrayLike, *, quantity: str = "tension", unit: str | None = "N") -> Figure:
    """Histogram of a load over all contacts, what pulls apart from what presses together.

    The counts are on a logarithmic axis where one bar dwarfs the others.

    Parameters
    ----------
    values
        (C,) one value per contact in `unit`; positive is red, negative blue.
    quantity, unit
        What the values are; a decimal prefix is chosen. None for dimensionless values.

    Raises
    ------
    ValueError
        If there is no value, or one is not finite.
    """
    from matplotlib.ticker import MaxNLocator

    given = _nonempty("values", values)
    divisor, shown = prefixed(float(np.abs(given).max()), unit)
    figure, axes = _chart(f"{quantity}{_in(shown)}", "contacts")
    edges = _edges(given / divisor)
    for part, colour in ((given >= 0, EXTENDED), (given < 0, SHORTENED)):
        axes.hist(given[part] / divisor, edges.tolist(), color=colour, alpha=0.85, edgecolor="white", linewidth=0.4)
    counts = np.histogram(given / divisor, edges)[0]
    if counts.max() > DWARFING * np.median(counts[counts > 0]):
        axes.set(yscale="log", ylim=(0.5, None))
    else:
        axes.yaxis.set_major_locator(MaxNLocator(integer=True))
    return figure


def draw_load_against_position(
    aggregate: Aggregate, values: ArrayLike, *, quantity: str = "tension", unit: str | None = "N"
) -> Figure:
    """A load of every contact against its distance from the centre of mass, and the mean over shells.

    Parameters
    ----------
    aggregate
        Spheres and contacts.
    values
        (C,) one value per contact in `unit`.
    quantity, unit
        As in `draw_load_distribution`.

    Raises
    ------
    ValueError
        If the number of values is not that of the contacts, or one is not finite.
    """
    given = _nonempty("values", values)
    if len(given) != len(aggregate.pairs):
        raise ValueError(f"values: expected one per contact ({len(aggregate.pairs)}), got {len(given)}")
    divisor, shown = prefixed(float(np.abs(given).max()), unit)
    place = radial_position(aggregate, aggregate.contact_points)
    figure, axes = _chart("distance from the centre / radius of gyration", f"{quantity}{_in(shown)}")
    axes.axhline(0, color=FAINT_INK, linewidth=0.6)
    colours = np.where(given >= 0, EXTENDED, SHORTENED)
    many = len(given) > MANY
    axes.scatter(place, given / divisor, _dot(3.2, len(given)) ** 2, colours, alpha=0.5, linewidth=0, rasterized=many)
    shells = np.array_split(np.argsort(place), max(1, min(12, len(place) // 12)))
    middles, means = ([float(each[shell].mean()) for shell in shells] for each in (place, given / divisor))
    axes.plot(middles, means, color="white", linewidth=3)
    axes.plot(middles, means, color=INK, linewidth=1.4, marker="o", markersize=3, label="mean of a shell")
    _legend(axes)
    return figure


def draw_critical_rates(
    radii_of_gyration: ArrayLike,
    rates: ArrayLike,
    law: PowerLaw | None = None,
    *,
    length_unit: str | None = "m",
    rate_unit: str = "1/s",
) -> Figure:
    """Critical rate against radius of gyration on logarithmic axes, one point per aggregate.

    Parameters
    ----------
    radii_of_gyration, rates
        (n,) positive.
    law
        A `power_law` of these points, to be drawn with its exponent and interval.
    length_unit, rate_unit
        Units of both; None for lengths in radii.

    Raises
    ------
    ValueError
        If the lengths differ or a number is not positive.
    """
    given = _checks.positive_array("radii_of_gyration", radii_of_gyration, ("n",))
    measured = _checks.positive_array("rates", rates, (len(given),))
    divisor, shown = prefixed(float(np.median(given)), length_unit)
    figure, axes = _chart(f"radius of gyration{_in(shown)}", f"critical rate{_in(rate_unit)}")
    axes.set(xscale="log", yscale="log")
    for axis, values in ((axes.xaxis, given), (axes.yaxis, measured)):
        _number_ticks(axis, float(values.max() / values.min()))
    size, many = _dot(3.5, len(given)), len(given) > MANY
    axes.plot(given / divisor, measured, "o", color=SERIES[0], markersize=size, alpha=0.7, mew=0, rasterized=many)
    if law is not None:
        ends = np.array([given.min(), given.max()])
        low, high = law.exponent_interval
        label = f"exponent {law.exponent:.2f} ({low:.2f} to {high:.2f})".replace("-", "−")
        axes.plot(ends / divisor, law(ends), color=INK, linewidth=1.2, label=label)
        _legend(axes)
    return figure


def draw_fragment_distributions(distributions: Mapping[str, FragmentDistribution]) -> Figure:
    """Daughter distributions of fragments by mass fraction, several side by side.

    Parameters
    ----------
    distributions
        By name, from `fragment_distribution`.

    Raises
    ------
    ValueError
        If there is none, or more than six.
    """
    _refuse_number("distributions", distributions)
    figure, axes = _chart("mass fraction of the fragment", "fragments per event and unit fraction")
    for (name, each), colour, marker in zip(distributions.items(), SERIES, MARKERS, strict=False):
        middles, density = 0.5 * (each.edges[1:] + each.edges[:-1]), each.daughter_density
        bounds = each.mean_fragments * each.number_interval / np.diff(each.edges)[:, None]
        axes.fill_between(middles, *bounds.T, color=colour, alpha=0.15, linewidth=0)
        _draw_line(axes, middles, density, name, colour, marker)
    axes.set(xlim=(0, 1), ylim=(0, None))
    _legend_above(figure, axes)
    return figure


def draw_convergence(table: ContactResponse, flow: LinearFlow) -> Figure:
    """Loads at every multipole order that was solved, as root mean square difference from the highest.

    Parameters
    ----------
    table
        From `contact_response`, with hydrodynamics of order 2 or higher.
    flow
        In which the loads are compared.

    Raises
    ------
    ValueError
        If there is no lower order to compare with.
    """
    orders = table.by_order
    if len(orders) < 2:
        raise ValueError("table: expected hydrodynamics of order 2 or higher to compare orders, got no lower order")
    figure, axes = _chart("multipole order", f"difference from order {table.order}, share of the load")
    loads = {int(each.order or 0): each.loads(flow) for each in orders}
    finest, lower = loads.pop(int(table.order or 0)), list(loads)
    for name, colour, marker in zip(("tension", "shear", "bending", "twisting"), SERIES, MARKERS, strict=False):
        exact = getattr(finest, name)
        whole = finest.force if name in ("tension", "shear") else finest.moment
        size = float(np.linalg.norm(exact))
        if size > ROUNDING * float(np.linalg.norm(whole)):
            differences = [float(np.linalg.norm(getattr(loads[each], name) - exact)) / size for each in lower]
            _draw_line(axes, lower, differences, name, colour, marker)
    axes.set_yscale("log")
    axes.set_xticks(lower)
    _legend(axes)
    return figure


def _chart(x: str, y: str) -> tuple[Figure, Axes]:
    """An empty chart with named axes."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=SIZE, dpi=160, facecolor="white", layout="constrained")
    axes = figure.add_subplot()
    axes.set_xlabel(fill(x, WIDEST_LABEL), size=SMALL, color=INK)
    axes.set_ylabel(fill(y, HIGHEST_LABEL), size=SMALL, color=INK)
    axes.spines[["top", "right"]].set_visible(False)
    axes.spines[["left", "bottom"]].set(color=FAINT_INK, linewidth=0.6)
    axes.tick_params(which="both", labelsize=TINY, width=0.6, color=FAINT_INK, labelcolor=INK)
    axes.grid(alpha=0.25, linewidth=0.5)
    axes.set_axisbelow(True)
    return figure, axes


def _draw_line(axes: Axes, x: ArrayLike, y: ArrayLike, name: str, colour: str, marker: str) -> None:
    """One of several lines, known by its marks where colours are not seen."""
    axes.plot(x, y, color=colour, linewidth=1.2, marker=marker, markersize=5, mec="white", mew=0.5, label=name)


def _legend(axes: Axes) -> None:
    axes.legend(frameon=False, fontsize=TINY, labelcolor=INK)


def _legend_above(figure: Figure, axes: Axes) -> None:
    """Legend of names of any length, in as many columns as find room above the chart, which grows by it."""
    handles, names = axes.get_legend_handles_labels()
    columns = max(1, LEGEND_WIDTH // (max(map(len, names)) + 8))
    wrapped = [fill(name, LEGEND_WIDTH) for name in names]
    legend = axes.legend(handles, wrapped, ncols=columns, loc="lower left", bbox_to_anchor=(0, 1), frameon=False)
    for text in legend.get_texts():
        text.set(size=TINY, color=INK)
    lines = sum(name.count("\n") + 1 for name in wrapped) / columns
    figure.set_size_inches(SIZE[0], SIZE[1] + LINE_HEIGHT * lines)


def _edges(values: FloatArray) -> FloatArray:
    """Edges of the bars: as far below zero as above, if there is something on both sides."""
    largest = float(np.abs(values).max()) or 1.0
    return np.linspace(-largest if values.min() < 0 else 0.0, largest if values.max() >= 0 else 0.0, BARS + 1)


def _dot(size: float, count: int) -> float:
    """Diameter of dots in points, smaller where there are many."""
    return max(SMALLEST_DOT, size * min(1.0, (MANY / count) ** 0.25))


def _number_ticks(axis: Axis, ratio: float) -> None:
    """Numbers on a logarithmic axis whose values differ by a factor: powers of ten where others find no room."""
    from matplotlib.ticker import LogFormatterMathtext, LogLocator, NullFormatter

    if ratio > 100:
        axis.set_major_formatter(LogFormatterMathtext())
        axis.set_minor_formatter(NullFormatter())
        return
    axis.set_minor_locator(LogLocator(subs=(2.0, 3.0, 5.0)))
    axis.set_major_formatter("{x:.10g}")
    axis.set_minor_formatter("{x:.10g}")


def _in(unit: str | None) -> str:
    return f" ({unit})" if unit else ""


def _nonempty(name: str, values: ArrayLike) -> FloatArray:
    given = _checks.real_array(name, values, ("C",))
    if not len(given):
        raise ValueError(f"{name}: expected at least one contact, got none")
    return given


def _refuse_number(name: str, several: Mapping[str, object]) -> None:
    if not 1 <= len(several) <= len(SERIES):
        raise ValueError(f"{name}: expected one to {len(SERIES)}, got {len(several)}; draw them in several charts")
