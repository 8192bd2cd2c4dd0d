"""The commands."""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from importlib import resources
from pathlib import Path
from typing import Annotated, Any

import typer

import rheoclast
from rheoclast import io
from rheoclast.cli import options, results
from rheoclast.cli.analysis import Analysis, analyse
from rheoclast.cli.console import plain_speech, progress_bar, screen
from rheoclast.cli.presentation import show_shape, show_stress
from rheoclast.cli.tables import shape_summary, stress_summary
from rheoclast.cli.units import Units
from rheoclast.flows import simple_shear
from rheoclast.hydrodynamics.response import rigid_response
from rheoclast.hydrodynamics.stokesian_dynamics import StokesianDynamics
from rheoclast.mechanics.laws.jkr import JKR
from rheoclast.mechanics.material import MATERIALS
from rheoclast.particles.contacts import CONTACT_TOLERANCE

app = typer.Typer(no_args_is_help=True, pretty_exceptions_enable=False, rich_markup_mode="rich")


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line on arguments, by default those of the process."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    with plain_speech(debug="--debug" in given):
        app([argument for argument in given if argument != "--debug"])


def _show_version(wanted: bool) -> None:
    if wanted:
        screen.print(f"rheoclast {rheoclast.__version__}")
        raise typer.Exit


@app.callback()
def rheoclast_command(
    version: Annotated[
        bool, typer.Option("--version", callback=_show_version, is_eager=True, help="Show the version.")
    ] = False,
    debug: Annotated[bool, typer.Option("--debug", help="Show the traceback of an error; goes anywhere.")] = False,
) -> None:
    """Flow-induced stresses and breakup of rigid colloidal aggregates."""


@app.command()
def stress(
    file: options.File,
    unit: options.Unit = "m",
    file_format: options.Format = None,
    radius: options.Radius = None,
    tolerance: options.Tolerance = CONTACT_TOLERANCE,
    overlap_tolerance: options.OverlapTolerance = CONTACT_TOLERANCE,
    flow: options.FlowName = options.Flow.shear,
    rate: options.Rate = 1.0,
    gradient: options.Gradient = None,
    viscosity: options.Viscosity = 1e-3,
    model: options.ModelName = options.Model.stokesian,
    order: options.Order = "2",
    accuracy: options.Accuracy = 0.02,
    material: options.MaterialName = "polystyrene",
    youngs_modulus: options.YoungsModulus = None,
    poisson_ratio: options.PoissonRatio = None,
    work_of_adhesion: options.WorkOfAdhesion = None,
    pull_off: options.PullOff = None,
    stiffness: options.Stiffness = None,
    output: options.Output = None,
    overwrite: options.Overwrite = False,
    as_json: options.Json = False,
    dimensionless: options.Dimensionless = False,
) -> None:
    """Load on every contact of an aggregate in a flow, and the contact that fails first.

    [bold]Example:[/bold] rheoclast stress floc.dat --unit nm --flow uniaxial --rate 1e5 --output out
    """
    if output is not None:
        results.prepare(output, overwrite)
    chosen_flow = options.chosen_flow(flow, rate, gradient)
    law = options.chosen_law(
        options.chosen_material(material, youngs_modulus, poisson_ratio, work_of_adhesion), pull_off, stiffness
    )
    aggregate = io.read(
        file,
        options.length_unit(unit),
        format=file_format,
        radius=radius,
        tolerance=tolerance,
        overlap_tolerance=overlap_tolerance,
    )
    with progress_bar() as progress:
        analysis = analyse(
            aggregate, chosen_flow, options.chosen_model(model, order, accuracy), viscosity, law, progress
        )
    name = "gradient" if gradient else flow.value
    _report(str(file), name, analysis, output, as_json=as_json, dimensionless=dimensionless)


def _report(
    file: str, flow: str, analysis: Analysis, output: Path | None, *, as_json: bool, dimensionless: bool
) -> None:
    """Show an analysis, and write it where a folder is given."""
    units = Units.dimensionless(analysis) if dimensionless else Units()
    summary = {"rheoclast": rheoclast.__version__, "file": file, **stress_summary(analysis, units)}
    summary["flow"]["name"] = flow
    written = results.write_results(output, analysis, summary, units) if output is not None else []
    if as_json:
        _print_json(summary)
        return
    show_stress(file, summary)
    if written:
        screen.print(f"written to {output}: {', '.join(path.name for path in written)}", soft_wrap=True)


def _print_json(summary: dict[str, Any]) -> None:
    typer.echo(json.dumps(summary, indent=2))


@app.command()
def info(
    file: options.File,
    unit: options.Unit = "m",
    file_format: options.Format = None,
    radius: options.Radius = None,
    tolerance: options.Tolerance = CONTACT_TOLERANCE,
    overlap_tolerance: options.OverlapTolerance = CONTACT_TOLERANCE,
    model: options.ModelName = options.Model.stokesian,
    order: options.Order = "2",
    accuracy: options.Accuracy = 0.02,
    as_json: options.Json = False,
    dimensionless: options.Dimensionless = False,
) -> None:
    """Size, contacts and structure of an aggregate, its hydrodynamic radius and intrinsic viscosity.

    [bold]Example:[/bold] rheoclast info floc.dat --unit nm
    """
    aggregate = io.read(
        file,
        options.length_unit(unit),
        format=file_format,
        radius=radius,
        tolerance=tolerance,
        overlap_tolerance=overlap_tolerance,
    )
    length, name = (float(aggregate.spheres.radii.mean()), "a") if dimensionless else (1.0, "m")
    with progress_bar() as progress:
        # A response with unit viscosity: neither measure depends on the viscosity.
        response = rigid_response(aggregate.spheres, options.chosen_model(model, order, accuracy), 1.0, progress)
    summary = {
        **shape_summary(aggregate, length),
        "hydrodynamic_radius": response.hydrodynamic_radius / length,
        "intrinsic_viscosity": response.intrinsic_viscosity,
    }
    if as_json:
        _print_json({"rheoclast": rheoclast.__version__, "file": str(file), **summary, "units": {"length": name}})
    else:
        show_shape(str(file), summary, name)


@app.command()
def demo(
    output: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("rheoclast-demo"),
    overwrite: options.Overwrite = False,
) -> None:
    """Analyse a small aggregate that comes with the package: 64 spheres of polystyrene, 1 µm across, in sheared water.

    [bold]Example:[/bold] rheoclast demo
    """
    results.prepare(output, overwrite)
    floc = resources.files("rheoclast") / "data" / "demo_floc.dat"
    with resources.as_file(floc) as path, progress_bar() as progress:
        analysis = analyse(
            io.read(path, "nm"),
            simple_shear(1e5),
            StokesianDynamics(order=2),
            1e-3,
            JKR(MATERIALS["polystyrene"]),
            progress,
        )
    _report("demonstration floc", "shear", analysis, output, as_json=False, dimensionless=False)
    screen.print(
        f"look at {output / 'aggregate.png'}; next, your own spheres: "
        "rheoclast stress FILE --unit nm --flow shear --rate 1e5 --output results",
        soft_wrap=True,
    )
