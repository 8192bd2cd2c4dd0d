"""Commands whose options stand in groups, and what they say when an option is refused."""

from dataclasses import dataclass
from inspect import signature
from typing import Annotated

import pytest
import typer

from rheoclast.cli.signatures import as_options, grouped


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


def test_an_error_names_the_option_and_keeps_its_class():
    class OddError(ValueError):
        pass

    @grouped
    def command(*, size: Size) -> None:
        raise OddError(f"mean_radius: expected more, got {size.mean_radius:g}")

    with pytest.raises(OddError, match=r"^--mean-radius: expected more, got 2$"):
        run(command, ["3"])


@pytest.mark.parametrize(
    ("message", "spoken"),
    [
        ("rate: expected a number", "--rate: expected a number"),
        ("the rate: expected a number", "the rate: expected a number"),
        ("up_to: expected a rate, got a word", "--up-to: expected a rate, got a word"),
        ("two parts; raise up_to or the rate", "two parts; raise --up-to or the rate"),
        ("no limit; add rate", "no limit; add --rate"),
        ("/here/up_to/file.dat: no up_to.dat or my_up_to", "/here/up_to/file.dat: no up_to.dat or my_up_to"),
        ("give --up-to", "give --up-to"),
    ],
)
def test_words_that_are_options(message, spoken):
    assert as_options(message, ("rate", "up_to")) == spoken


def test_words_where_no_option_is_compound():
    assert as_options("rate: no  words", ("rate",)) == "--rate: no  words"
