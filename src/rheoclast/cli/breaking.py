"""The command that breaks an aggregate."""

from __future__ import annotations

import numpy as np
import typer

import rheoclast
from rheoclast import _checks
from rheoclast import io as files
from rheoclast.cli import options, results
from rheoclast.cli.breakup import FILES, Setting, breakup_summary, write_breakup
from rheoclast.cli.console import progress_bar, screen, tell_memory
from rheoclast.cli.presentation import show_breakup
from rheoclast.hydrodynamics.response import rigid_response
from rheoclast.particles.contacts import CONTACT_TOLERANCE


def break_command(
    file: options.File,
    unit: options.Unit = "m",
    file_format: options.Format = None,
    radius: options.Radius = None,
    tolerance: options.Tolerance = CONTACT_TOLERANCE,
    overlap_tolerance: options.OverlapTolerance = CONTACT_TOLERANCE,
    contacts: options.Contacts = None,
    flow: options.FlowName = options.Flow.shear,
    rate: options.Rate = None,
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
    friction: options.Friction = None,
    rolling_distance: options.RollingDistance = None,
    criterion: options.CriterionName = options.CriterionChoice.every_limit,
    rule: options.RuleName = options.RuleChoice.weakest,
    orientation: options.OrientationName = options.OrientationChoice.given,
    seed: options.Seed = 0,
    up_to: options.UpTo = None,
    with_cascade: options.WithCascade = False,
    output: options.Output = None,
    animation: options.Animation = False,
    overwrite: options.Overwrite = False,
    as_json: options.Json = False,
) -> None:
    """Break an aggregate, contact by contact, as the flow is made faster: critical rates, failures, fragments.

    [bold]Example:[/bold] rheoclast break floc.dat --unit nm --flow uniaxial --orientation worst --output out
    """
    if output is not None:
        results.prepare(output, overwrite, FILES)
    if animation and output is None:
        raise ValueError("--animation: the film is written to a folder; give --output")
    if with_cascade and (rate is None and gradient is None):
        raise ValueError("--cascade: fragments break at the rate of the flow; give --rate or --gradient")
    law = options.chosen_law(
        options.chosen_material(material, youngs_modulus, poisson_ratio, work_of_adhesion),
        pull_off,
        stiffness,
        friction,
        rolling_distance,
    )
    chosen_flow = options.chosen_flow(flow, rate, gradient)
    chosen_criterion = options.chosen_criterion(criterion, friction, rolling_distance)
    limit = np.inf if up_to is None else _checks.positive("up_to", up_to)
    aggregate = files.read(
        file,
        options.length_unit(unit),
        format=file_format,
        radius=radius,
        tolerance=tolerance,
        overlap_tolerance=overlap_tolerance,
        contacts=contacts,
    )
    chosen_model = options.chosen_model(model, order, accuracy)
    tell_memory(len(aggregate), chosen_model.memory(len(aggregate)))
    with progress_bar() as progress:
        setting = Setting(
            aggregate,
            rigid_response(aggregate.spheres, chosen_model, viscosity, progress),
            law.bonds(aggregate),
            chosen_flow,
            rule.value,
            chosen_criterion,
            orientation.value,
        )
        broken = setting.broken(seed, limit)
        pieces = setting.cascade(broken.flow, progress) if with_cascade else None
    summary = {"rheoclast": rheoclast.__version__, "file": str(file), **breakup_summary(setting, broken, pieces)}
    text = results.json_text(summary)
    if output is not None:
        write_breakup(output, broken, pieces, text, animation)
    if as_json:
        typer.echo(text)
        return
    show_breakup(str(file), summary, broken.breakup)
    if output is not None:
        screen.print(f"written to {output}", soft_wrap=True, markup=False)
