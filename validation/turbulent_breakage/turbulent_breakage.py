"""Breakage of doublets and trees in turbulence: rates, the length that scales them, fragments, and a kernel.

python validation/turbulent_breakage/turbulent_breakage.py

Runs what `records.py` has not run yet, eight minutes on one core in all, and writes rates.csv, fits.csv, lengths.csv,
fragments.csv, kernel.csv and the figures beside this file.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from ensembles import ensembles
from figures import draw_fragments, draw_lengths, draw_rates
from findings import Row, fit_rows, fragment_rows, kernel, length_rows, rate_rows
from records import run_all

import rheoclast as rc

HERE = Path(__file__).parent


def write(name: str, rows: Sequence[Row]) -> None:
    """A table beside this file, to six digits."""
    columns = {key: np.array([row[key] for row in rows]) for key in rows[0]}
    rounded = {
        key: np.array([float(f"{each:.6g}") for each in column]) if column.dtype.kind == "f" else column
        for key, column in columns.items()
    }
    rc.write_table(HERE / f"{name}.csv", rounded, overwrite=True)


def main() -> None:
    """Run what is missing, then tables and figures."""
    found = ensembles(run_all())
    write("rates", [row for each in found for row in rate_rows(each)])
    write("fits", [row for each in found for row in fit_rows(each)])
    write("lengths", length_rows(found))
    write("fragments", fragment_rows(found))
    rc.write_kernel(HERE / "kernel.csv", kernel(found), overwrite=True)
    for name, draw in {"rates": draw_rates, "lengths": draw_lengths, "fragments": draw_fragments}.items():
        draw(found).savefig(HERE / f"{name}.png", dpi=115)


if __name__ == "__main__":
    main()
