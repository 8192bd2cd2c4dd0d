"""Hashes and seeds that follow from what something is."""

from __future__ import annotations

from hashlib import sha256
from typing import Any

import msgspec
import numpy as np

DIGITS = 32


def canonical(value: Any) -> bytes:
    """JSON with sorted keys: the same bytes for equal values."""
    return msgspec.json.encode(value, order="deterministic")


def digest(value: Any) -> str:
    """Hash of a value, as hexadecimal digits."""
    return sha256(canonical(value)).hexdigest()[:DIGITS]


def derived_seed(seed: int, *identity: Any) -> int:
    """Seed, below 2⁶³, of what an identity names, independent of that of every other."""
    words = np.frombuffer(sha256(canonical(identity)).digest(), dtype="<u4")
    sequence = np.random.SeedSequence(seed, spawn_key=tuple(words.tolist()))
    return int(sequence.generate_state(1, np.uint64)[0]) >> 1
