"""The command that runs a campaign."""

from __future__ import annotations

import json
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer
from rich.markup import escape
from rich.table import Table

from rheoclast.cli.console import INTERRUPTED, messages, progress_bar, screen
from rheoclast.cli.options import FLAG, valued
from rheoclast.cli.options import folder as folder_named
from rheoclast.cli.speech import whole_number
from rheoclast.fits import CONFIDENCE
from rheoclast.populations.breakage_rate import poisson_rate

if TYPE_CHECKING:
    import pyarrow as pa

    from rheoclast._checks import FloatArray
    from rheoclast.campaigns import Survey

QUANTILES = (0.05, 0.5, 0.95)
MOST_REASONS = 5
IN_FLOWS = ["family", "material", "flow"]
INITIATION_RATE = "initiation_rate_per_s"
IN_HISTORIES = ["family", "material"]
DISSIPATION = "dissipation_m2_per_s3"
PASSAGE = ["time_s", "failed", "overloaded"]
COLUMNS = {"history": [*IN_HISTORIES, "parameters", DISSIPATION, *PASSAGE]}
OTHER_COLUMNS = [*IN_FLOWS, "parameters", INITIATION_RATE]


Output = Annotated[
    Path | None,
    valued("<folder>", "Folder for the results; by default named after the campaign.", parser=folder_named),
]
Workers = Annotated[
    int | None,
    valued("<integer>", "Processes on this machine; by default one per core.", parser=whole_number),
]
Scheduler = Annotated[
    str | None,
    valued("<address>", "Address of a scheduler of dask.distributed: work on its cluster instead."),
]


def survey_command(
    file: Annotated[Path, typer.Argument(help="Campaign, in TOML.", show_default=False)],
    output: Output = None,
    workers: Workers = None,
    scheduler: Scheduler = None,
    retry: Annotated[bool, typer.Option("--retry", metavar=FLAG, help="Do again what failed.")] = False,
) -> None:
    """Break many aggregates: families, sizes, seeds and materials, in flows or turbulence, as a campaign file asks.

    Stopped at any moment, it goes on where it was when the same command is given again.

    [bold]Example:[/bold] rheoclast survey campaign.toml --output results
    """
    try:
        from rheoclast.campaigns import read_campaign, survey
    except ModuleNotFoundError as error:
        raise ImportError(f"survey needs the package {error.name}: pip install 'rheoclast[survey]'") from None
    campaign = read_campaign(file)
    folder = file.with_suffix("") if output is None else output
    with _counted(folder) as progress, _reached(scheduler):
        results = survey(campaign, folder, workers=workers, scheduler=scheduler, retry=retry, progress=progress)
    _show(results, campaign.event)


@contextmanager
def _counted(folder: Path) -> Iterator[Callable[[int, int], None]]:
    """A function progress(done, all) that draws a bar; where the work is interrupted, it is told how much is kept."""
    finished = [0, 0]
    try:
        with progress_bar() as bar:

            def progress(done: int, number: int) -> None:
                finished[:] = done, number
                bar(f"{done} of {number} aggregates", done / number)

            yield progress
    except KeyboardInterrupt:
        kept = f"{finished[0]} of {finished[1]} aggregates are finished and kept in {folder}"
        messages.print(f"interrupted; {kept}; to go on, give the same command again", soft_wrap=True, markup=False)
        raise SystemExit(INTERRUPTED) from None


@contextmanager
def _reached(scheduler: str | None) -> Iterator[None]:
    """Tell what to do about a scheduler that does not answer."""
    try:
        yield
    except OSError as error:
        if scheduler is None or "connect" not in str(error):
            raise
        reason = f"cannot be reached ({error})"
        raise ConnectionError(f"--scheduler {scheduler}: {reason}; start it there, or correct the address") from None


def _show(results: Survey, event: str) -> None:
    """Print counts, failures, rates, and where the files are."""
    aggregates = results.table("aggregates", ["task", "material", "failure"])
    events = results.table("events", COLUMNS.get(event, OTHER_COLUMNS))
    reasons = Counter(aggregates["failure"].drop_null().to_pylist())
    materials = len(aggregates["material"].unique())
    screen.print(
        f"{len(aggregates['task'].unique())} aggregates, {materials} material{'s' * (materials > 1)}, "
        f"{events.num_rows} events"
    )
    if events.num_rows:
        for title, table in _breakage_rates(events) if event == "history" else _initiation_rates(events):
            screen.print(escape(title), soft_wrap=True)
            screen.print(table)
    screen.print(f"written to {results.events} and {results.aggregates}", soft_wrap=True, markup=False)
    if reasons:
        _show_failures(reasons, results.aggregates.name)


def _show_failures(reasons: Counter[str], file: str) -> None:
    """Print how many aggregates came to nothing, and why, where it is not overlooked."""
    screen.print(f"[red]failed: {reasons.total()}[/red] (column failure of {escape(file)})", soft_wrap=True)
    for reason, number in reasons.most_common(MOST_REASONS):
        screen.print(f"  {number} × {reason}", soft_wrap=True, markup=False)


def _initiation_rates(events: pa.Table) -> Iterator[tuple[str, Table]]:
    """Quantiles of the rate of the flow at the first failure, by kind of aggregate, material and flow."""
    kinds = [*IN_FLOWS, "parameters"]
    groups = _grouped(events, kinds, [(INITIATION_RATE, "list")])
    cells = [_quantiles(rates.values.to_numpy()) for rates in groups[f"{INITIATION_RATE}_list"]]
    headings = ("events", *(f"{quantile:.0%}" for quantile in QUANTILES))
    return _tables(groups.select(kinds), IN_FLOWS, "initiation rate, 1/s: quantiles", headings, cells)


def _grouped(events: pa.Table, kinds: list[str], aggregated: list[tuple[str, str]]) -> pa.Table:
    """Aggregates of the rows of each kind, in the order in which the kinds come first."""
    import pyarrow as pa

    numbered = events.append_column("row", pa.array(np.arange(len(events))))
    groups = numbered.group_by(kinds, use_threads=False).aggregate([*aggregated, ("row", "min")])
    return groups.sort_by("row_min")


def _quantiles(rates: FloatArray) -> tuple[str, ...]:
    """Number and quantiles of rates."""
    values = np.quantile(rates, QUANTILES, method="inverted_cdf")  # by which infinite rates are no obstacle
    return str(len(rates)), *(f"{value:.3g}" for value in values)


def _breakage_rates(events: pa.Table) -> Iterator[tuple[str, Table]]:
    """First failures over the time in which they may have happened; those overloaded from the start have none."""
    kinds = [*IN_HISTORIES, "parameters", DISSIPATION]
    groups = _grouped(events, kinds, [(name, "sum") for name in PASSAGE])
    sums = zip(*(groups[name].to_pylist() for name in (DISSIPATION, *(f"{name}_sum" for name in PASSAGE))), strict=True)
    cells = [
        (f"{dissipation:.3g}", str(overloaded), *_breakage_rate(failures - overloaded, time))
        for dissipation, time, failures, overloaded in sums
    ]
    headings = ("m²/s³", "overloaded", "failures", "1/s", f"{CONFIDENCE:.0%} interval")
    return _tables(groups.select(kinds), IN_HISTORIES, "breakage rate by dissipation", headings, cells)


def _tables(
    kinds: pa.Table, titled: Sequence[str], title: str, headings: Sequence[str], cells: Iterable[tuple[str, ...]]
) -> Iterator[tuple[str, Table]]:
    """A title and a table for all that stands in the columns `titled`, with the parameters in which its rows differ."""
    together = defaultdict(list)
    for kind, row in zip(kinds.to_pylist(), cells, strict=True):
        together[tuple(kind[name] for name in titled)].append((json.loads(kind["parameters"]), row))
    for names, own in together.items():
        shown = {name: [_shown(each.get(name)) for each, _ in own] for parameters, _ in own for name in parameters}
        differing = {name: values for name, values in shown.items() if len(set(values)) > 1}
        rows = [(*values, *row) for *values, (_, row) in zip(*differing.values(), own, strict=True)]
        yield f"{', '.join(names)}: {title}", _table((*differing, *headings), rows)


def _shown(value: Any) -> str:
    return f"{value:g}" if isinstance(value, float) else "" if value is None else str(value)


def _breakage_rate(failures: int, time: float) -> tuple[str, str, str]:
    """Failures, rate and interval, the last two empty where there was no time."""
    if not time:
        return str(failures), "", ""
    found = poisson_rate(failures, time)
    lower, upper = found.interval
    return str(failures), f"{found.rate:.3g}", f"{lower:.3g} to {upper:.3g}"


def _table(headings: Iterable[str], rows: Iterable[tuple[str, ...]]) -> Table:
    table = Table()
    for k, heading in enumerate(headings):
        table.add_column(heading, justify="right" if k else "left", no_wrap=True)
    for row in rows:
        table.add_row(*map(escape, row))
    return table
