"""Messages in the words of the command line: options in place of parameters of Python, and what to do.

What the library refuses it refuses in terms of its own functions. The names of the options of a command tell which of
its words are options there; `IN_PYTHON` has the few phrases that say how something is done in Python.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection
from difflib import get_close_matches
from typing import Any

import typer

IN_PYTHON = (
    ("give it when reading (unit='nm'), or set viscosity=1 for dimensionless work", "unit", "add --unit nm"),
    ("give it when reading (unit='nm'), or set viscosity=1 for dimensionless work", "", "lengths are in metres"),
    ("raise the contact tolerance above it", "tolerance", "raise --tolerance above it"),
    ("or allow it to be replaced (overwrite)", "overwrite", "or add --overwrite"),
    ("add one or pass format=", "format", "add one, or --format"),
    ("order='auto': accuracy", "accuracy", "--order auto: --accuracy"),
)
"""Phrases, an option that the command must have, and what is said instead."""

STIFFNESS = re.compile(r"^(normal|tangential|bending|twisting)(?=: )")
WRONG_NAME = re.compile(r"expected one of (?P<choices>[^;]*), got '(?P<name>[^']*)'$")

WRONG_USE = (
    (r"^Invalid value for '?(.+?)'?: (?:Value error, )?", r"\1: "),
    (r"^Missing (?:argument|parameter)[: ]+'?(\w+)'?.*", r"expected <\1>, got nothing"),
    (r"^Missing option '(--[\w-]+).*", r"expected \1 with a value, got nothing"),
    (r"^Argument '(.+?)' takes (\d+) values.*", r"\1: expected \2 values, got fewer"),
    (r"^Option '(.+?)' requires an argument.*", r"\1: expected a value behind it, got nothing"),
    (r"^Option '(.+?)' requires (\d+) arguments.*", r"\1: expected \2 values, not in quotation marks, got fewer"),
    (
        r"^Got unexpected extra argument(?:s|\(s\))? \((.+)\).*",
        r"expected no more, got \1; quote what is one value",
    ),
    (r"^No such (option|command):? '?([^\s']+?)'?\.?(?=\s|$)", r"there is no \1 \2"),
    (r"[\s(]+(?:Possible options:|Did you mean(?: one of:)?) *([^?()]+).*$", r"; did you mean \1?"),
)
"""What the parser of options says, and what is said instead."""


def spoken(message: object, options: Collection[str]) -> str:
    """A message of the library on one line, as a command says it that has options of these names.

    Parameters
    ----------
    message
        An exception, a warning, or their text.
    options
        Names of the options as Python writes them, `pull_off`.
    """
    text = " ".join(_text(message).split())
    for phrase, needed, said in IN_PYTHON:
        if not needed or needed in options:
            text = text.replace(phrase, said)
    if "stiffness" in options:
        text = STIFFNESS.sub(r"--stiffness (\1)", text)
    return with_suggestion(as_options(text, options).replace("pass --", "add --"))


def _text(message: object) -> str:
    """What an exception says; those of the system and of arithmetic say little."""
    if isinstance(message, OSError) and message.filename is not None and message.strerror:
        reason = message.strerror[0].lower() + message.strerror[1:]
        return f"{message.filename}: cannot be read or written ({reason}); check its name and permissions"
    if isinstance(message, ZeroDivisionError | OverflowError):
        return "a result is too large or too small for a number; check rate, viscosity and strength"
    return str(message)


def as_options(message: str, names: Collection[str]) -> str:
    """A message with options in place of parameters: in front, after "add", with an equals sign, and compound words."""
    if not names:
        return message
    any_name = "|".join(sorted(names, key=len, reverse=True))
    compound = "|".join(name for name in names if "_" in name) or "(?!)"
    apart = r"(?<![\w/.-])"  # and no part of a path
    message = re.sub(rf"^(?:{any_name})(?:, (?:{any_name}))*(?=: )", _each_option, message)
    message = re.sub(rf"{apart}({any_name})=(?:'([^']*)'|([\w.+-]*\w))?", _given_option, message)
    return re.sub(rf"(?<=add )({any_name})\b|{apart}({compound})(?![\w/.])", _option, message)


def _option(found: re.Match[str]) -> str:
    return f"--{found[0].replace('_', '-')}"


def _each_option(found: re.Match[str]) -> str:
    return ", ".join(f"--{name.replace('_', '-')}" for name in found[0].split(", "))


def _given_option(found: re.Match[str]) -> str:
    return f"--{found[1].replace('_', '-')} {found[2] or found[3] or ''}".rstrip()


def with_suggestion(message: str) -> str:
    """The message, where it refuses a name, with the choice that is nearest to it."""
    found = WRONG_NAME.search(message)
    nearest = get_close_matches(found["name"].lower(), found["choices"].split(", "), 1) if found else []
    return f"{message}; did you mean {nearest[0]}?" if nearest else message


def of_usage(message: str, command: str) -> str:
    """What the parser of options complains about, and where a command tells how it is used."""
    text = " ".join(message.split())
    for pattern, said in WRONG_USE:
        text = re.sub(pattern, said, text)
    text = re.sub(r"^expected <\w+>", lambda found: found[0].lower(), text)
    refusal, meant, suggestion = with_suggestion(text.rstrip(".")).partition("; did you mean ")
    if not meant:
        return f"{refusal}; see {command} --help"
    return refusal + meant + suggestion.replace("'", "")


def number(given: str | float) -> float:
    """The number that a word of the command line stands for.

    Raises
    ------
    typer.BadParameter
        If it is none.
    """
    return _parsed(float, given, "a number")


def whole_number(given: str | int) -> int:
    """The integer that a word of the command line stands for.

    Raises
    ------
    typer.BadParameter
        If it is none.
    """
    return _parsed(int, given, "an integer")


def one_of(choices: Collection[str]) -> Callable[[str], str]:
    """A function that gives a word back, and raises `typer.BadParameter` if it is none of some names."""

    def name(given: str) -> str:
        if given not in choices:
            raise typer.BadParameter(f"expected one of {', '.join(choices)}, got {given!r:.60}")
        return given

    return name


def _parsed(kind: Callable[[Any], Any], given: Any, expected: str) -> Any:
    try:
        return kind(given)
    except ValueError:
        advice = "; write a point for the decimal comma" if re.fullmatch(r"[-+]?\d+,\d+", given) else ""
        raise typer.BadParameter(f"expected {expected}, got {given!r:.60}{advice}") from None
