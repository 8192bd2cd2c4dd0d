"""What stands in words and numbers on the page: a sentence, key figures, and groups of properties."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rheoclast._checks import FloatArray
from rheoclast.report.result import Result
from rheoclast.report.wording import flow_name, percent, written
from rheoclast.view.fragments import counted

MOST_SIZES = 8
MEANINGLESS = 1e3  # relative error of a tension that is zero but for rounding
RULES = {"weakest": "the weakest contact fails first", "overloaded": "all overloaded contacts fail at once"}
MODELS = {"StokesianDynamics": "Stokesian dynamics", "FreeDraining": "free draining", "ExposedArea": "exposed area"}


@dataclass(frozen=True)
class Figure:
    """One number that matters most, and what is to be known with it."""

    label: str
    value: str
    note: str = ""


@dataclass(frozen=True)
class Group:
    """Properties under one heading, each a label and a value."""

    heading: str
    rows: tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class Summary:
    """All of the page that is text."""

    lead: str
    figures: tuple[Figure, ...]
    groups: tuple[Group, ...]


def summary(result: Result) -> Summary:
    """The text of the page on a result."""
    return _breakup(result) if result.is_breakup else _stress(result)


def _stress(result: Result) -> Summary:
    told, units = result.summary, result.units
    shape = told["aggregate"]
    lead = (
        f"{_size(shape['spheres'], shape['contacts'])} in {_at_rate(result)}: "
        "the load on every contact, and the contact that fails first as the flow is made faster."
    )
    loads = tuple((f"Largest {load}", _largest(load, value, units)) for load, value in _largest_loads(result).items())
    groups = (
        Group("Aggregate", _shape(shape, units)),
        Group("Flow", _liquid(result)),
        Group("Strength of contacts", _contacts(told["contact_law"], units)),
        Group("Loads", loads),
    )
    return Summary(lead, _stress_figures(result), groups)


def _stress_figures(result: Result) -> tuple[Figure, ...]:
    told, units = result.summary, result.units
    most, tension = told["most_tensioned"], _largest_loads(result)["tension"]
    pair = "–".join(str(sphere) for sphere in most["pair"])
    place = f"contact {most['contact']}, spheres {pair}" if tension > 0 else "no contact is pulled apart"
    ratio = float(result.contacts["load_ratio"].max())
    return (
        _critical("Initiation rate, as it lies", told["given_orientation"], units["rate"]),
        _critical("Initiation rate, worst orientation", told["worst_orientation"], units["rate"]),
        Figure("Largest tension", _largest("tension", tension, units), place),
        Figure("Largest load over strength", written(ratio, digits=3), "fails at 1"),
    )


def _at_rate(result: Result) -> str:
    name, rate = flow_name(result.flow), result.flow.rate
    return f"{name} of rate {written(rate, result.units['flow_rate'])}" if rate else name


def _liquid(result: Result) -> tuple[tuple[str, str], ...]:
    model = result.summary["model"]
    return (
        ("Flow", _at_rate(result)),
        ("Velocity gradient", f"{matrix(result.flow.gradient)} {result.units['flow_rate']}".rstrip()),
        ("Viscosity", written(model["viscosity_Pa_s"], result.units["viscosity"])),
        ("Hydrodynamics", _model(model["name"], model["order"])),
    )


def _contacts(told: Mapping[str, Any], units: Mapping[str, str]) -> tuple[tuple[str, str], ...]:
    """What holds the contacts; in SI units, unless the lengths have none."""
    given = {
        "Young's modulus": (told["youngs_modulus_Pa"], "Pa"),
        "Poisson's ratio": (told["poisson_ratio"], ""),
        "Work of adhesion": (told["work_of_adhesion_J_m2"], "J/m²"),
        "Friction": (told["friction"], ""),
        "Rolling distance": (told["rolling_distance_m"], "m"),
    }
    si = bool(units["length"])
    ends = dict.fromkeys(written(end, "N" if si else "") for end in told["pull_off_N"])
    law = "explicit stiffness" if told["law"] is None else f"{told['material']}, law {told['law']}"
    return (
        ("Contacts", law),
        ("Pull-off force", " to ".join(ends) + (", as given" if told["pull_off_given"] else "")),
        *((label, written(value, unit if si else "")) for label, (value, unit) in given.items() if value is not None),
    )


def _largest_loads(result: Result) -> dict[str, float]:
    """Of all contacts, by kind of load."""
    tension = result.contacts["tension"]
    others = {load: float(np.abs(result.contacts[load]).max()) for load in ("shear", "bending", "twisting")}
    return {"tension": float(tension.max()), "compression": -float(tension.min()), **others}


def _largest(load: str, value: float, units: Mapping[str, str]) -> str:
    """A load in words; a tension or a compression that is not positive is none."""
    if value <= 0:
        return "none"
    return written(value, units["moment" if load in ("bending", "twisting") else "force"])


def _critical(label: str, failure: Mapping[str, Any], unit: str) -> Figure:
    error = failure.get("initiation_rate_error")
    if failure["contact"] is None or (error or 0.0) > MEANINGLESS:
        return Figure(label, "none", "no contact is pulled apart")
    note = f"contact {failure['contact']}, by {failure['criterion']}"
    return Figure(
        label, written(failure["initiation_rate"], unit), note if error is None else f"{_error(error)}; {note}"
    )


def _error(share: float) -> str:
    return f"± {percent(share)} from the multipole order"


def _shape(shape: Mapping[str, Any], units: Mapping[str, str]) -> tuple[tuple[str, str], ...]:
    lengths = ("mean_radius", "radius_of_gyration", "enclosing_radius", "hydrodynamic_radius")
    rows = [
        ("Spheres", str(shape["spheres"])),
        ("Contacts", f"{shape['contacts']}, {written(shape['mean_coordination'], digits=3)} per sphere on average"),
        ("Structure", f"{shape['structure']}, hyperstaticity {shape['hyperstaticity']}"),
        *((key.replace("_", " ").capitalize(), written(shape[key], units["length"])) for key in lengths),
    ]
    if shape["fractal_dimension"] is not None:
        low, high = shape["fractal_dimension"]["interval"]
        rows.append(("Fractal dimension", f"{shape['fractal_dimension']['value']:.2f} ({low:.2f} to {high:.2f})"))
    rows.append(("Porosity", written(shape["porosity"], digits=3)))
    return tuple(rows)


def _breakup(result: Result) -> Summary:
    told = result.summary
    kind = flow_name(result.flow)
    lead = f"{_size(told['spheres'], told['contacts'])} in {kind}, which is made faster from rest: {_outcome(told)}."
    flow = (
        ("Flow", kind),
        ("Orientation", told["orientation"] if told["seed"] is None else f"random, seed {told['seed']}"),
        ("Velocity gradient, over its rate", matrix(result.flow.gradient / result.flow.rate)),
        ("Viscosity", written(told["viscosity_Pa_s"], result.units["viscosity"])),
        ("Hydrodynamics", _model(told["model"], told["order"])),
    )
    aggregate = (
        ("Spheres", str(told["spheres"])),
        ("Contacts", f"{told['contacts']}, {written(told['mean_coordination'], digits=3)} per sphere on average"),
        ("Radius of gyration", written(told["radius_of_gyration_m"], result.units["length"])),
    )
    groups = (
        Group("Aggregate", aggregate),
        Group("Flow", flow),
        Group("Strength of contacts", _contacts(told["contact_law"], told["units"])),
        Group("Breakup", _course(told)),
    )
    return Summary(lead, _breakup_figures(told), groups)


def _breakup_figures(told: Mapping[str, Any]) -> tuple[Figure, ...]:
    error, ties = told["initiation_rate_error"], told["near_ties"]
    held = told.get("cascade")
    first, last = told["initiation_rate_per_s"], told["breakup_rate_per_s"]
    sizes, unit = told["fragments"], told["units"]["rate"]
    return (
        Figure("Initiation rate", _rate(first, unit), "" if error is None else _error(error)),
        Figure("Breakup rate", _rate(last, unit), _compared(first, last)),
        Figure("Failed contacts", str(told["failures"]), f"{ties} of them near ties" if ties else ""),
        Figure("Fragments" if held is None else "Fragments of the first split", str(len(sizes)), sizes_in_words(sizes)),
        *([] if held is None else [_held(held, unit)]),
    )


def _compared(first: float | None, last: float | None) -> str:
    """The breakup rate in terms of the initiation rate."""
    if first is None or last is None:
        return "stays whole"
    return "with the first failure" if last == first else f"{written(last / first)} × initiation rate"


def _held(cascade: Mapping[str, Any], unit: str) -> Figure:
    """What is left once the fragments have been broken too."""
    sizes = cascade["sizes"]
    return Figure(f"Pieces that hold at {written(cascade['rate_per_s'], unit)}", str(len(sizes)), sizes_in_words(sizes))


def _rate(rate: float | None, unit: str) -> str:
    return "none" if rate is None else written(rate, unit)


def _outcome(told: Mapping[str, Any]) -> str:
    match told["outcome"]:
        case "bond":
            return "it breaks at a single bond"
        case "crack":
            return f"it breaks by a crack of {told['failures']} failures"
    if told["failures"]:
        return f"{counted(told['failures'], 'contact')} fail, and it stays whole"
    return "it stays whole"


def _course(told: Mapping[str, Any]) -> tuple[tuple[str, str], ...]:
    rows = [
        ("Rule", RULES[told["rule"]]),
        ("A contact fails by", told["criterion"]),
        ("Fracture surface", f"{told['surface']} of {told['failures']} failed contacts"),
    ]
    if told["up_to_per_s"] is not None:
        rows.append(("Largest rate", written(told["up_to_per_s"], told["units"]["rate"])))
    if told["inwardness"] is not None:
        rows.append(("Inwardness", f"{written(told['inwardness'], digits=2)} (1: from the outside in, 0: no order)"))
    if told["near_ties"] is not None:
        rows.append(
            ("Near ties", f"{told['near_ties']} failures whose place is within the error of the multipole order")
        )
    if "cascade" in told:
        rate, sizes = _rate(told["cascade"]["rate_per_s"], told["units"]["rate"]), told["cascade"]["sizes"]
        rows.append((f"Hold at {rate}", f"{counted(len(sizes), 'piece')}: {sizes_in_words(sizes)}"))
    return tuple(rows)


def _size(spheres: int, contacts: int) -> str:
    return f"{counted(spheres, 'sphere')} with {counted(contacts, 'contact')}"


def sizes_in_words(sizes: Sequence[int]) -> str:
    """Numbers of spheres, equal ones counted: "2 × 50, 20 and 1 spheres"."""
    counts = Counter(sizes)
    shown = [f"{counts[size]} × {size}" if counts[size] > 1 else str(size) for size in sorted(counts, reverse=True)]
    if len(shown) > MOST_SIZES:
        return f"{', '.join(shown[:MOST_SIZES])}, … spheres"
    listed = " and ".join([", ".join(shown[:-1]), shown[-1]] if shown[1:] else shown)
    return f"{listed} sphere{'s' * (listed != '1')}"


def _model(name: str, order: int | None) -> str:
    return MODELS.get(name, name) + (f", multipole order {order}" if order else "")


def matrix(values: FloatArray) -> str:
    """Nine numbers in brackets, row by row."""
    return "[" + "; ".join(", ".join(written(value, digits=3) for value in row) for row in values) + "]"
