"""A lock on a folder, which the system takes away when its process ends, however it ends."""

from __future__ import annotations

import errno
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

REFUSED = {errno.EACCES, errno.EAGAIN, errno.EDEADLK}


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Keep other processes from locking a folder too.

    Network file systems without locks are let pass.

    Raises
    ------
    BlockingIOError
        If a process has locked the folder.
    """
    with (folder / ".lock").open("ab") as file:  # closing it unlocks it
        try:
            _lock(file.fileno())
        except OSError as error:
            if error.errno in REFUSED:
                raise BlockingIOError(
                    f"{folder}: another process works in this folder; wait until it ends, or choose another folder"
                ) from None
        yield


if sys.platform == "win32":
    import msvcrt

    def _lock(descriptor: int) -> None:
        msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)

else:
    import fcntl

    def _lock(descriptor: int) -> None:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
