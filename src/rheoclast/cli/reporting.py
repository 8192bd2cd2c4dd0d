"""The command that makes a page of results."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from rheoclast.cli import options
from rheoclast.cli.console import screen


def report_command(
    result: Annotated[
        Path, typer.Argument(help="Folder that stress, break or survey wrote with --output.", show_default=False)
    ],
    output: Annotated[
        Path | None,
        options.valued("<file>", "The page; by default report.html in the folder.", options.OUTPUT),
    ] = None,
    overwrite: options.Overwrite = False,
) -> None:
    """One page on the results of stress or break, with the aggregate in 3-D, or on a campaign of survey, done or not.

    It is a single file that needs no network and opens in any browser: key figures, charts, and tables that sort.

    [bold]Example:[/bold] rheoclast report results
    """
    from rheoclast.report import write_report

    path = result / "report.html" if output is None else output
    write_report(result, path, overwrite=overwrite)
    screen.print(
        f"written to {path} ({path.stat().st_size / 1e6:.1f} MB); open it in a browser", soft_wrap=True, markup=False
    )
