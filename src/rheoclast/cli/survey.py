"""The command that runs a campaign."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np
import typer
from rich.markup import escape
from rich.table import Table

from rheoclast.cli.console import INTERRUPTED, messages, progress_bar, screen

if TYPE_CHECKING:
    from rheoclast.populations.campaign import Survey

QUANTILES = (0.05, 0.5, 0.95)
MOST_REASONS = 5


def survey_command(
    file: Annotated[Path, typer.Argument(help="Campaign, in TOML.", show_default=False)],
    output: Annotated[
        Path | None,
        typer.Option(help="Folder for the results; by default named after the campaign.", show_default=False),
    ] = None,
    workers: Annotated[
        int | None, typer.Option(help="Processes on this machine; by default one per core.", show_default=False)
    ] = None,
    scheduler: Annotated[
        str | None,
        typer.Option(
            help="Address of a scheduler of dask.distributed: work on its cluster instead.", show_default=False
        ),
    ] = None,
    retry: Annotated[bool, typer.Option("--retry", help="Do again what failed.")] = False,
) -> None:
    """Break many aggregates: families, sizes, seeds, orientations and materials, as a campaign file asks for them.

    Stopped at any moment, it goes on where it was when the same command is given again.

    [bold]Example:[/bold] rheoclast survey campaign.toml --output results
    """
    try:
        from rheoclast.populations.campaign import read_campaign, survey
    except ModuleNotFoundError as error:
        raise ImportError(f"survey needs the package {error.name}: pip install 'rheoclast[survey]'") from None
    campaign = read_campaign(file)
    folder = file.with_suffix("") if output is None else output
    finished = [0, 0]
    try:
        with progress_bar() as bar:

            def progress(done: int, number: int) -> None:
                finished[:] = done, number
                bar(f"{done} of {number} aggregates", done / number)

            results = survey(campaign, folder, workers=workers, scheduler=scheduler, retry=retry, progress=progress)
    except KeyboardInterrupt:
        kept = f"{finished[0]} of {finished[1]} aggregates are finished and kept in {folder}"
        messages.print(f"interrupted; {kept}; to go on, give the same command again", soft_wrap=True, markup=False)
        raise SystemExit(INTERRUPTED) from None
    _show(results)


def _show(results: Survey) -> None:
    """Print counts, failures, rates, and where the files are."""
    aggregates = results.table("aggregates", ["task", "material", "failure"])
    events = results.table("events", ["family", "initiation_rate_per_s"])
    reasons = Counter(aggregates["failure"].drop_null().to_pylist())
    materials = len(aggregates["material"].unique())
    screen.print(
        f"{len(aggregates['task'].unique())} aggregates, {materials} material{'s' * (materials > 1)}, "
        f"{events.num_rows} events"
    )
    if reasons:
        screen.print(f"[red]failed: {reasons.total()}[/red] (column failure of {escape(results.aggregates.name)})")
        for reason, number in reasons.most_common(MOST_REASONS):
            screen.print(f"  {number} × {reason}", markup=False)
    if events.num_rows:
        families = np.array(events["family"].to_pylist())
        screen.print(_rates(families, events["initiation_rate_per_s"].to_numpy()))
    screen.print(f"written to {results.events} and {results.aggregates}", soft_wrap=True, markup=False)


def _rates(families: np.ndarray, rates: np.ndarray) -> Table:
    table = Table(title="initiation rate, 1/s: quantiles", title_justify="left")
    table.add_column("family", no_wrap=True)
    for heading in ("events", *(f"{quantile:.0%}" for quantile in QUANTILES)):
        table.add_column(heading, justify="right", no_wrap=True)
    for family in dict.fromkeys(families.tolist()):
        own = rates[families == family]
        values = np.quantile(own, QUANTILES, method="inverted_cdf")  # by which infinite rates are no obstacle
        table.add_row(family, str(len(own)), *(f"{value:.3g}" for value in values))
    return table
