"""The commands."""

from __future__ import annotations

import io
import shlex
import sys
from collections.abc import Sequence
from importlib import resources
from pathlib import Path
from typing import Annotated, Any

import typer

import rheoclast
from rheoclast import io as files
from rheoclast.cli import options, results
from rheoclast.cli.analysis import Analysis, analyse
from rheoclast.cli.breaking import break_command
from rheoclast.cli.console import INTERRUPTED, PROGRAM, plain_speech, progress_bar, screen, tell_memory
from rheoclast.cli.generation import generate
from rheoclast.cli.presentation import show_shape, show_stress
from rheoclast.cli.reporting import report_command
from rheoclast.cli.signatures import grouped
from rheoclast.cli.survey import survey_command
from rheoclast.cli.tables import shape_summary, stress_summary
from rheoclast.cli.units import Units
from rheoclast.flows import simple_shear
from rheoclast.hydrodynamics.response import rigid_response
from rheoclast.hydrodynamics.stokesian_dynamics import StokesianDynamics
from rheoclast.report import write_report

app = typer.Typer(
    pretty_exceptions_enable=False,
    rich_markup_mode="rich",
    context_settings={"help_option_names": ["-h", "--help"]},
)


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line on arguments, by default those of the process."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    words = [argument for argument in given if argument != "--debug"]
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")  # screens that lack a character show a question mark
    named, command = _asked(words)
    if named == [PROGRAM, *words] and hasattr(command, "commands"):
        words.append("--help")
    with plain_speech(" ".join(named), _options(command), debug="--debug" in given):
        status = app(words, prog_name=PROGRAM, obj=shlex.join([PROGRAM, *words]), standalone_mode=False)
        if status == INTERRUPTED:  # typer has caught it already
            raise KeyboardInterrupt
        raise SystemExit(status or 0)


def _asked(words: Sequence[str]) -> tuple[list[str], Any]:
    """How the command is called that the first words name, and the command, or group of commands, itself."""
    named, command = [PROGRAM], typer.main.get_command(app)
    for word in words:
        if word not in getattr(command, "commands", ()):
            break
        named.append(word)
        command = command.commands[word]  # type: ignore[attr-defined]
    return named, command


def _options(command: Any) -> tuple[str, ...]:
    """Names of the options of a command, as Python writes them."""
    long = [option for each in command.params for option in each.opts if option.startswith("--")]
    return tuple(option.removeprefix("--").replace("-", "_") for option in long)


def _show_version(wanted: bool) -> None:
    if wanted:
        screen.print(f"rheoclast {rheoclast.__version__}")
        raise typer.Exit


@app.callback()
def rheoclast_command(
    version: Annotated[
        bool,
        typer.Option(
            "--version", metavar=options.FLAG, callback=_show_version, is_eager=True, help="Show the version."
        ),
    ] = False,
    debug: Annotated[
        bool,
        typer.Option("--debug", metavar=options.FLAG, help="Show the traceback of an error; goes anywhere."),
    ] = False,
) -> None:
    """Flow-induced stresses and breakup of rigid colloidal aggregates.

    [bold]Example:[/bold] rheoclast demo
    """


@app.command()
@grouped
def stress(
    *,
    context: typer.Context,
    source: options.AggregateFile,
    flow: options.FlowChoice,
    viscosity: options.Viscosity = 1e-3,
    model: options.ModelChoice,
    contacts: options.ContactChoice,
    output: options.Output = None,
    overwrite: options.Overwrite = False,
    as_json: options.Json = False,
    dimensionless: options.Dimensionless = False,
) -> None:
    """Load on every contact of an aggregate in a flow, and the contact that fails first.

    [bold]Example:[/bold] rheoclast stress floc.dat --unit nm --flow uniaxial --rate 1e5 --output out
    """
    options.refuse_idle(context)
    options.refuse_mixed_units(source, viscosity, contacts)
    undisturbed, law, solved = flow.made(), contacts.made(), model.made()
    if output is not None:
        results.prepare(output, overwrite)
    aggregate = source.read()
    tell_memory(len(aggregate), solved.memory(len(aggregate)))
    with progress_bar() as progress:
        analysis = analyse(aggregate, undisturbed, solved, viscosity, law, progress)
    units = Units.dimensionless(analysis) if dimensionless else Units.of_file(source.unit)
    named = {"command": context.obj, "file": str(source.file)}
    told = {"contact_law": contacts.told(analysis.bonds, len(aggregate.pairs))}
    _report(named, analysis, {**stress_summary(analysis, units, flow.name), **told}, units, output, as_json=as_json)


def _report(
    named: dict[str, Any],
    analysis: Analysis,
    told: dict[str, Any],
    units: Units,
    output: Path | None,
    *,
    as_json: bool = False,
) -> None:
    """Show an analysis, and write it where a folder is given."""
    summary = {"rheoclast": rheoclast.__version__, **named, **told}
    text = results.json_text(summary)
    if output is not None:
        results.write_results(output, analysis, text, units)
    if as_json:
        typer.echo(text)
        return
    show_stress(summary)
    if output is not None:
        screen.print(f"written to {output}: {', '.join(results.FILES)}", soft_wrap=True, markup=False)


@app.command()
@grouped
def info(
    *,
    context: typer.Context,
    source: options.AggregateFile,
    model: options.ModelChoice,
    as_json: options.Json = False,
    dimensionless: options.Dimensionless = False,
) -> None:
    """Size, contacts and structure of an aggregate, its hydrodynamic radius and intrinsic viscosity.

    [bold]Example:[/bold] rheoclast info floc.dat --unit nm
    """
    options.refuse_idle(context)
    solved = model.made()
    aggregate = source.read()
    length, name = (float(aggregate.spheres.radii.mean()), "a") if dimensionless else (1.0, source.unit_name)
    tell_memory(len(aggregate), solved.memory(len(aggregate)))
    with progress_bar() as progress:
        # A response with unit viscosity: neither measure depends on the viscosity.
        response = rigid_response(aggregate.spheres, solved, 1.0, progress)
    summary = {
        **shape_summary(aggregate, length),
        "hydrodynamic_radius": response.hydrodynamic_radius / length,
        "intrinsic_viscosity": response.intrinsic_viscosity,
    }
    if as_json:
        named = {"rheoclast": rheoclast.__version__, "file": str(source.file)}
        typer.echo(results.json_text({**named, **summary, "units": {"length": name}}))
    else:
        show_shape(str(source.file), summary, name)


app.command("break")(break_command)
app.command("survey")(survey_command)
app.command("report")(report_command)
app.add_typer(generate, name="generate")


@app.command()
def demo(
    output: Annotated[
        Path,
        typer.Option(
            metavar="<folder>", parser=options.folder, help="Folder for the results.", rich_help_panel=options.OUTPUT
        ),
    ] = Path("rheoclast-demo"),
    overwrite: options.Overwrite = False,
) -> None:
    """Analyse a small aggregate that comes with the package: 64 spheres of polystyrene, 1 µm across, in sheared water.

    [bold]Example:[/bold] rheoclast demo
    """
    results.prepare(output, overwrite)
    contacts = options.ContactChoice()
    floc = resources.files("rheoclast") / "data" / "demo_floc.dat"
    with resources.as_file(floc) as path, progress_bar() as progress:
        analysis = analyse(
            files.read(path, "nm"),
            simple_shear(1e5),
            StokesianDynamics(order=2),
            1e-3,
            contacts.made(),
            progress,
        )
    told = {"contact_law": contacts.told(analysis.bonds, len(analysis.aggregate.pairs))}
    named = {"command": f"{PROGRAM} demo", "file": "demonstration floc"}
    _report(named, analysis, {**stress_summary(analysis, Units(), "shear"), **told}, Units(), output)
    write_report(output, output / "report.html")
    for line in (
        f"open {output / 'report.html'} in a browser, or look at {output / 'aggregate.png'}; next, your own spheres:",
        "  rheoclast stress FILE --unit nm --flow shear --rate 1e5 --output results",
        "  rheoclast break FILE --unit nm --flow shear --output broken",
    ):
        screen.print(line, soft_wrap=True, markup=False)
