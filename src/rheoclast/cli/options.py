"""The options of the commands, in groups that several of them share, and the values made from them."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from inspect import signature
from pathlib import Path
from typing import Annotated, Any, Literal, get_args

import numpy as np
import typer

from rheoclast import _checks, io, names
from rheoclast.breakup.crack import Rule
from rheoclast.cli.breakup import Orientation
from rheoclast.cli.speech import number, one_of, whole_number
from rheoclast.flows import LinearFlow
from rheoclast.hydrodynamics.model import HydrodynamicModel
from rheoclast.hydrodynamics.response import DIMENSIONLESS_VISCOSITY
from rheoclast.io.lengths import DIMENSIONLESS
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.criteria.criterion import Criterion
from rheoclast.mechanics.laws.law import ContactLaw
from rheoclast.mechanics.material import MATERIALS
from rheoclast.particles.aggregate import Aggregate
from rheoclast.particles.contacts import CONTACT_TOLERANCE

AGGREGATE, FLOW, LIQUID = "Aggregate", "Flow", "Liquid and model"
BONDS, BREAKUP, OUTPUT = "Contacts", "Breakup", "Output"

FLAG = " "
"""In place of a kind of value, which a flag does not take."""

PROPERTIES = {
    "youngs_modulus": "youngs_modulus_Pa",
    "poisson_ratio": "poisson_ratio",
    "work_of_adhesion": "work_of_adhesion_J_m2",
}
"""Properties of a material, and their names in a summary."""


def valued(metavar: str, help_text: str, panel: str | None = None, **more: Any) -> Any:
    """An option with a value; there is no default to be shown where it is none."""
    return typer.Option(metavar=metavar, help=help_text, rich_help_panel=panel, **more)


def _choice(option: str, choices: Collection[str], help_text: str, panel: str, **more: Any) -> Any:
    """An option whose value is one of some names, which stand for `{}` in its help and which the shell completes."""
    return typer.Option(
        option,
        metavar="<name>",
        **more,
        help=help_text.format(", ".join(choices)),
        autocompletion=lambda: list(choices),
        rich_help_panel=panel,
    )


def _number(help_text: str, panel: str) -> Any:
    """An option whose value is a number."""
    return valued("<number>", help_text, panel, parser=number)


def _flag(option: str, help_text: str, panel: str) -> Any:
    """An option that is there or not."""
    return typer.Option(option, metavar=FLAG, help=help_text, rich_help_panel=panel)


def folder(given: str) -> Path:
    """The folder of a name.

    Raises
    ------
    typer.BadParameter
        If the name is empty.
    """
    if not str(given).strip():
        raise typer.BadParameter("expected the name of a folder, got nothing; a point stands for the current one")
    return Path(given)


Format = Annotated[
    str | None,
    typer.Option(
        "--format",
        metavar="<name>",
        help="text, csv, xyz, lammps-dump or lammps-data; by default from the file.",
        rich_help_panel=AGGREGATE,
    ),
]
FormatToWrite = Annotated[
    str | None,
    typer.Option(
        "--format",
        metavar="<name>",
        help="text, csv, xyz, lammps-dump, lammps-data or vtp; by default from the name of the file.",
        rich_help_panel=OUTPUT,
    ),
]
Viscosity = Annotated[float, _number("Viscosity of the liquid, Pa s.", LIQUID)]
Animation = Annotated[bool, _flag("--animation", "Write crack.gif too.", OUTPUT)]
Output = Annotated[
    Path | None,
    valued("<folder>", "Folder for tables, geometry, pictures and summary.", OUTPUT, parser=folder),
]
Overwrite = Annotated[bool, _flag("--overwrite", "Replace files that exist.", OUTPUT)]
Json = Annotated[bool, _flag("--json", "Print the summary as JSON and nothing else.", OUTPUT)]
Dimensionless = Annotated[
    bool,
    _flag(
        "--dimensionless",
        "Results in units of mean radius a, viscosity μ and rate G: forces in μGa², moments in μGa³, rates of failure "
        "in F/μa² with the mean pull-off force F.",
        OUTPUT,
    ),
]


@dataclass(frozen=True)
class AggregateFile:
    """Where an aggregate is read from."""

    file: Annotated[
        Path, typer.Argument(help="Spheres: text (x y z r), CSV, XYZ, LAMMPS dump or data.", show_default=False)
    ]
    unit: Annotated[
        str,
        typer.Option(
            metavar="<unit>",
            help="Unit of length in the file: m, mm, um, nm, angstrom, a number in metres, or dimensionless.",
            rich_help_panel=AGGREGATE,
        ),
    ] = "m"
    file_format: Format = None
    radius: Annotated[float | None, _number("Radius of all spheres if the file has none, in its unit.", AGGREGATE)] = (
        None
    )
    tolerance: Annotated[float, _number("Largest gap that counts as touching, in mean radii.", AGGREGATE)] = (
        CONTACT_TOLERANCE
    )
    overlap_tolerance: Annotated[
        float, _number("Largest overlap that counts as touching, in mean radii.", AGGREGATE)
    ] = CONTACT_TOLERANCE
    contacts: Annotated[
        Path | None,
        valued(
            "<file>",
            "Table with columns i and j, the spheres in contact, counted from 0; by default all that touch.",
            AGGREGATE,
        ),
    ] = None

    @property
    def unit_name(self) -> str:
        """What the unit of length is called in results, which are in metres unless the file has no unit."""
        return "" if self.unit == DIMENSIONLESS else "m"

    def read(self) -> Aggregate:
        """The aggregate."""
        return io.read(
            self.file,
            _length_unit(self.unit),
            format=self.file_format,
            radius=self.radius,
            tolerance=self.tolerance,
            overlap_tolerance=self.overlap_tolerance,
            contacts=self.contacts,
        )


def _length_unit(text: str) -> str | float:
    """The unit of length as `read` takes it: a name or a number."""
    try:
        return float(text)
    except ValueError:
        return text


@dataclass(frozen=True)
class FlowChoice:
    """A flow by name and rate, or by its gradient."""

    flow: Annotated[str, _choice("--flow", names.FLOWS, "Kind of flow: {}.", FLOW)] = "shear"
    rate: Annotated[float | None, _number("Shear or extension rate, 1/s; by default 1.", FLOW)] = None
    gradient: Annotated[
        str | None,
        valued(
            "<9 numbers>",
            "Any velocity gradient instead: nine numbers in 1/s, row by row, in quotation marks.",
            FLOW,
        ),
    ] = None

    @property
    def name(self) -> str:
        """What the flow is called in results."""
        return "gradient" if self.gradient else self.flow

    @property
    def has_rate(self) -> bool:
        """Whether the rate is given, and not only the kind of flow."""
        return self.rate is not None or self.gradient is not None

    def made(self) -> LinearFlow:
        """The flow."""
        if self.gradient is None:
            names.one_of("flow", names.FLOWS, self.flow)
            return names.FLOWS[self.flow](1.0 if self.rate is None else self.rate)
        words = self.gradient.replace(",", " ").split()
        try:
            numbers = np.array([float(word) for word in words])
        except ValueError:
            raise ValueError(
                f"gradient: expected nine numbers, got {self.gradient!r}; write them in quotation marks, row by row"
            ) from None
        if numbers.size != 9:
            raise ValueError(
                f"gradient: expected nine numbers, got {numbers.size}; write them in quotation marks, row by row"
            )
        return LinearFlow(numbers.reshape(3, 3))


@dataclass(frozen=True)
class ModelChoice:
    """A hydrodynamic model by name, with its order."""

    model: Annotated[str, _choice("--model", names.MODELS, "Hydrodynamic model: {}.", LIQUID)] = "stokesian"
    order: Annotated[
        str,
        typer.Option(
            metavar="<integer>", help="Multipole order (2 is force-torque-stresslet), or auto.", rich_help_panel=LIQUID
        ),
    ] = "2"
    accuracy: Annotated[float, _number("With --order auto: largest error of the loads, as a share.", LIQUID)] = 0.02

    def made(self) -> HydrodynamicModel:
        """The model."""
        order: int | Literal["auto"] = "auto"
        if self.order != "auto":
            try:
                order = int(self.order)
            except ValueError:
                raise ValueError(f"order: expected an integer of at least 1, or auto, got {self.order!r}") from None
        return names.hydrodynamic_model(self.model, order, self.accuracy)


@dataclass(frozen=True)
class ContactChoice:
    """A material and a contact law by name, with the numbers that are given instead of theirs."""

    material: Annotated[
        str,
        _choice(
            "--material",
            MATERIALS,
            "{} (adhesion known to a factor of a few), or any other name with its three properties.",
            BONDS,
        ),
    ] = "polystyrene"
    youngs_modulus: Annotated[float | None, _number("In Pa, instead of the material's.", BONDS)] = None
    poisson_ratio: Annotated[float | None, _number("Instead of the material's.", BONDS)] = None
    work_of_adhesion: Annotated[float | None, _number("In J/m², instead of the material's.", BONDS)] = None
    law: Annotated[str, _choice("--law", names.LAWS, "Contact law: {}.", BONDS)] = "jkr"
    pull_off: Annotated[float | None, _number("Pull-off force of every contact in N, instead of the law's.", BONDS)] = (
        None
    )
    stiffness: Annotated[
        tuple[float, float, float, float] | None,
        typer.Option(
            metavar="<4 numbers>",
            parser=number,
            help="Explicit normal and tangential (N/m), bending and twisting (N m/rad) stiffness, separated by spaces; "
            "needs --pull-off.",
            rich_help_panel=BONDS,
            show_default=False,
        ),
    ] = None

    def made(self) -> ContactLaw:
        """The law."""
        return names.contact_law(**vars(self))

    def told(self, bonds: Bonds, contacts: int) -> dict[str, Any]:
        """What a summary says of the contacts, in SI units; law and material are none where stiffness is given."""
        pull_off = bonds.strength(contacts)[:, 0]
        known = None if self.stiffness else MATERIALS.get(self.material)
        given = {name: getattr(self, name) for name in PROPERTIES}
        return {
            "law": None if self.stiffness else self.law,
            "material": None if self.stiffness else self.material,
            **{
                key: getattr(known, name, None) if given[name] is None else given[name]
                for name, key in PROPERTIES.items()
            },
            "pull_off_N": [float(pull_off.min()), float(pull_off.max())],
            "pull_off_given": self.pull_off is not None,
            "stiffness": self.stiffness,
            "friction": None,
            "rolling_distance_m": None,
        }


@dataclass(frozen=True)
class LimitedContactChoice(ContactChoice):
    """The same with limits to other loads than tension."""

    friction: Annotated[float | None, _number("Coefficient of friction: limits shear and twisting too.", BONDS)] = None
    rolling_distance: Annotated[
        float | None, _number("Distance in m by which a contact rolls before it yields: limits bending too.", BONDS)
    ] = None

    def told(self, bonds: Bonds, contacts: int) -> dict[str, Any]:
        """See `ContactChoice.told`."""
        limits = {"friction": self.friction, "rolling_distance_m": self.rolling_distance}
        return super().told(bonds, contacts) | limits


@dataclass(frozen=True)
class BreakupChoice:
    """How an aggregate meets the flow, and when its contacts fail."""

    criterion: Annotated[str, _choice("--criterion", names.CRITERIA, "When a contact fails: {}.", BREAKUP)] = (
        "every-limit"
    )
    rule: Annotated[
        Rule,
        _choice(
            "--rule",
            get_args(Rule),
            "weakest, one contact fails after the other; or overloaded, all at once that are.",
            BREAKUP,
            parser=one_of(get_args(Rule)),
        ),
    ] = "weakest"
    orientation: Annotated[
        Orientation,
        _choice(
            "--orientation",
            get_args(Orientation),
            "given, as in the file; worst, for tension; orbit, the worst along the free rotation; or random.",
            BREAKUP,
            parser=one_of(get_args(Orientation)),
        ),
    ] = "given"
    seed: Annotated[
        int,
        typer.Option(
            metavar="<integer>", parser=whole_number, help="Of --orientation random.", rich_help_panel=BREAKUP
        ),
    ] = 0
    up_to: Annotated[float | None, _number("Rate in 1/s above which the flow is not raised.", BREAKUP)] = None
    with_cascade: Annotated[
        bool,
        _flag("--cascade", "Break the fragments too, at the rate of the flow, until all hold.", BREAKUP),
    ] = False

    @property
    def limit(self) -> float:
        """Rate in 1/s above which the flow is not raised; infinite if there is none."""
        return np.inf if self.up_to is None else _checks.positive("up_to", self.up_to)

    def told(self) -> dict[str, Any]:
        """What a summary says of what was asked for, beside what the breakup tells itself."""
        return {"seed": self.seed if self.orientation == "random" else None, "up_to_per_s": self.up_to}

    def failure_criterion(self, contacts: LimitedContactChoice) -> Criterion:
        """The criterion, if the contacts have a limit for it."""
        criterion = names.failure_criterion(self.criterion, contacts.friction)
        names.refuse_unbreakable(self.criterion, contacts.material, contacts.made())
        return criterion


IDLE: tuple[tuple[str, Callable[[Mapping[str, Any]], bool], str], ...] = (
    ("flow rate", lambda given: given["gradient"] is not None, "with --gradient"),
    ("tolerance", lambda given: given["contacts"] is not None, "with --contacts"),
    (
        "material law youngs_modulus poisson_ratio work_of_adhesion",
        lambda given: given["stiffness"] is not None,
        "with --stiffness",
    ),
    ("order accuracy", lambda given: not _has_order(given["model"]), "with this --model"),
    ("accuracy", lambda given: given["order"] != "auto", "without --order auto"),
    ("seed", lambda given: given["orientation"] != "random", "without --orientation random"),
    ("animation overwrite", lambda given: given["output"] is None, "without --output"),
)
"""Options that have no effect, by the values of all, and beside which other."""


def refuse_idle(context: typer.Context) -> None:
    """Refuse an option that has no effect beside the others of a command.

    Raises
    ------
    ValueError
        With the option, and why it has none.
    """
    for idle, have_no_effect, why in IDLE:
        given = [name for name in idle.split() if _is_given(context, name)]
        if given and have_no_effect(context.params):
            raise ValueError(f"{given[0]}: has no effect {why}; {_remedy(why)}")


def _remedy(why: str) -> str:
    if why.startswith("without "):
        return f"leave it out, or add {why.removeprefix('without ')}"
    return "leave one of them out"


def _is_given(context: typer.Context, name: str) -> bool:
    source = context.get_parameter_source(name) if name in context.params else None
    return source is not None and source.name == "COMMANDLINE"


def _has_order(model: str) -> bool:
    return model not in names.MODELS or "order" in signature(names.MODELS[model]).parameters


def refuse_mixed_units(source: AggregateFile, viscosity: float, contacts: ContactChoice) -> None:
    """Refuse lengths without a unit beside a liquid and contacts in SI units.

    Raises
    ------
    ValueError
        With what is to be given.
    """
    if source.unit == DIMENSIONLESS and (viscosity != DIMENSIONLESS_VISCOSITY or contacts.pull_off is None):
        raise ValueError(
            "--unit dimensionless: Pa s and N do not go with lengths that have no unit; add --viscosity 1 and "
            "--pull-off, and --stiffness for contacts that close loops, or give the unit of the file"
        )
