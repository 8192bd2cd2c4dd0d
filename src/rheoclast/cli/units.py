"""The units in which the command line reports."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from rheoclast.cli.analysis import Analysis
from rheoclast.io.lengths import DIMENSIONLESS


class UnitNames(NamedTuple):
    """How each unit is called."""

    length: str
    force: str
    moment: str
    rate: str
    flow_rate: str = "1/s"
    viscosity: str = "Pa s"


SI_NAMES = UnitNames("m", "N", "N m", "1/s")
NO_NAMES = UnitNames(*[""] * 6)
SI_TAGS = UnitNames("_m", "_N", "_Nm", "_per_s")
DIMENSIONLESS_NAMES = UnitNames("a", "μGa²", "μGa³", "F/μa²")
DIMENSIONLESS_TAGS = UnitNames("", "", "", "")


@dataclass(frozen=True)
class Units:
    """Size of each reported unit in SI, its name, and what it adds to the name of a column.

    In dimensionless units lengths are in mean radii a, forces in μ G a², moments in μ G a³ with G the rate of the flow,
    and initiation rates in F/(μ a²) with F the mean pull-off force of the contacts. Lengths that had no unit in their
    file have none in results, nor has anything else.
    """

    length: float = 1.0
    force: float = 1.0
    rate: float = 1.0
    names: UnitNames = SI_NAMES
    tags: UnitNames = SI_TAGS

    @property
    def moment(self) -> float:
        """Size of the unit of moment in N m."""
        return self.force * self.length

    @classmethod
    def dimensionless(cls, analysis: Analysis) -> Units:
        """Units made from the aggregate, the liquid and the flow."""
        scales, rate = analysis.response.scales, analysis.flow.rate
        if not rate:
            raise ValueError("--dimensionless: expected a positive rate to scale with, got 0")
        strength = float(analysis.bonds.strength(len(analysis.aggregate.pairs))[:, 0].mean())
        force, initiation_rate = scales.force * rate, strength / scales.force
        return cls(scales.length, force, initiation_rate, DIMENSIONLESS_NAMES, DIMENSIONLESS_TAGS)

    @classmethod
    def of_file(cls, unit: str) -> Units:
        """Units of results on spheres in a file with a unit of length: those of SI, unless it has none."""
        return cls(names=NO_NAMES, tags=DIMENSIONLESS_TAGS) if unit == DIMENSIONLESS else cls()

    def sizes(self, rate: float) -> dict[str, float]:
        """Size in SI of what the units are made from: a, F, and G, the rate of the flow; none for SI itself."""
        if self.names is not DIMENSIONLESS_NAMES:
            return {}
        viscosity = self.force / (rate * self.length**2)
        return {"a_m": self.length, "G_per_s": rate, "F_N": self.rate * viscosity * self.length**2}
