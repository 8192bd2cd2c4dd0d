"""What `rheoclast break` computes and leaves in a folder."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, Literal

import numpy as np

from rheoclast import io, view
from rheoclast._checks import IntArray
from rheoclast.breakup.cascade import Cascade, Piece, cascade
from rheoclast.breakup.contact_response import ContactResponse, contact_response
from rheoclast.breakup.crack import Rule, break_up
from rheoclast.breakup.event import Breakup, Failure
from rheoclast.breakup.initiation import initiation
from rheoclast.breakup.orientation import flow_met
from rheoclast.breakup.truncation import rate_error
from rheoclast.cli.analysis import Analysis
from rheoclast.cli.results import finished_together
from rheoclast.cli.tables import contact_table, sphere_table
from rheoclast.cli.units import UnitNames, Units
from rheoclast.flows import LinearFlow
from rheoclast.hydrodynamics.response import RigidResponse
from rheoclast.io.contact_table import write_pairs
from rheoclast.io.lengths import DIMENSIONLESS
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.criteria.criterion import Criterion
from rheoclast.mechanics.criteria.load_ratios import load_ratios
from rheoclast.particles.aggregate import Aggregate
from rheoclast.particles.morphology import mean_coordination, radius_of_gyration, relative_shape_anisotropy
from rheoclast.populations.orientations import random_orientations
from rheoclast.progress import Progress

FILES = (
    "summary.json",
    "contacts.csv",
    "spheres.csv",
    "failures.csv",
    "fragments.csv",
    "pieces.csv",
    "crack.png",
    "crack.gif",
    "report.html",
    "fragment_[0-9]*.dat",
    "fragment_[0-9]*_contacts.csv",
)
Orientation = Literal["given", "worst", "orbit", "random"]


@dataclass(frozen=True, eq=False)
class Broken:
    """A breakup, the flow in the orientation in which the aggregate met it, and the loads before it breaks.

    These are at the rate at which the first contact fails, or at that of the flow where none does.
    """

    breakup: Breakup
    flow: LinearFlow
    intact: Analysis
    criterion: Criterion


@dataclass(frozen=True, eq=False)
class Setting:
    """An aggregate, its contacts, and the flow that is to break it."""

    aggregate: Aggregate
    response: RigidResponse
    bonds: Bonds
    flow: LinearFlow
    rule: Rule
    criterion: Criterion
    orientation: Orientation

    def broken(self, seed: int, up_to: float) -> Broken:
        """The breakup in the chosen orientation."""
        orientation = random_orientations(1, seed)[0] if self.orientation == "random" else self.orientation
        whole = (self.aggregate, self.response, self.bonds)
        flow = flow_met(*whole, self.flow, orientation=orientation, criterion=self.criterion, table=self._table)
        breakup = break_up(*whole, flow, rule=self.rule, criterion=self.criterion, up_to=up_to)
        return Broken(breakup, flow, self._intact(breakup, flow), self.criterion)

    def _intact(self, breakup: Breakup, flow: LinearFlow) -> Analysis:
        critical = flow.scaled(breakup.initiation_rate / flow.rate) if breakup.failures else flow
        return Analysis(self.aggregate, critical, self.bonds, self.response, self._table)

    @cached_property
    def _table(self) -> ContactResponse:
        return contact_response(self.aggregate, self.response, self.bonds)

    def cascade(self, flow: LinearFlow, progress: Progress) -> Cascade:
        """What becomes of the fragments at the rate of the flow; from a random orientation on, as that turned out."""
        met, orientation = (flow, "given") if self.orientation == "random" else (self.flow, self.orientation)
        whole = (self.aggregate, self.response, self.bonds)
        return cascade(
            *whole, met, orientation=orientation, rule=self.rule, criterion=self.criterion, progress=progress
        )


def breakup_summary(setting: Setting, broken: Broken, pieces: Cascade | None) -> dict[str, Any]:
    """What came of it, ready for JSON: SI units, none where a rate is infinite."""
    breakup, aggregate = broken.breakup, setting.aggregate
    summary: dict[str, Any] = {
        "spheres": len(aggregate),
        "contacts": len(aggregate.pairs),
        "mean_coordination": mean_coordination(aggregate),
        "radius_of_gyration_m": radius_of_gyration(aggregate.spheres),
        "model": type(setting.response.model).__name__,
        "order": setting.response.order,
        "viscosity_Pa_s": setting.response.viscosity,
        "orientation": setting.orientation,
        "flow_gradient_per_s": broken.flow.gradient.tolist(),
        "flow_rate_per_s": broken.flow.rate,
        "rule": setting.rule,
        "criterion": setting.criterion.name,
        "outcome": breakup.outcome,
        "initiation_rate_per_s": _finite(breakup.initiation_rate),
        "initiation_rate_error": _initiation_error(broken),
        "breakup_rate_per_s": _finite(breakup.breakup_rate),
        "failures": len(breakup.failures),
        "surface": len(breakup.surface),
        "inwardness": _finite(breakup.inwardness),
        "near_ties": _near_ties(breakup),
        "contact_loads_at_rate_per_s": broken.intact.flow.rate,
        "fragments": [len(spheres) for spheres in breakup.spheres],
    }
    if pieces is not None:
        summary["cascade"] = {"rate_per_s": pieces.flow.rate, "sizes": pieces.sizes.tolist()}
    return summary


def _finite(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


def _initiation_error(broken: Broken) -> float | None:
    """Expected relative error of the initiation rate from truncation; none where nothing fails or it is not known."""
    if not broken.breakup.failures:
        return None
    table, bonds = broken.intact.table, broken.intact.bonds
    return rate_error(table, bonds, initiation(table, bonds, broken.flow, criterion=broken.criterion))


def _near_ties(breakup: Breakup) -> int | None:
    """Number of failures within the error bar; none if there is no error bar."""
    return None if any(failure.rivals is None for failure in breakup.failures) else len(breakup.near_ties())


def write_breakup(
    folder: Path, broken: Broken, pieces: Cascade | None, summary: str, units: Units, animation: bool
) -> None:
    """Write tables, fragments, pictures and the summary into a folder, which is made if needed."""
    breakup, tags = broken.breakup, units.tags
    length_unit = units.names.length or None
    held = None if pieces is None else _held(pieces)
    remaining = breakup.fragments if held is None else tuple(piece.aggregate for piece in held)
    with finished_together(folder, FILES) as unfinished:
        (unfinished / "summary.json").write_text(summary + "\n", encoding="utf-8")
        io.write_table(unfinished / "contacts.csv", intact_table(broken, units))
        spheres = sphere_table(broken.intact, units) | _fragment_columns(breakup, held)
        io.write_table(unfinished / "spheres.csv", spheres)
        if breakup.failures:
            io.write_table(unfinished / "failures.csv", failure_table(breakup, tags))
        io.write_table(unfinished / "fragments.csv", fragment_table(remaining, tags))
        if pieces is not None:
            io.write_table(unfinished / "pieces.csv", piece_table(pieces, tags))
        digits = len(str(len(remaining)))
        for k, fragment in enumerate(remaining):
            _write_fragment(unfinished, f"fragment_{k + 1:0{digits}d}", fragment, length_unit or DIMENSIONLESS)
        view.save(view.draw_crack(breakup, flow=broken.flow, length_unit=length_unit), unfinished / "crack.png")
        if animation:
            view.animate_crack(breakup, unfinished / "crack.gif", flow=broken.flow, length_unit=length_unit)


def _write_fragment(folder: Path, name: str, fragment: Aggregate, unit: str) -> None:
    """Spheres, and the contacts that are left: fewer than those that touch."""
    io.write(folder / f"{name}.dat", fragment, unit=unit)
    write_pairs(folder / f"{name}_contacts.csv", fragment.pairs)


def intact_table(broken: Broken, units: Units) -> dict[str, Any]:
    """Columns with one row per contact before any has failed; `load_ratio` is that of the criterion in use."""
    intact = broken.intact
    ratios = load_ratios(intact.contact_loads, intact.bonds, criterion=broken.criterion)
    return contact_table(intact, units) | {"load_ratio": ratios.max(axis=-1)}


def _held(pieces: Cascade) -> list[Piece]:
    """What holds in the end of a cascade, the largest first."""
    return sorted((piece for piece in pieces.pieces if piece.holds), key=lambda piece: len(piece.spheres), reverse=True)


def _fragment_columns(breakup: Breakup, held: list[Piece] | None) -> dict[str, Any]:
    """Columns with the fragment that each sphere is in: in the end and, before a cascade, after the first split."""
    first = _numbered(breakup.spheres, len(breakup.aggregate))
    if held is None:
        return {"fragment": first}
    return {"fragment": _numbered([piece.spheres for piece in held], len(first)), "first_fragment": first}


def _numbered(parts: Sequence[IntArray], count: int) -> IntArray:
    """Number of the part that each of some spheres is in, the first being 1."""
    number = np.empty(count, dtype=np.intp)
    for k, spheres in enumerate(parts):
        number[spheres] = k + 1
    return number


def failure_table(breakup: Breakup, tags: UnitNames) -> dict[str, Any]:
    """Columns with one row per failure, in order."""
    failures = breakup.failures
    surface = {failure.contact for failure in breakup.surface}

    def column(value: Callable[[Failure], Any]) -> Any:
        return np.array([value(failure) for failure in failures])

    return {
        "failure": np.arange(1, len(failures) + 1),
        "contact": column(lambda failure: failure.contact),
        "i": column(lambda failure: failure.pair[0]),
        "j": column(lambda failure: failure.pair[1]),
        f"point{tags.length}": breakup.aggregate.contact_points[column(lambda failure: failure.contact)],
        f"rate{tags.rate}": column(lambda failure: failure.rate),
        f"reached{tags.rate}": column(lambda failure: failure.reached),
        "overload": column(lambda failure: failure.overload),
        "criterion": column(lambda failure: failure.criterion),
        "margin": column(lambda failure: failure.margin),
        "rivals": column(lambda failure: -1 if failure.rivals is None else len(failure.rivals)),
        "radial_position": column(lambda failure: failure.radial_position),
        "depth": column(lambda failure: failure.depth),
        "on_surface": column(lambda failure: int(failure.contact in surface)),
    }


def piece_table(pieces: Cascade, tags: UnitNames) -> dict[str, Any]:
    """Columns of `Cascade.table`, whose names have their unit only where there is one."""
    columns = pieces.table()
    if tags.length:
        return columns
    return {name.removesuffix("_m").removesuffix("_per_s"): values for name, values in columns.items()}


def fragment_table(fragments: tuple[Aggregate, ...], tags: UnitNames) -> dict[str, Any]:
    """Columns with one row per fragment, the largest first."""
    return {
        "fragment": np.arange(1, len(fragments) + 1),
        "spheres": np.array([len(each) for each in fragments]),
        "contacts": np.array([len(each.pairs) for each in fragments]),
        f"radius_of_gyration{tags.length}": np.array([radius_of_gyration(each.spheres) for each in fragments]),
        "shape_anisotropy": np.array([relative_shape_anisotropy(each.spheres) for each in fragments]),
        "coordination": np.array([mean_coordination(each) for each in fragments]),
    }
