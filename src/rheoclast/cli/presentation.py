"""Summaries on the screen."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import Any

from rich.markup import escape
from rich.table import Table

from rheoclast.breakup.event import Breakup
from rheoclast.cli.console import screen
from rheoclast.view.quantities import quoted

MOST_FAILURES, MOST_SIZES = 10, 12
PREFIXED = ("m", "N", "N m")


def show_shape(name: str, summary: dict[str, Any], length: str) -> None:
    """Print what an aggregate is."""
    table = _table(name)
    _shape_rows(table, summary, length)
    screen.print(table)


def show_stress(name: str, summary: dict[str, Any]) -> None:
    """Print what the contacts of an aggregate carry, which one fails first, and when."""
    units = summary["units"]
    table = _table(name)
    _shape_rows(table, summary["aggregate"], units["length"])
    table.add_section()
    _flow_rows(table, summary)
    table.add_section()
    for load, value in summary["largest"].items():
        unit = units["moment" if load in ("bending", "twisting") else "force"]
        table.add_row(f"largest {load}", _quoted(value, unit))
    table.add_section()
    _failure_rows(table, "as given", summary["given_orientation"], units)
    table.add_section()
    _failure_rows(table, "worst orientation", summary["worst_orientation"], units)
    screen.print(table)


def show_breakup(name: str, summary: dict[str, Any], breakup: Breakup) -> None:
    """Print how an aggregate broke, and its first failures."""
    table = _table(name)
    table.add_row("spheres, contacts", f"{summary['spheres']}, {summary['contacts']}")
    table.add_row("coordination", f"mean {summary['mean_coordination']:.3g}")
    table.add_row("orientation", summary["orientation"])
    table.add_section()
    table.add_row("outcome", _outcome(breakup))
    if breakup.failures:
        table.add_row("initiation rate", f"[bold]{breakup.initiation_rate:.4g} 1/s[/bold]")
    if breakup.splits:
        table.add_row("breakup rate", f"[bold]{breakup.breakup_rate:.4g} 1/s[/bold]")
        table.add_row("fracture surface", f"{summary['surface']} of {summary['failures']} failed contacts")
        table.add_row("fragments", _sizes(summary["fragments"]))
    if summary["inwardness"] is not None:
        table.add_row("inwardness", f"{summary['inwardness']:+.2f} (1: from the outside in, 0: no order)")
    if summary["near_ties"]:
        table.add_row("sequence", f"{summary['near_ties']} failures are ties within the error of the multipole order")
    if "cascade" in summary:
        sizes = summary["cascade"]["sizes"]
        table.add_row(f"hold at {summary['cascade']['rate_per_s']:.4g} 1/s", f"{len(sizes)}: {_sizes(sizes)}")
    screen.print(table)
    if breakup.failures:
        screen.print(_failures(breakup))


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


def _sizes(sizes: Sequence[int]) -> str:
    """Numbers of spheres, equal ones counted."""
    counts = Counter(sizes)
    shown = [f"{counts[size]} × {size}" if counts[size] > 1 else str(size) for size in sorted(counts, reverse=True)]
    return ", ".join(shown[:MOST_SIZES]) + (", …" if len(shown) > MOST_SIZES else "") + " spheres"


def _failures(breakup: Breakup) -> Table:
    table = Table(title=f"first failures of {len(breakup.failures)}", title_justify="left")
    for heading in ("", "contact", "spheres", "rate, 1/s", "by", "overload", "r/Rg", "depth/a"):
        table.add_column(heading, justify="right", no_wrap=True)
    for k, failure in enumerate(breakup.failures[:MOST_FAILURES]):
        i, j = failure.pair
        place = (f"{failure.radial_position:.2f}", f"{failure.depth:.1f}")
        loaded = (f"{failure.rate:.4g}", failure.criterion, f"{failure.overload:.3g}")
        table.add_row(str(k + 1), str(failure.contact), f"{i}–{j}", *loaded, *place)
    return table


def _quoted(value: float, unit: str) -> str:
    return quoted(value, unit) if unit in PREFIXED else f"{value:.4g} {unit}"


def _table(title: str) -> Table:
    table = Table(title=escape(title), show_header=False, title_justify="left", title_style="bold")
    table.add_column(style="cyan")
    table.add_column()
    return table


def _shape_rows(table: Table, summary: dict[str, Any], length: str) -> None:
    table.add_row("spheres", str(summary["spheres"]))
    table.add_row("contacts", str(summary["contacts"]))
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
    shape = f"{summary['porosity']:.3g}, relative shape anisotropy {summary['relative_shape_anisotropy']:.2g}"
    table.add_row("porosity", shape)
    if "hydrodynamic_radius" in summary:
        table.add_row("hydrodynamic radius", _quoted(summary["hydrodynamic_radius"], length))
    if "intrinsic_viscosity" in summary:
        table.add_row("intrinsic viscosity", f"{summary['intrinsic_viscosity']:.4g}")


def _flow_rows(table: Table, summary: dict[str, Any]) -> None:
    model, flow = summary["model"], summary["flow"]
    order = f", order {model['order']}" if model["order"] else ""
    table.add_row("model", f"{model['name']}{order}")
    table.add_row("viscosity", f"{model['viscosity_Pa_s']:.4g} Pa s")
    table.add_row("flow", f"{flow['name']}, rate {flow['rate_per_s']:.4g} 1/s")


def _failure_rows(table: Table, orientation: str, failure: dict[str, Any], units: dict[str, str]) -> None:
    if failure["contact"] is None:
        table.add_row(f"critical contact, {orientation}", "none: no contact is pulled apart")
        return
    i, j = failure["pair"]
    where = f"{failure['contact']} (spheres {i} and {j}, {failure['radial_position']:.2f} Rg from the centre)"
    table.add_row(f"critical contact, {orientation}", where)
    strength = _quoted(failure["pull_off_force"], units["force"])
    table.add_row("fails by", f"{failure['criterion']}, pull-off force {strength}")
    error = failure["critical_rate_error"]
    margin = "" if error is None else f", ± {error:.1%} from the multipole order"
    table.add_row("critical rate", f"[bold]{failure['critical_rate']:.4g} {units['rate']}[/bold]{margin}")
