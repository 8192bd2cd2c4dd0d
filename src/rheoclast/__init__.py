"""Rheoclast: flow-induced stresses and breakup of rigid colloidal aggregates."""

__version__ = "0.1.0"

# isort: off
from rheoclast.particles.spheres import Spheres
from rheoclast.particles.aggregate import Aggregate
from rheoclast.particles.morphology import (
    anisotropy,
    coordination_distribution,
    coordination_numbers,
    depth,
    enclosing_porosity,
    enclosing_radius,
    enclosing_sphere,
    gyration_tensor,
    loops,
    mean_coordination,
    porosity,
    radius_of_gyration,
    relative_shape_anisotropy,
)
from rheoclast.particles.fractal import FractalLaw, PairCorrelationDimension, fractal_law, pair_correlation_dimension
from rheoclast import generation
from rheoclast.io import read, read_spheres, write, write_table

from rheoclast.flows import LinearFlow, biaxial_extension, planar_extension, simple_shear, uniaxial_extension
from rheoclast.hydrodynamics.model import HydrodynamicModel
from rheoclast.hydrodynamics.free_draining import FreeDraining
from rheoclast.hydrodynamics.exposed_area import ExposedArea
from rheoclast.hydrodynamics.stokesian_dynamics import StokesianDynamics
from rheoclast.stokes.dense import DenseCholesky
from rheoclast.stokes.iterative import BlockConjugateGradients
from rheoclast.hydrodynamics.response import RigidResponse, rigid_response
from rheoclast.hydrodynamics.motion import RigidMotion, Settling
from rheoclast.loads import SphereLoads

from rheoclast.mechanics.material import MATERIALS, Material
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.laws.law import ContactLaw
from rheoclast.mechanics.laws.jkr import JKR, jkr_bonds
from rheoclast.mechanics.laws.measured_pull_off import MeasuredPullOff
from rheoclast.mechanics.laws.uniform import Uniform
from rheoclast.mechanics.contact_loads import ContactLoads, contact_loads
from rheoclast.mechanics.criteria import load_ratios

from rheoclast.breakup.contact_response import ContactResponse, contact_response
from rheoclast.breakup.truncation import TruncationError, truncation_error
from rheoclast.breakup.initiation import Initiation, initiation, worst_initiation
from rheoclast.breakup.crack import Breakup, Failure, break_up

from rheoclast.errors import FileFormatError, GeometryError, UnitWarning
# isort: on

__all__ = [
    "Spheres",
    "Aggregate",
    "anisotropy",
    "coordination_distribution",
    "coordination_numbers",
    "depth",
    "enclosing_porosity",
    "enclosing_radius",
    "enclosing_sphere",
    "gyration_tensor",
    "loops",
    "mean_coordination",
    "porosity",
    "radius_of_gyration",
    "relative_shape_anisotropy",
    "FractalLaw",
    "PairCorrelationDimension",
    "fractal_law",
    "pair_correlation_dimension",
    "generation",
    "read",
    "read_spheres",
    "write",
    "write_table",
    "LinearFlow",
    "biaxial_extension",
    "planar_extension",
    "simple_shear",
    "uniaxial_extension",
    "HydrodynamicModel",
    "FreeDraining",
    "ExposedArea",
    "StokesianDynamics",
    "DenseCholesky",
    "BlockConjugateGradients",
    "RigidResponse",
    "rigid_response",
    "RigidMotion",
    "Settling",
    "SphereLoads",
    "MATERIALS",
    "Material",
    "Bonds",
    "ContactLaw",
    "JKR",
    "jkr_bonds",
    "MeasuredPullOff",
    "Uniform",
    "ContactLoads",
    "contact_loads",
    "load_ratios",
    "ContactResponse",
    "contact_response",
    "TruncationError",
    "truncation_error",
    "Initiation",
    "initiation",
    "worst_initiation",
    "Breakup",
    "Failure",
    "break_up",
    "FileFormatError",
    "GeometryError",
    "UnitWarning",
]
