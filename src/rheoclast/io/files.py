"""Files on disk: text is loaded whole and remembers its line numbers; output takes its place in one step."""

from __future__ import annotations

import codecs
import math
import os
import re
import secrets
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from rheoclast.errors import FileFormatError

_LINE_END = re.compile(r"\r\n|\r|\n")
_NOT_TEXT = re.compile(r"[\x00-\x08\x0e-\x1f\x7f]")


@dataclass(frozen=True)
class TextFile:
    """A text file in memory. Lines are counted from 1, as editors do."""

    path: Path
    lines: tuple[str, ...]

    def error(self, message: str, line: int | None = None) -> FileFormatError:
        """An exception, to be raised, that names the file and the line."""
        where = f"{self.path}" if line is None else f"{self.path}, line {line}"
        return FileFormatError(f"{where}: {message}")

    def number(self, word: str, line: int) -> float:
        """The finite number that a word of a line stands for."""
        try:
            value = float(word.replace("_", "?"))  # Python takes 1_0 for 10; no other program does
        except ValueError:
            comma = re.fullmatch(r"[-+]?\d+,\d+", word)
            advice = "write decimal points, not commas" if comma else "correct or remove this line"
            raise self.error(f"expected a number, got {word!r:.60}; {advice}", line) from None
        if not math.isfinite(value):
            raise self.error(f"expected a finite number, got {word!r:.60}; correct or remove this line", line)
        return value

    def whole_number(self, word: str, line: int, meaning: str) -> int:
        """The whole number, zero or greater, that a word of a line stands for."""
        if not re.fullmatch(r"\d+", word.strip(), re.ASCII):
            raise self.error(f"expected {meaning} as a whole number, got {word.strip()!r:.60}", line)
        return int(word)


def load(path: str | os.PathLike[str]) -> TextFile:
    """A whole text file, UTF-8 or Latin-1, with any line ends.

    Raises
    ------
    FileNotFoundError
        If there is no such file.
    FileFormatError
        If it is a folder, empty, or not text.
    """
    file = TextFile(Path(path), ())
    if not file.path.exists():
        raise FileNotFoundError(f"{path}: there is no such file; check its name and the current folder, {Path.cwd()}")
    if file.path.is_dir():
        raise file.error("expected a file, got a folder; name a file in it")
    content = file.path.read_bytes()
    if content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        raise file.error("expected text in UTF-8, got UTF-16; save it as UTF-8")
    text = _decoded(content)
    found = _NOT_TEXT.search(text)
    if found:
        raise file.error(
            f"expected a text file, got binary data (character {found[0]!r} at position {found.start()}); "
            "unpack it if it is compressed, or export it as text"
        )
    if not text.strip():
        raise file.error("expected rows of numbers, got an empty file; write it anew")
    lines = _LINE_END.split(text)
    return TextFile(file.path, tuple(lines[:-1] if lines[-1] == "" else lines))


def _decoded(content: bytes) -> str:
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("latin-1")


@contextmanager
def replacing(path: str | os.PathLike[str], overwrite: bool = False) -> Iterator[Path]:
    """Path of a temporary file that becomes `path` when the block ends, and vanishes when the block fails.

    It lies in the same folder and has the same suffix, so that the last step is one rename and a library that goes
    by the suffix writes the right format. It is on the disk before it is renamed: no power cut leaves an empty file.

    Raises
    ------
    FileExistsError
        If `path` exists and may not be overwritten, or is a folder or a device.
    FileNotFoundError
        If its folder does not exist.
    OSError
        If nothing can be written there.
    """
    target = writable(path, overwrite)
    temporary = target.with_name(f".{target.stem}-{secrets.token_hex(4)}{target.suffix}")
    try:
        yield temporary
        with temporary.open("rb+") as finished:
            os.fsync(finished.fileno())
        if target.exists():
            shutil.copymode(target, temporary)
        os.replace(temporary, target)
    except OSError as error:
        if error.filename != str(temporary):
            raise
        raise OSError(f"{path}: cannot be written ({error.strerror}); choose another folder") from None
    finally:
        temporary.unlink(missing_ok=True)


def writable(path: str | os.PathLike[str], overwrite: bool) -> Path:
    """Where `path` leads, links followed, once it is clear that a file may be put there.

    Raises
    ------
    FileExistsError, FileNotFoundError
        As `replacing`.
    """
    target = Path(os.path.realpath(path))
    if not target.parent.is_dir():
        raise FileNotFoundError(f"{path}: the folder {target.parent} does not exist; create it first")
    if target.exists() and not target.is_file():
        raise FileExistsError(f"{path}: expected the name of a file, got a folder or a device; choose another name")
    if target.exists() and not overwrite:
        raise FileExistsError(f"{path} exists already; choose another name, or allow it to be replaced (overwrite)")
    return target
