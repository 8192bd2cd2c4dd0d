"""The command line: `rheoclast stress`, `info` and `demo`."""

from rheoclast.cli.commands import main

__all__ = ["main"]
