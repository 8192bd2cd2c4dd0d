"""Charts of loads, critical rates, fragments and convergence, in one quiet style for print and the colour-blind."""

from __future__ import annotations

from collections.abc import Mapping
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
    from matplotlib.figure import Figure

BARS = 40
# M. Okabe and K. Ito, Color universal design (2008): told apart with every kind of colour vision.
SERIES = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9")
MARKERS = "os^Dv>"
SIZE = (5.6, 3.8)  # inches
ROUNDING = 1e-9  # of forces or moments: smaller loads vanish by symmetry


def draw_load_distribution(values: ArrayLike, *, quantity: str = "tension", unit: str | None = "N") -> Figure:
    """Histogram of a load over all contacts, what pulls apart from what presses together.

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
    given = _nonempty("values", values)
    divisor, shown = prefixed(float(np.abs(given).max()), unit)
    figure, axes = _chart(f"{quantity}{_in(shown)}", "contacts")
    largest = float(np.abs(given).max()) / divisor or 1.0
    low = -largest if given.min() < 0 else 0.0
    edges = np.linspace(low, largest, BARS + 1)
    for part, colour in ((given >= 0, EXTENDED), (given < 0, SHORTENED)):
        axes.hist(given[part] / divisor, edges.tolist(), color=colour, alpha=0.85, edgecolor="white", linewidth=0.4)
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
    axes.scatter(place, given / divisor, 10, np.where(given >= 0, EXTENDED, SHORTENED), alpha=0.5, linewidth=0)
    shells = np.array_split(np.argsort(place), max(1, min(12, len(place) // 12)))
    middles, means = ([float(each[shell].mean()) for shell in shells] for each in (place, given / divisor))
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
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter("{x:g}")
    axes.xaxis.set_minor_formatter("{x:g}")
    axes.plot(given / divisor, measured, "o", color=SERIES[0], markersize=3.5, alpha=0.7)
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
        axes.plot(middles, density, color=colour, marker=marker, markersize=3.5, linewidth=1.2, label=name)
    axes.set(xlim=(0, 1), ylim=(0, None))
    _legend(axes)
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
    orders = _orders(table)
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
            axes.plot(lower, differences, color=colour, marker=marker, markersize=4, linewidth=1.2, label=name)
    axes.set_yscale("log")
    axes.set_xticks(lower)
    _legend(axes)
    return figure


def _orders(table: ContactResponse) -> list[ContactResponse]:
    """The tables from the lowest order to this one."""
    return [*(_orders(table.coarser) if table.coarser is not None else []), table]


def _chart(x: str, y: str) -> tuple[Figure, Axes]:
    """An empty chart with named axes."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=SIZE, dpi=160, facecolor="white", layout="constrained")
    axes = figure.add_subplot()
    axes.set_xlabel(x, size=SMALL, color=INK)
    axes.set_ylabel(y, size=SMALL, color=INK)
    axes.spines[["top", "right"]].set_visible(False)
    axes.spines[["left", "bottom"]].set(color=FAINT_INK, linewidth=0.6)
    axes.tick_params(which="both", labelsize=TINY, width=0.6, color=FAINT_INK, labelcolor=INK)
    axes.grid(alpha=0.25, linewidth=0.5)
    axes.set_axisbelow(True)
    return figure, axes


def _legend(axes: Axes) -> None:
    axes.legend(frameon=False, fontsize=TINY, labelcolor=INK)


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
