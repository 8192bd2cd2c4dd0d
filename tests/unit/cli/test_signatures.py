"""Commands whose options stand in groups."""

from dataclasses import dataclass
from inspect import signature
from typing import Annotated

import typer

from rheoclast.cli.signatures import grouped


@dataclass(frozen=True)
class Size:
    """A group of one argument and one option."""

    count: Annotated[int, typer.Argument()]
    mean_radius: Annotated[float, typer.Option()] = 2.0


@dataclass(frozen=True)
class NamedSize(Size):
    """A group that extends another."""

    name: Annotated[str, typer.Option()] = "ball"


def run(command, arguments):
    app = typer.Typer()
    app.command()(command)
    return app(arguments, standalone_mode=False)


def test_a_group_is_made_of_its_options():
    made = []

    @grouped
    def command(*, size: NamedSize, wanted: Annotated[bool, typer.Option("--wanted")] = False) -> None:
        """Say so."""
        made.append((size, wanted))

    assert list(signature(command).parameters) == ["count", "mean_radius", "name", "wanted"]
    assert command.__doc__ == "Say so."
    run(command, ["3", "--name", "floc"])
    run(command, ["4", "--mean-radius", "0.5", "--wanted"])
    assert made == [(NamedSize(3, 2.0, "floc"), False), (NamedSize(4, 0.5, "ball"), True)]
