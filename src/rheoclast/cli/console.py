"""How the command line speaks: one line per error or warning, and a progress bar for what takes long."""

from __future__ import annotations

import threading
import warnings
from collections.abc import Callable, Collection, Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager

import typer
from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn, TimeRemainingColumn

from rheoclast.cli.speech import of_usage, spoken

PROGRAM = "rheoclast"
SECONDS_WITHOUT_PROGRESS = 2.0
WORTH_TELLING = 1e9  # bytes
INTERRUPTED = 130  # exit status
COMPILING = ", compiling (only the first time)"

REFUSALS = (ValueError, TypeError, OSError, ArithmeticError, MemoryError, ImportError)
UsageProblem: type[typer.BadParameter] = typer.BadParameter.__mro__[2]  # of all wrong options

screen = Console(highlight=False)
messages = Console(stderr=True, highlight=False)


@contextmanager
def plain_speech(command: str, options: Collection[str], debug: bool) -> Iterator[None]:
    """Turn errors of the input into one line and exit status 1, and warnings into one line each, unless debugging.

    The lines speak of the options of the command, given by their names.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("always", UserWarning)
        if not debug:
            warnings.simplefilter("ignore", RuntimeWarning)  # of NumPy; what overflows is refused
            warnings.showwarning = _told_once(options)
        try:
            yield
        except REFUSALS as error:
            if debug:
                raise
            _tell("[red]error:[/red]", spoken(error, options))
            raise SystemExit(1) from None
        except UsageProblem as problem:
            _tell("[red]error:[/red]", of_usage(problem.format_message(), command))
            raise SystemExit(2) from None
        except (KeyboardInterrupt, typer.Abort):
            messages.print("interrupted; nothing was written", soft_wrap=True)
            raise SystemExit(INTERRUPTED) from None


def _told_once(options: Collection[str]) -> Callable[..., None]:
    """What takes the place of `warnings.showwarning`: each warning on one line, before the results."""
    told = set()

    def show(message: Warning | str, *_: object, **__: object) -> None:
        text = spoken(message, options)
        if text not in told:
            told.add(text)
            _tell("[yellow]warning:[/yellow]", text)

    return show


def _tell(kind: str, text: str) -> None:
    messages.print(f"{kind} {escape(text)}", soft_wrap=True)


def tell_memory(count: int, memory: float) -> None:
    """Say beforehand what memory a large problem needs."""
    if memory > WORTH_TELLING:
        messages.print(f"{count} spheres: up to {memory / 1e9:.2g} GB of memory", soft_wrap=True)


@contextmanager
def progress_bar() -> Iterator[Callable[[str, float], None]]:
    """A function progress(step, fraction) that draws a bar on standard error once two seconds have passed.

    The bar says when time goes into compiling, which it does only the first time.
    """
    bar = Progress(
        SpinnerColumn(),
        TextColumn("{task.description}{task.fields[note]}"),
        BarColumn(),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
        console=messages,
        transient=True,
        disable=not messages.is_terminal,
    )
    task = bar.add_task("solving", total=None, note="")

    def progress(step: str, fraction: float) -> None:
        bar.update(task, description=step, completed=fraction, total=1.0 if fraction > 0 else None)

    def start() -> None:
        bar.start()
        if not bar.disable:
            listening.enter_context(_compilation(lambda note: bar.update(task, note=note)))

    with ExitStack() as listening:
        starting = threading.Timer(SECONDS_WITHOUT_PROGRESS, start)
        starting.start()
        try:
            yield progress
        finally:
            starting.cancel()
            starting.join()
            if bar.live.is_started:
                bar.stop()


def _compilation(tell: Callable[[str], None]) -> AbstractContextManager[None]:
    """Within this context, tell a note while Numba compiles, and an empty one when it is done."""
    from numba.core.event import Event, Listener, install_listener

    class Compilation(Listener):
        depth = 0

        def on_start(self, event: Event) -> None:
            self.depth += 1
            tell(COMPILING)

        def on_end(self, event: Event) -> None:
            self.depth -= 1
            if self.depth <= 0:
                tell("")

    watching: AbstractContextManager[None] = install_listener("numba:compile", Compilation())
    return watching
