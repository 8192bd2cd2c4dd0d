"""Messages of the library in the words of the command line."""

import errno

import pytest
import typer

from rheoclast.cli.speech import as_options, number, of_usage, one_of, spoken, whole_number

OPTIONS = (
    "unit",
    "radius",
    "viscosity",
    "tolerance",
    "order",
    "accuracy",
    "stiffness",
    "pull_off",
    "up_to",
    "overwrite",
)


@pytest.mark.parametrize(
    ("message", "said"),
    [
        ("rate: expected a number", "--rate: expected a number"),
        ("the rate: expected a number", "the rate: expected a number"),
        ("up_to: expected a rate, got a word", "--up-to: expected a rate, got a word"),
        ("rate, up_to: does not take this", "--rate, --up-to: does not take this"),
        ("two parts; raise up_to or the rate", "two parts; raise --up-to or the rate"),
        ("no limit; add rate", "no limit; add --rate"),
        ("pass rate= in 1/s", "pass --rate in 1/s"),
        ("(rate='fast'), or up_to=1e5.", "(--rate fast), or --up-to 1e5."),
        ("/here/up_to/rate=3.dat: no up_to.dat or my_up_to", "/here/up_to/rate=3.dat: no up_to.dat or my_up_to"),
        ("give --up-to", "give --up-to"),
    ],
)
def test_words_that_are_options(message, said):
    assert as_options(message, ("rate", "up_to")) == said


def test_words_of_a_command_without_options():
    assert as_options("rate: add up_to", ()) == "rate: add up_to"


@pytest.mark.parametrize(
    ("message", "said"),
    [
        ("two\n  lines", "two lines"),
        ("is it right? If not, give it when reading (unit='nm'), or set viscosity=1 for dimensionless work",
         "is it right? If not, add --unit nm"),
        ("positions; pass radius= in the file's unit", "positions; add --radius in the file's unit"),
        ("a gap of 0.1; raise the contact tolerance above it", "a gap of 0.1; raise --tolerance above it"),
        ("choose another name, or allow it to be replaced (overwrite)", "choose another name, or add --overwrite"),
        ("order='auto': accuracy 1e-09 is not met", "--order auto: --accuracy 1e-09 is not met"),
        ("twisting: expected a positive number, got 0", "--stiffness (twisting): expected a positive number, got 0"),
        ("stiffness: needs the strength too; add pull_off", "--stiffness: needs the strength too; add --pull-off"),
        ("order: expected one of first, second, got 'Frist'",
         "--order: expected one of first, second, got 'Frist'; did you mean first?"),
        ("order: expected one of first, second, got 'x'", "--order: expected one of first, second, got 'x'"),
    ],
)  # fmt: skip
def test_phrases_of_python(message, said):
    assert spoken(ValueError(message), OPTIONS) == said


def test_a_unit_that_is_no_option():
    text = "right? If not, give it when reading (unit='nm'), or set viscosity=1 for dimensionless work"
    assert spoken(text, ("workers",)) == "right? If not, lengths are in metres"


def test_errors_of_the_system_and_of_arithmetic():
    refused = PermissionError(errno.EACCES, "Permission denied", "results/x")
    said = "results/x: cannot be read or written (permission denied); check its name and permissions"
    assert spoken(refused, OPTIONS) == said
    assert spoken(OSError("the scheduler went away"), OPTIONS) == "the scheduler went away"
    for error in (ZeroDivisionError("float division by zero"), OverflowError("math range error")):
        assert spoken(error, OPTIONS).endswith("check rate, viscosity and strength")


@pytest.mark.parametrize(
    ("message", "said"),
    [
        ("Missing argument 'FILE'.", "expected <file>, got nothing; see rheoclast stress --help"),
        ("Missing option '--bend'.", "expected --bend with a value, got nothing; see rheoclast stress --help"),
        ("Argument 'counts' takes 3 values.", "counts: expected 3 values, got fewer; see rheoclast stress --help"),
        ("Option '--rate' requires an argument.", "--rate: expected a value behind it, got nothing; see rheoclast "
         "stress --help"),
        ("No such option: --rat Did you mean --rate?", "there is no option --rat; did you mean --rate?"),
        ("No such option: --rat (Possible options: --rate, --radius)",
         "there is no option --rat; did you mean --rate, --radius?"),
        ("No such option: --rat (Did you mean one of: --rate, --radius?)",
         "there is no option --rat; did you mean --rate, --radius?"),
        ("No such command 'rong'. Did you mean 'ring'? (Did you mean one of: ring?)",
         "there is no command rong; did you mean ring?"),
        ("No such command 'stres'. Did you mean 'stress'?", "there is no command stres; did you mean stress?"),
        (
            "Got unexpected extra argument (b.dat)",
            "expected no more, got b.dat; quote what is one value; see rheoclast stress --help",
        ),
        (
            "Got unexpected extra argument(s) (1 0)",
            "expected no more, got 1 0; quote what is one value; see rheoclast stress --help",
        ),
        ("Invalid value for '--rate': expected a number, got 'x'",
         "--rate: expected a number, got 'x'; see rheoclast stress --help"),
    ],
)  # fmt: skip
def test_wrong_use(message, said):
    """In the words of the parser that comes with Typer, and of Click before it."""
    assert of_usage(message, "rheoclast stress") == said


def test_values():
    assert (number("1e-3"), number(2.0), whole_number("7"), one_of(("a", "b"))("b")) == (1e-3, 2.0, 7, "b")
    for read, given, message in (
        (number, "1,5", "expected a number, got '1,5'; write a point for the decimal comma"),
        (number, "fast", "expected a number, got 'fast'"),
        (whole_number, "1.5", "expected an integer, got '1.5'"),
        (one_of(("a", "b")), "c", "expected one of a, b, got 'c'"),
    ):
        with pytest.raises(typer.BadParameter) as refusal:
            read(given)
        assert str(refusal.value.message) == message
