"""The command that breaks an aggregate."""

from __future__ import annotations

from typing import Any

import typer

import rheoclast
from rheoclast.cli import options, results
from rheoclast.cli.breakup import FILES, Setting, breakup_summary, write_breakup
from rheoclast.cli.console import progress_bar, screen, tell_memory
from rheoclast.cli.presentation import show_breakup
from rheoclast.cli.signatures import grouped
from rheoclast.cli.units import Units
from rheoclast.hydrodynamics.response import rigid_response
from rheoclast.progress import Progress


@grouped
def break_command(
    *,
    context: typer.Context,
    source: options.AggregateFile,
    flow: options.FlowChoice,
    viscosity: options.Viscosity = 1e-3,
    model: options.ModelChoice,
    contacts: options.LimitedContactChoice,
    breakup: options.BreakupChoice,
    output: options.Output = None,
    animation: options.Animation = False,
    overwrite: options.Overwrite = False,
    as_json: options.Json = False,
) -> None:
    """Break an aggregate, contact by contact, as the flow is made faster: initiation and breakup rate, fragments.

    [bold]Example:[/bold] rheoclast break floc.dat --unit nm --flow uniaxial --orientation worst --output out
    """
    options.refuse_idle(context)
    options.refuse_mixed_units(source, viscosity, contacts)
    if breakup.with_cascade and not flow.has_rate:
        raise ValueError("--cascade: fragments break at the rate of the flow; add --rate or --gradient")
    limit = breakup.limit
    if output is not None:
        results.prepare(output, overwrite, FILES)
    with progress_bar() as progress:
        setting = _setting(source, flow, viscosity, model, contacts, breakup, progress)
        broken = setting.broken(breakup.seed, limit)
        pieces = setting.cascade(broken.flow, progress) if breakup.with_cascade else None
    units = Units.of_file(source.unit)
    asked = {"command": context.obj, "file": str(source.file), "flow_name": flow.name, **breakup.told()}
    contact_law = contacts.told(setting.bonds, len(setting.aggregate.pairs))
    summary = _summary(asked, breakup_summary(setting, broken, pieces), contact_law, units)
    text = results.json_text(summary)
    if output is not None:
        write_breakup(output, broken, pieces, text, units, animation)
    if as_json:
        typer.echo(text)
        return
    show_breakup(summary, broken.breakup)
    if output is not None:
        screen.print(f"written to {output}: {', '.join(results.written(output, FILES))}", soft_wrap=True, markup=False)


def _summary(asked: dict[str, Any], found: dict[str, Any], contact_law: dict[str, Any], units: Units) -> dict[str, Any]:
    """What was asked for and what came of it, with the version and the names of the units."""
    named = {"rheoclast": rheoclast.__version__, **asked}
    return {**named, **found, "contact_law": contact_law, "units": units.names._asdict()}


def _setting(
    source: options.AggregateFile,
    flow: options.FlowChoice,
    viscosity: float,
    model: options.ModelChoice,
    contacts: options.LimitedContactChoice,
    breakup: options.BreakupChoice,
    progress: Progress,
) -> Setting:
    """What is asked for, the aggregate read and its hydrodynamics solved; what cannot be is refused before that."""
    undisturbed, law, criterion = flow.made(), contacts.made(), breakup.failure_criterion(contacts)
    solved = model.made()
    aggregate = source.read()
    tell_memory(len(aggregate), solved.memory(len(aggregate)))
    response = rigid_response(aggregate.spheres, solved, viscosity, progress)
    bonds = law.bonds(aggregate)
    return Setting(aggregate, response, bonds, undisturbed, breakup.rule, criterion, breakup.orientation)
