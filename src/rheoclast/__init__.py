"""Rheoclast: flow-induced stresses and breakup of rigid colloidal aggregates."""

from rheoclast.errors import FileFormatError, GeometryError, UnitWarning
from rheoclast.flows import LinearFlow, biaxial_extension, planar_extension, simple_shear, uniaxial_extension
from rheoclast.loads import SphereLoads
from rheoclast.particles.aggregate import Aggregate
from rheoclast.particles.spheres import Spheres

__all__ = [
    "Aggregate",
    "FileFormatError",
    "GeometryError",
    "LinearFlow",
    "SphereLoads",
    "Spheres",
    "UnitWarning",
    "biaxial_extension",
    "planar_extension",
    "simple_shear",
    "uniaxial_extension",
]
