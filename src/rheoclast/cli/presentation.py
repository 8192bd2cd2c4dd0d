"""Summaries on the screen."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from rich.markup import escape
from rich.table import Table

from rheoclast.breakup.event import Breakup
from rheoclast.cli.console import screen
from rheoclast.report.summary import sizes_in_words
from rheoclast.view.fragments import counted
from rheoclast.view.quantities import minus, prefixed

MOST_FAILURES = 10
PREFIXED = ("m", "N", "N m")
MOMENTS = ("bending", "twisting")
ROUNDING = 1e-12
LIES_WELL = (
    "fragments keep the orientation that is given: what holds may only lie well; "
    "for what holds in the end take --orientation worst or orbit"
)


def show_shape(name: str, summary: dict[str, Any], length: str) -> None:
    """Print what an aggregate is."""
    table = _table()
    _shape_rows(table, summary, length)
    _show(name, table)


def show_stress(summary: dict[str, Any]) -> None:
    """Print what the contacts of an aggregate carry, which one fails first, and when."""
    units = summary["units"]
    table = _table()
    _shape_rows(table, summary["aggregate"], units["length"])
    table.add_section()
    model, flow = summary["model"], summary["flow"]
    _liquid_rows(table, model["name"], model["order"], model["viscosity_Pa_s"], units)
    table.add_row("flow", f"{flow['name']}, rate {_with_unit(flow['rate_per_s'], units['flow_rate'])}")
    _contact_rows(table, summary["contact_law"], units)
    _scale_rows(table, summary["scales"])
    table.add_section()
    noise = ROUNDING * max(summary["largest"][load] for load in ("tension", "compression", "shear"))
    for load, value in summary["largest"].items():
        kind, least = ("moment", noise * summary["aggregate"]["mean_radius"]) if load in MOMENTS else ("force", noise)
        table.add_row(f"largest {load}", _quoted(value if value > least else 0.0, units[kind]))
    table.add_section()
    _failure_rows(table, "as given", summary["given_orientation"], units)
    table.add_section()
    _failure_rows(table, "worst orientation", summary["worst_orientation"], units)
    _show(summary["file"], table)


def show_breakup(summary: dict[str, Any], breakup: Breakup) -> None:
    """Print how an aggregate broke, and its first failures."""
    units = summary["units"]
    table = _table()
    table.add_row("spheres, contacts", f"{summary['spheres']}, {summary['contacts']}")
    table.add_row("coordination", f"mean {summary['mean_coordination']:.3g}")
    table.add_section()
    _liquid_rows(table, summary["model"], summary["order"], summary["viscosity_Pa_s"], units)
    table.add_row("flow", f"{summary['flow_name']}, made faster from rest")
    table.add_row("orientation", _orientation(summary))
    _contact_rows(table, summary["contact_law"], units)
    table.add_section()
    for label, value in _course(summary, breakup):
        table.add_row(label, value)
    _show(summary["file"], table)
    if summary["orientation"] == "given" and "cascade" in summary:
        screen.print(LIES_WELL, soft_wrap=True)
    if breakup.failures:
        title = f"first {MOST_FAILURES} of {len(breakup.failures)} failures"
        few = len(breakup.failures) <= MOST_FAILURES
        _show(counted(len(breakup.failures), "failure") if few else title, _failures(breakup, units["rate"]))


def _course(summary: dict[str, Any], breakup: Breakup) -> Iterator[tuple[str, str]]:
    """What happened, in words and numbers."""
    rate = summary["units"]["rate"]
    yield "outcome", _outcome(breakup)
    if breakup.failures:
        first = _with_unit(breakup.initiation_rate, rate)
        yield "initiation rate", f"[bold]{first}[/bold]{_margin(summary['initiation_rate_error'])}"
    if breakup.splits:
        yield "breakup rate", f"[bold]{_with_unit(breakup.breakup_rate, rate)}[/bold]"
        if summary["failures"] > 1:
            yield "fracture surface", f"{summary['surface']} of {summary['failures']} failed contacts"
        yield "fragments", sizes_in_words(summary["fragments"])
    if summary["inwardness"] is not None:
        yield "inwardness", f"{summary['inwardness']:+.2f} (1: from the outside in, 0: no order)"
    if summary["near_ties"]:
        ties = counted(summary["near_ties"], "failure")
        yield "sequence", f"{ties} might have come in another turn, within the error of the multipole order"
    if "cascade" in summary:
        held = summary["cascade"]
        pieces = f"{counted(len(held['sizes']), 'piece')} of {sizes_in_words(held['sizes'])}"
        yield f"hold at {_with_unit(held['rate_per_s'], rate)}", pieces


def _orientation(summary: dict[str, Any]) -> str:
    seed = summary["seed"]
    return summary["orientation"] if seed is None else f"{summary['orientation']}, seed {seed}"


def _outcome(breakup: Breakup) -> str:
    count = len(breakup.failures)
    match breakup.outcome:
        case "bond":
            return "breaks at a single bond"
        case "crack":
            return f"breaks by a crack of {count} failures"
    if not count:
        return "stays whole: no contact is pulled apart, or none up to the largest rate"
    return f"stays whole: {count} contacts fail, and those that are left hold"


def _failures(breakup: Breakup, rate: str) -> Table:
    table = Table()
    for heading in ("", "contact", "spheres", f"rate, {rate}" if rate else "rate", "by", "overload", "r/Rg", "depth/a"):
        table.add_column(heading, justify="right", no_wrap=True)
    for k, failure in enumerate(breakup.failures[:MOST_FAILURES]):
        i, j = failure.pair
        place = (f"{failure.radial_position:.2f}", f"{failure.depth:.1f}")
        loaded = (f"{failure.rate:.4g}", failure.criterion, f"{failure.overload:.3g}")
        table.add_row(str(k + 1), str(failure.contact), f"{i}–{j}", *loaded, *place)
    return table


def _quoted(value: float, unit: str) -> str:
    """A value with three digits and, where it has a size, a prefix to its unit."""
    if unit not in PREFIXED:
        return _with_unit(value, unit)
    rounded = float(f"{value:.3g}")
    divisor, named = prefixed(abs(rounded), unit)
    if not rounded or abs(rounded) < divisor:
        return minus(f"{rounded:.3g} {unit}")  # nothing, or beyond the prefixes
    return minus(f"{rounded / divisor:#.3g}".rstrip(".") + f" {named}")


def _with_unit(value: float, unit: str) -> str:
    return f"{value:.4g} {unit}".rstrip()


def _show(title: str, table: Table) -> None:
    """Print a table below its title, which may be wider."""
    screen.print(f"[bold]{escape(title)}[/bold]", soft_wrap=True)
    screen.print(table)


def _table() -> Table:
    table = Table(show_header=False)
    table.add_column(style="cyan")
    table.add_column()
    return table


def _shape_rows(table: Table, summary: dict[str, Any], length: str) -> None:
    table.add_row("spheres", str(summary["spheres"]))
    table.add_row("contacts", str(summary["contacts"]))
    if summary["contacts"]:
        table.add_row("structure", f"{summary['structure']}, hyperstaticity {summary['hyperstaticity']}")
        counts = ", ".join(f"{number} × {contacts}" for contacts, number in summary["coordination_counts"].items())
        table.add_row("coordination", f"mean {summary['mean_coordination']:.3g} ({counts})")
    radius = _quoted(summary["mean_radius"], length)
    if summary["smallest_radius"] < summary["largest_radius"]:
        smallest, largest = (_quoted(summary[f"{end}_radius"], length) for end in ("smallest", "largest"))
        radius += f" (from {smallest} to {largest})"
    table.add_row("mean sphere radius", radius)
    table.add_row("radius of gyration", _quoted(summary["radius_of_gyration"], length))
    table.add_row("enclosing radius", _quoted(summary["enclosing_radius"], length))
    if summary["fractal_dimension"] is not None:
        low, high = summary["fractal_dimension"]["interval"]
        value = summary["fractal_dimension"]["value"]
        table.add_row("fractal dimension", f"{value:.2f} ({low:.2f} to {high:.2f}, from pair distances)")
    table.add_row("porosity", f"{summary['porosity']:.3g}")
    anisotropy = summary["relative_shape_anisotropy"]
    table.add_row("shape anisotropy", f"{anisotropy:.2g}" if anisotropy > ROUNDING else "0")
    if "hydrodynamic_radius" in summary:
        table.add_row("hydrodynamic radius", _quoted(summary["hydrodynamic_radius"], length))
    if "intrinsic_viscosity" in summary:
        table.add_row("intrinsic viscosity", f"{summary['intrinsic_viscosity']:.4g}")


def _liquid_rows(table: Table, model: str, order: int | None, viscosity: float, units: dict[str, str]) -> None:
    table.add_row("model", f"{model}, order {order}" if order else model)
    table.add_row("viscosity", _with_unit(viscosity, units["viscosity"]))


def _contact_rows(table: Table, told: dict[str, Any], units: dict[str, str]) -> None:
    """Material and strength; always in SI units, unless the lengths have none."""
    si = bool(units["length"])
    stiffness = "explicit stiffness" if told["law"] is None else f"{told['material']}, law {told['law']}"
    table.add_row("contacts", stiffness)
    ends = dict.fromkeys(_quoted(end, "N" if si else "") for end in told["pull_off_N"])
    table.add_row("pull-off force", " to ".join(ends) + ", as given" * told["pull_off_given"])
    if told["friction"] is not None:
        table.add_row("friction", f"{told['friction']:.4g}")
    if told["rolling_distance_m"] is not None:
        table.add_row("rolling distance", _quoted(told["rolling_distance_m"], "m" if si else ""))


def _scale_rows(table: Table, scales: dict[str, float]) -> None:
    """What the units a, μ, G and F are."""
    if scales:
        length, force = _quoted(scales["a_m"], "m"), _quoted(scales["F_N"], "N")
        table.add_row("units", f"a = {length}, G = {_with_unit(scales['G_per_s'], '1/s')}, F = {force}")


def _failure_rows(table: Table, orientation: str, failure: dict[str, Any], units: dict[str, str]) -> None:
    if failure["contact"] is None:
        table.add_row(f"critical contact, {orientation}", "none: no contact is pulled apart")
        return
    i, j = failure["pair"]
    where = f"{failure['contact']} (spheres {i} and {j}, {failure['radial_position']:.2f} Rg from the centre)"
    table.add_row(f"critical contact, {orientation}", where)
    strength = _quoted(failure["pull_off_force"], units["force"])
    table.add_row("fails by", f"{failure['criterion']}, pull-off force {strength}")
    rate = _with_unit(failure["initiation_rate"], units["rate"])
    table.add_row("initiation rate", f"[bold]{rate}[/bold]{_margin(failure['initiation_rate_error'])}")


def _margin(error: float | None) -> str:
    return "" if error is None else f", ± {error:.1%} from the multipole order"
