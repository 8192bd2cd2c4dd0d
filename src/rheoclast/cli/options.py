"""The options that commands share, and the values made from them."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from rheoclast.flows import LinearFlow
from rheoclast.hydrodynamics.exposed_area import ExposedArea
from rheoclast.hydrodynamics.free_draining import FreeDraining
from rheoclast.hydrodynamics.model import HydrodynamicModel
from rheoclast.hydrodynamics.stokesian_dynamics import StokesianDynamics
from rheoclast.mechanics.criteria.criterion import Criterion
from rheoclast.mechanics.laws.jkr import JKR
from rheoclast.mechanics.laws.law import ContactLaw
from rheoclast.mechanics.laws.measured_pull_off import MeasuredPullOff
from rheoclast.mechanics.laws.uniform import Uniform
from rheoclast.mechanics.material import MATERIALS, Material
from rheoclast.names import CRITERIA, FLOWS


class Flow(StrEnum):
    """Flows by name."""

    shear = "shear"
    uniaxial = "uniaxial"
    biaxial = "biaxial"
    planar = "planar"


class Model(StrEnum):
    """Hydrodynamic models by name."""

    stokesian = "stokesian"
    free_draining = "free-draining"
    exposed_area = "exposed-area"


class CriterionChoice(StrEnum):
    """Criteria by name."""

    every_limit = "every-limit"
    tension = "tension"
    sliding = "sliding"
    rolling = "rolling"
    twisting = "twisting"
    combined = "combined"


class RuleChoice(StrEnum):
    """Rules of failure."""

    weakest = "weakest"
    overloaded = "overloaded"


class OrientationChoice(StrEnum):
    """How an aggregate meets the flow."""

    given = "given"
    worst = "worst"
    orbit = "orbit"
    random = "random"


AGGREGATE, FLOW, LIQUID, BONDS, OUTPUT = "Aggregate", "Flow", "Liquid and model", "Contacts", "Output"
BREAKUP = "Breakup"

File = Annotated[
    Path, typer.Argument(help="Spheres: text (x y z r), CSV, XYZ, LAMMPS dump or data.", show_default=False)
]
Unit = Annotated[
    str,
    typer.Option(help="Unit of length in the file: m, mm, um, nm, or a number in metres.", rich_help_panel=AGGREGATE),
]
Format = Annotated[
    str | None,
    typer.Option(
        "--format",
        help="text, csv, xyz, lammps-dump or lammps-data; by default from the file.",
        rich_help_panel=AGGREGATE,
    ),
]
Radius = Annotated[
    float | None,
    typer.Option(help="Radius of all spheres if the file has none, in its unit.", rich_help_panel=AGGREGATE),
]
Tolerance = Annotated[
    float, typer.Option(help="Largest gap that counts as touching, in mean radii.", rich_help_panel=AGGREGATE)
]
OverlapTolerance = Annotated[
    float, typer.Option(help="Largest overlap that counts as touching, in mean radii.", rich_help_panel=AGGREGATE)
]
Contacts = Annotated[
    Path | None,
    typer.Option(
        help="Table with columns i and j, the spheres in contact; by default all that touch.",
        rich_help_panel=AGGREGATE,
        show_default=False,
    ),
]
FlowName = Annotated[Flow, typer.Option("--flow", help="Kind of flow.", rich_help_panel=FLOW)]
Rate = Annotated[
    float | None,
    typer.Option(help="Shear or extension rate, 1/s; by default 1.", rich_help_panel=FLOW, show_default=False),
]
Gradient = Annotated[
    str | None,
    typer.Option(
        help="Any velocity gradient instead: nine numbers in 1/s, row by row.", rich_help_panel=FLOW, show_default=False
    ),
]
Viscosity = Annotated[float, typer.Option(help="Viscosity of the liquid, Pa s.", rich_help_panel=LIQUID)]
ModelName = Annotated[Model, typer.Option("--model", help="Hydrodynamic model.", rich_help_panel=LIQUID)]
Order = Annotated[
    str, typer.Option(help="Multipole order (2 is force-torque-stresslet), or auto.", rich_help_panel=LIQUID)
]
Accuracy = Annotated[
    float, typer.Option(help="With --order auto: largest error of the loads, as a share.", rich_help_panel=LIQUID)
]
MaterialName = Annotated[
    str, typer.Option("--material", help=f"One of: {', '.join(MATERIALS)}.", rich_help_panel=BONDS)
]
YoungsModulus = Annotated[float | None, typer.Option(help="In Pa, instead of the material's.", rich_help_panel=BONDS)]
PoissonRatio = Annotated[float | None, typer.Option(help="Instead of the material's.", rich_help_panel=BONDS)]
WorkOfAdhesion = Annotated[
    float | None, typer.Option(help="In J/m², instead of the material's.", rich_help_panel=BONDS)
]
PullOff = Annotated[
    float | None, typer.Option(help="Pull-off force of every contact in N, instead of JKR's.", rich_help_panel=BONDS)
]
Stiffness = Annotated[
    tuple[float, float, float, float] | None,
    typer.Option(
        help="Explicit normal and tangential (N/m), bending and twisting (N m/rad) stiffness; needs --pull-off.",
        rich_help_panel=BONDS,
        show_default=False,
    ),
]
Friction = Annotated[
    float | None,
    typer.Option(help="Coefficient of friction: limits shear and twisting too.", rich_help_panel=BONDS),
]
RollingDistance = Annotated[
    float | None,
    typer.Option(
        help="Distance in m by which a contact rolls before it yields: limits bending too.", rich_help_panel=BONDS
    ),
]
CriterionName = Annotated[
    CriterionChoice, typer.Option("--criterion", help="When a contact fails.", rich_help_panel=BREAKUP)
]
RuleName = Annotated[
    RuleChoice,
    typer.Option("--rule", help="The weakest contact fails first, or all overloaded at once.", rich_help_panel=BREAKUP),
]
OrientationName = Annotated[
    OrientationChoice,
    typer.Option(
        "--orientation",
        help="As in the file, the worst for tension, the worst along the free rotation, or a random one.",
        rich_help_panel=BREAKUP,
    ),
]
Seed = Annotated[int, typer.Option(help="Of random orientations.", rich_help_panel=BREAKUP)]
UpTo = Annotated[
    float | None,
    typer.Option(help="Rate in 1/s above which the flow is not raised.", rich_help_panel=BREAKUP, show_default=False),
]
WithCascade = Annotated[
    bool,
    typer.Option(
        "--cascade", help="Break the fragments too, at the rate of the flow, until all hold.", rich_help_panel=BREAKUP
    ),
]
Animation = Annotated[bool, typer.Option("--animation", help="Write crack.gif too.", rich_help_panel=OUTPUT)]
Output = Annotated[
    Path | None,
    typer.Option(help="Folder for tables, geometry, pictures and summary.", rich_help_panel=OUTPUT, show_default=False),
]
Overwrite = Annotated[bool, typer.Option("--overwrite", help="Replace files that exist.", rich_help_panel=OUTPUT)]
Json = Annotated[
    bool, typer.Option("--json", help="Print the summary as JSON and nothing else.", rich_help_panel=OUTPUT)
]
Dimensionless = Annotated[
    bool,
    typer.Option(
        "--dimensionless",
        help="Results in units of mean radius a, viscosity μ and rate G: forces in μGa², moments in μGa³.",
        rich_help_panel=OUTPUT,
    ),
]


def length_unit(text: str) -> str | float:
    """The unit of length as `read` takes it: a name or a number."""
    try:
        return float(text)
    except ValueError:
        return text


def chosen_flow(name: Flow, rate: float | None, gradient: str | None) -> LinearFlow:
    """The flow by name and rate, or by its gradient."""
    if gradient is None:
        return FLOWS[name](1.0 if rate is None else rate)
    if rate is not None:
        raise ValueError("--rate: a flow given by its --gradient has no rate of its own; leave one of them out")
    words = gradient.replace(",", " ").split()
    try:
        numbers = np.array([float(word) for word in words])
    except ValueError:
        raise ValueError(f"--gradient: expected nine numbers, got {gradient!r}") from None
    if numbers.size != 9:
        raise ValueError(f"--gradient: expected nine numbers, got {numbers.size}")
    return LinearFlow(numbers.reshape(3, 3))


def chosen_model(name: Model, order: str, accuracy: float) -> HydrodynamicModel:
    """The hydrodynamic model by name, with its order."""
    if name is Model.free_draining:
        return FreeDraining()
    if name is Model.exposed_area:
        return ExposedArea()
    if order == "auto":
        return StokesianDynamics("auto", accuracy)
    try:
        return StokesianDynamics(int(order))
    except ValueError:
        raise ValueError(f"--order: expected an integer of at least 1, or auto, got {order!r}") from None


def chosen_material(
    name: str, youngs_modulus: float | None, poisson_ratio: float | None, work_of_adhesion: float | None
) -> Material:
    """A material by name, with the properties that are given instead of its own."""
    if name not in MATERIALS:
        raise ValueError(
            f"--material: expected one of {', '.join(MATERIALS)}, got {name!r}; for another material add "
            "--youngs-modulus, --poisson-ratio and --work-of-adhesion to one of these"
        )
    known = MATERIALS[name]
    return Material(
        known.youngs_modulus if youngs_modulus is None else youngs_modulus,
        known.poisson_ratio if poisson_ratio is None else poisson_ratio,
        known.work_of_adhesion if work_of_adhesion is None else work_of_adhesion,
    )


def chosen_law(
    material: Material,
    pull_off: float | None,
    stiffness: tuple[float, float, float, float] | None,
    friction: float | None = None,
    rolling_distance: float | None = None,
) -> ContactLaw:
    """JKR contacts of the material, or a measured pull-off force with JKR or explicit stiffness."""
    if stiffness is not None:
        if pull_off is None:
            raise ValueError("--stiffness: explicit stiffness needs the strength too; add --pull-off")
        if friction is not None or rolling_distance is not None:
            raise ValueError("--friction, --rolling-distance: explicit stiffness has no law for them; leave one out")
        return Uniform(*stiffness, tensile_strength=pull_off)
    law = JKR(material, friction, rolling_distance)
    return law if pull_off is None else MeasuredPullOff(pull_off, law)


def chosen_criterion(name: CriterionChoice, friction: float | None, rolling_distance: float | None) -> Criterion:
    """The criterion by name, if the contacts are given the limits that it needs."""
    if name in (CriterionChoice.sliding, CriterionChoice.twisting) and friction is None:
        raise ValueError(f"--criterion {name}: contacts need a limit; give --friction")
    if name is CriterionChoice.rolling and rolling_distance is None:
        raise ValueError(f"--criterion {name}: contacts need a limit; give --rolling-distance")
    return CRITERIA[name](friction or 0.0)
