"""The table [histories] of a campaign: fluid paths through turbulence, from a model or from files.

Inertia plays no role for an aggregate, so that one history, in units of the Kolmogorov time, stands for every
dissipation: only how fast it is run through differs.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from hashlib import sha256
from pathlib import Path
from typing import Annotated, Literal

import msgspec
import numpy as np
from msgspec import Meta, Struct

from rheoclast import _checks
from rheoclast.campaigns.choices import COUNTING, refuse_repeated
from rheoclast.flows import TRACE_TOLERANCE
from rheoclast.histories import GradientHistory
from rheoclast.io.histories import read_histories
from rheoclast.names import one_of
from rheoclast.turbulence import TURBULENCE_MODELS, kolmogorov_time

CAMPAIGNS_KEPT = 2


class HistoryFile(Struct, frozen=True, forbid_unknown_fields=True):
    """A file of histories, and how to read it: the arguments of `rheoclast.read_histories`.

    Attributes
    ----------
    path
        Taken from the current folder on, if it is not absolute. Where the file lies is no part of what a campaign asks
        for.
    sha256
        Hash of its contents; by default of those that it has now. They are part of what a campaign asks for.
    """

    path: Path
    time_unit: str | float = "s"
    gradient_unit: str | float = "1/s"
    order: Literal["row", "column"] = "row"
    tolerance: float = TRACE_TOLERANCE
    arrays: tuple[str, str] = ("t", "gradient")
    format: str | None = None
    sha256: str = ""

    def __post_init__(self) -> None:
        msgspec.structs.force_setattr(self, "path", Path(self.path).absolute())
        if not self.sha256:
            msgspec.structs.force_setattr(self, "sha256", self._hash())

    def read(self) -> tuple[GradientHistory, ...]:
        """Its histories.

        Raises
        ------
        ValueError
            If it cannot be read, or has other contents than when it was asked for.
        """
        if self._hash() != self.sha256:
            raise ValueError(f"path: {self.path} has changed since it was asked for; start anew in another folder")
        options = msgspec.structs.asdict(self)
        del options["sha256"]
        return read_histories(options.pop("path"), **options)

    def _hash(self) -> str:
        try:
            return sha256(self.path.read_bytes()).hexdigest()
        except OSError as error:
            raise ValueError(
                f"path: {self.path} cannot be read ({error.strerror}); check its name and folder"
            ) from None


class Histories(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Histories of the velocity gradient along which every aggregate is carried.

    Attributes
    ----------
    model
        Name in `TURBULENCE_MODELS`; every aggregate has histories of its own.
    files
        In place of a model: names of files, or files with how to read them.
    number
        Histories of every aggregate; of those in files, as many are drawn for each. By default all in the files.
    duration
        Of each, in Kolmogorov times, from its start; by default to its end in the file.
    dissipations
        Mean dissipations of energy per mass, m²/s³, for each of which all histories are run through; by default that of
        the files. The Kolmogorov time of files is the inverse root mean square of the magnitude (2 E:E)^½ in all of
        them together.
    density, kinematic_viscosity
        Of the liquid, kg/m³ or m²/s: one of them.
    fragments
        Whether to follow cracks to the fragments, which takes long for aggregates with many loops.
    """

    model: str | None = None
    files: Annotated[tuple[str | HistoryFile, ...], Meta(min_length=1)] | None = None
    number: COUNTING | None = None
    duration: float | None = None
    dissipations: Annotated[tuple[float, ...], Meta(min_length=1)] | None = None
    density: float | None = None
    kinematic_viscosity: float | None = None
    fragments: bool = True

    def __post_init__(self) -> None:
        for first, second in (("model", "files"), ("density", "kinematic_viscosity")):
            if (getattr(self, first) is None) == (getattr(self, second) is None):
                raise ValueError(f"{first}, {second}: expected one of them; give one and leave out the other")
        for name in ("duration", "density", "kinematic_viscosity"):
            if getattr(self, name) is not None:
                _checks.positive(name, getattr(self, name))
        if self.dissipations is not None:
            _checks.positive_array("dissipations", self.dissipations, ("n",))
            refuse_repeated("dissipations", self.dissipations)
        if self.model is None:
            self._take_hashes()
        else:
            self._refuse_incomplete(self.model)

    def refuse_unreadable(self) -> None:
        """Refuse files that cannot be read, or hold less than is asked for.

        Raises
        ------
        ValueError
            With the key.
        """
        if self.model is not None:
            return
        unit, paths = _in_files(self)
        if self.number is not None and self.number > len(paths):
            raise ValueError(f"number: expected at most {len(paths)}, the histories in the files, got {self.number}")
        shortest = min(path.duration for path in paths) / unit
        if self.duration is not None and self.duration > shortest:
            raise ValueError(
                f"duration: expected at most {shortest:.6g} Kolmogorov times, as the shortest history in the files "
                f"has, got {self.duration:g}"
            )

    def kolmogorov_times(self, viscosity: float) -> dict[float, float]:
        """Kolmogorov times in s by dissipation in m²/s³, for a liquid of a viscosity in Pa s."""
        kinematic = self.kinematic_viscosity if self.density is None else viscosity / self.density
        assert kinematic is not None
        if self.dissipations is None:
            unit, _ = _in_files(self)
            return {kinematic / unit**2: unit}
        return {each: kolmogorov_time(each, kinematic) for each in self.dissipations}

    def drawn(self, seed: int) -> Mapping[int, GradientHistory]:
        """The histories of one aggregate in Kolmogorov times, by their number in the model's sequence or the files."""
        if self.model is not None:
            return dict(enumerate(TURBULENCE_MODELS[self.model](self.number, self.duration, 1.0, 1.0, seed)))
        unit, paths = _in_files(self)
        number = len(paths) if self.number is None else self.number
        chosen = np.random.default_rng(seed).choice(len(paths), number, replace=False)
        return {k: paths[k].scaled(unit) for k in sorted(chosen.tolist())}

    def _take_hashes(self) -> None:
        assert self.files is not None
        files = []
        for position, each in enumerate(self.files):
            try:
                files.append(HistoryFile(Path(each)) if isinstance(each, str) else each)
            except ValueError as error:
                raise ValueError(f"files[{position}]: {error}") from None
        msgspec.structs.force_setattr(self, "files", tuple(files))

    def _refuse_incomplete(self, model: str) -> None:
        one_of("model", TURBULENCE_MODELS, model)
        for name in ("number", "duration", "dissipations"):
            if getattr(self, name) is None:
                raise ValueError(f"{name}: expected with a model of turbulence, got none; add it")


@lru_cache(CAMPAIGNS_KEPT)
def _in_files(histories: Histories) -> tuple[float, tuple[GradientHistory, ...]]:
    """Kolmogorov time in s, and the histories, which all aggregates of a campaign draw from."""
    assert histories.files is not None
    paths = tuple(path for file in histories.files for path in file.read())  # type: ignore[union-attr]
    squares = sum(path.dissipation(1.0) * path.duration for path in paths)
    if not squares > 0:
        raise ValueError("files: expected velocity gradients with strain, got none; check the files")
    return float(np.sqrt(sum(path.duration for path in paths) / squares)), paths
