"""Free draining: every sphere feels the undisturbed flow, as if alone."""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np

from rheoclast._checks import FloatArray
from rheoclast.hydrodynamics.model import Approximation, HydrodynamicModel
from rheoclast.progress import Progress
from rheoclast.vectors import elementary_velocities


@final
@dataclass(frozen=True)
class FreeDraining(HydrodynamicModel):
    """Stokes drag 6πμaU, torque 8πμa³Ω and stresslet (20/3)πμa³E of isolated spheres (no hydrodynamic interaction)."""

    def elementary_loads(
        self, centers: FloatArray, radii: FloatArray, progress: Progress | None = None
    ) -> list[Approximation]:
        """See `HydrodynamicModel.elementary_loads`."""
        loads = np.zeros((len(radii), 11, 11))
        loads[:, :3] = 6 * np.pi * radii[:, None, None] * elementary_velocities(centers).transpose(0, 2, 1)
        volume = (radii**3)[:, None, None]
        loads[:, 3:6, 3:6] = 8 * np.pi * volume * np.eye(3)
        loads[:, 6:, 6:] = 20 / 3 * np.pi * volume * np.eye(5)
        return [Approximation(loads)]
