"""Hashes and seeds that follow from what something is."""

from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("msgspec")

from rheoclast.campaigns.identity import DIGITS, canonical, derived_seed, digest

SOMETHING = {"family": "ring", "count": 12, "place": [1.5, None]}


def test_order_of_keys_does_not_matter_but_values_do():
    same = dict(reversed(SOMETHING.items()))
    assert canonical(same) == canonical(SOMETHING) == b'{"count":12,"family":"ring","place":[1.5,null]}'
    assert digest(same) == digest(SOMETHING) != digest({**SOMETHING, "count": 13})
    assert len(digest(SOMETHING)) == DIGITS
    assert int(digest(SOMETHING), 16)


def test_a_path_counts_by_the_name_of_its_file():
    assert canonical({"path": Path("here") / "a.csv"}) == canonical({"path": Path("there") / "a.csv"})
    assert digest(Path("a.csv")) != digest(Path("b.csv"))
    with pytest.raises(TypeError, match="expected what JSON can hold, or a path, got object"):
        canonical(object())


def test_seeds_differ_by_identity_and_by_the_seed_of_all():
    seeds = {derived_seed(seed, name, number) for seed in (0, 1) for name in "ab" for number in range(500)}
    assert len(seeds) == 2000
    assert all(0 <= seed < 2**63 for seed in seeds)
    assert derived_seed(1, "a", 2) == derived_seed(1, "a", 2)


def test_seeds_are_spread_evenly():
    """Every bit is set in half of them, within five standard errors."""
    seeds = np.array([derived_seed(3, number) for number in range(2000)])
    bits = (seeds[:, None] >> np.arange(63)) & 1
    assert np.abs(bits.mean(axis=0) - 0.5).max() < 5 * 0.5 / np.sqrt(2000)
