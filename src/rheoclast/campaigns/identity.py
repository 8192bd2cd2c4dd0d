"""Hashes and seeds that follow from what something is."""

from __future__ import annotations

from hashlib import sha256
from pathlib import Path
from typing import Any

import msgspec
import numpy as np

DIGITS = 32


def canonical(value: Any) -> bytes:
    """JSON with sorted keys: the same bytes for equal values. A path counts by the name of its file alone."""
    return msgspec.json.encode(value, order="deterministic", enc_hook=_name)


def _name(value: Any) -> str:
    if not isinstance(value, Path):
        raise TypeError(f"value: expected what JSON can hold, or a path, got {type(value).__name__}")
    return value.name


def digest(value: Any) -> str:
    """Hash of a value, as hexadecimal digits."""
    return sha256(canonical(value)).hexdigest()[:DIGITS]


def derived_seed(seed: int, *identity: Any) -> int:
    """Seed, below 2⁶³, of what an identity names, independent of that of every other."""
    words = np.frombuffer(sha256(canonical(identity)).digest(), dtype="<u4")
    sequence = np.random.SeedSequence(seed, spawn_key=tuple(words.tolist()))
    return int(sequence.generate_state(1, np.uint64)[0]) >> 1
