"""How many threads the linear algebra of NumPy and SciPy may use."""

from __future__ import annotations

from contextlib import AbstractContextManager, nullcontext
from functools import cache
from typing import Any

from threadpoolctl import ThreadpoolController


def one_blas_thread(when: bool = True) -> AbstractContextManager[Any]:
    """A context with one BLAS thread, if so wished."""
    return _controller().limit(limits=1, user_api="blas") if when else nullcontext()


@cache
def _controller() -> ThreadpoolController:
    """Finding the loaded libraries takes longer than a small solution."""
    import scipy.linalg  # noqa: F401 - its BLAS must have been loaded

    return ThreadpoolController()
