"""What every model is asked for: how many histories of which turbulence, at which instants, from which seed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray
from rheoclast.histories import GradientHistory

STEPS_PER_KOLMOGOROV_TIME = 10
MOST_INSTANTS = 10**8  # of all histories together: 7 GB of gradients


def kolmogorov_time(dissipation: float, kinematic_viscosity: float) -> float:
    """Time (ν/ε)^½ in s of the smallest eddies, for a dissipation ε in m²/s³ and a kinematic viscosity ν in m²/s.

    In isotropic turbulence it is the inverse of the root mean square of `LinearFlow.magnitude`.
    """
    dissipation = _checks.positive("dissipation", dissipation)
    return float(np.sqrt(_checks.positive("kinematic_viscosity", kinematic_viscosity) / dissipation))


@dataclass(frozen=True, eq=False)
class Request:
    """Instants (T,) in Kolmogorov times, this time in s, and one source of random numbers per history."""

    instants: FloatArray
    unit: float
    random: tuple[np.random.Generator, ...]

    @classmethod
    def checked(
        cls,
        count: int,
        duration: float,
        dissipation: float,
        kinematic_viscosity: float,
        seed: int,
        step: float | None,
    ) -> Request:
        """A request in SI units; the step is shortened until a whole number of them makes the duration.

        Raises
        ------
        ValueError
            If a number is not positive, or there would be more than 10⁸ instants in all.
        """
        unit = kolmogorov_time(dissipation, kinematic_viscosity)
        duration = _checks.positive("duration", duration)
        step = unit / STEPS_PER_KOLMOGOROV_TIME if step is None else _checks.positive("step", step)
        count, seed = _checks.whole_number("count", count, 1), _checks.whole_number("seed", seed, 0)
        total = count * (duration / step + 1)
        if total > MOST_INSTANTS:
            raise ValueError(
                f"step, duration, count: expected at most {MOST_INSTANTS:g} instants in all, got {total:.3g}; "
                "make the histories shorter, fewer or coarser"
            )
        steps = int(np.ceil(duration / step * (1 - 1e-12)))
        streams = np.random.SeedSequence(seed).spawn(count)
        instants = np.linspace(0, duration / unit, steps + 1)
        return cls(_checks.frozen(instants), unit, tuple(map(np.random.default_rng, streams)))

    @property
    def step(self) -> float:
        """Time between instants, in Kolmogorov times."""
        return float(self.instants[1])

    def history(self, gradients: Any) -> GradientHistory:
        """The history of gradients (T, 3, 3) that are in units of the inverse Kolmogorov time."""
        return GradientHistory(self.instants * self.unit, gradients / self.unit)
