"""How long computations tell how far they are."""

from __future__ import annotations

from collections.abc import Callable

Progress = Callable[[str, float], None]
"""Called as progress(step, fraction) with the name of the step and the fraction of it that is done, from 0 to 1."""
