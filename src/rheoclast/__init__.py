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
    radial_position,
    radius_of_gyration,
    relative_shape_anisotropy,
)
from rheoclast.particles.fractal import FractalLaw, PairCorrelationDimension, fractal_law, pair_correlation_dimension
from rheoclast import generation
from rheoclast.io import read, read_histories, read_spheres, write, write_histories, write_kernel, write_table

from rheoclast.flows import LinearFlow, biaxial_extension, planar_extension, simple_shear, uniaxial_extension
from rheoclast.histories import GradientHistory
from rheoclast import turbulence
from rheoclast.turbulence import gaussian_histories, kolmogorov_time, recent_deformation_histories
from rheoclast.hydrodynamics.model import Approximation, HydrodynamicModel
from rheoclast.hydrodynamics.free_draining import FreeDraining
from rheoclast.hydrodynamics.exposed_area import ExposedArea
from rheoclast.hydrodynamics.stokesian_dynamics import StokesianDynamics
from rheoclast.stokes.automatic import Automatic
from rheoclast.stokes.dense import DenseCholesky
from rheoclast.stokes.iterative import BlockConjugateGradients
from rheoclast.stokes.solver import Convergence
from rheoclast.hydrodynamics.response import RigidResponse, rigid_response
from rheoclast.hydrodynamics.motion import RigidMotion, Settling
from rheoclast.hydrodynamics.trajectory import Gradients, Trajectory, trajectory
from rheoclast.loads import SphereLoads

from rheoclast.mechanics.material import MATERIALS, Material
from rheoclast.mechanics.bonds import Bonds
from rheoclast.mechanics.laws.law import ContactLaw
from rheoclast.mechanics.laws.jkr import JKR, jkr_bonds
from rheoclast.mechanics.laws.measured_pull_off import MeasuredPullOff
from rheoclast.mechanics.contact_loads import ContactLoads, contact_loads
from rheoclast.mechanics.criteria.criterion import AnyOf, Criterion
from rheoclast.mechanics.criteria.tension import Tension
from rheoclast.mechanics.criteria.sliding import Sliding
from rheoclast.mechanics.criteria.rolling import Rolling
from rheoclast.mechanics.criteria.twisting import Twisting
from rheoclast.mechanics.criteria.combined import Combined
from rheoclast.mechanics.criteria.load_ratios import EVERY_LIMIT, load_ratios

from rheoclast.breakup.contact_response import ContactResponse, contact_response
from rheoclast.breakup.initiation import Initiation, Initiations, initiation, initiations, worst_initiation
from rheoclast.breakup.truncation import LoadErrors, rate_error, truncation_error
from rheoclast.breakup.event import Breakup, Failure
from rheoclast.breakup.crack import break_up, break_up_each
from rheoclast.breakup.load_history import Exceedances, FirstFailure, LargestLoad, LoadHistory, load_history
from rheoclast.breakup.orbit import OrbitInitiation, orbit_initiation
from rheoclast.breakup.orientation import flow_met
from rheoclast.breakup.cascade import Cascade, Piece, cascade

from rheoclast.populations.orientations import random_orientations
from rheoclast.populations.breakage_rate import (
    EventRate,
    WaitingTimes,
    breakage_rate,
    exceedance_rate,
    first_failure_times,
    poisson_rate,
)
from rheoclast.populations.power_law import PowerLaw, power_law
from rheoclast.populations.fragment_distribution import FragmentDistribution, fragment_distribution
from rheoclast.populations.turbulent_breakage import (
    CriticalDissipation,
    critical_dissipation,
    fitted_critical_dissipation,
    turbulent_breakage_rate,
)
from rheoclast.populations.kernel_table import KERNEL_COLUMNS, KernelEntry, kernel_table

from rheoclast.errors import FileFormatError, GeometryError, GeometryWarning, UnitWarning
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
    "radial_position",
    "radius_of_gyration",
    "relative_shape_anisotropy",
    "FractalLaw",
    "PairCorrelationDimension",
    "fractal_law",
    "pair_correlation_dimension",
    "generation",
    "read",
    "read_histories",
    "read_spheres",
    "write",
    "write_histories",
    "write_kernel",
    "write_table",
    "LinearFlow",
    "biaxial_extension",
    "planar_extension",
    "simple_shear",
    "uniaxial_extension",
    "GradientHistory",
    "turbulence",
    "gaussian_histories",
    "kolmogorov_time",
    "recent_deformation_histories",
    "Approximation",
    "HydrodynamicModel",
    "FreeDraining",
    "ExposedArea",
    "StokesianDynamics",
    "Automatic",
    "DenseCholesky",
    "BlockConjugateGradients",
    "Convergence",
    "RigidResponse",
    "rigid_response",
    "RigidMotion",
    "Settling",
    "Gradients",
    "Trajectory",
    "trajectory",
    "SphereLoads",
    "MATERIALS",
    "Material",
    "Bonds",
    "ContactLaw",
    "JKR",
    "jkr_bonds",
    "MeasuredPullOff",
    "ContactLoads",
    "contact_loads",
    "Criterion",
    "Tension",
    "Sliding",
    "Rolling",
    "Twisting",
    "Combined",
    "AnyOf",
    "EVERY_LIMIT",
    "load_ratios",
    "ContactResponse",
    "contact_response",
    "Initiation",
    "Initiations",
    "initiation",
    "initiations",
    "worst_initiation",
    "LoadErrors",
    "rate_error",
    "truncation_error",
    "Breakup",
    "Failure",
    "break_up",
    "break_up_each",
    "Exceedances",
    "FirstFailure",
    "LargestLoad",
    "LoadHistory",
    "load_history",
    "OrbitInitiation",
    "orbit_initiation",
    "flow_met",
    "Cascade",
    "Piece",
    "cascade",
    "random_orientations",
    "EventRate",
    "WaitingTimes",
    "breakage_rate",
    "exceedance_rate",
    "first_failure_times",
    "poisson_rate",
    "PowerLaw",
    "power_law",
    "FragmentDistribution",
    "fragment_distribution",
    "CriticalDissipation",
    "critical_dissipation",
    "fitted_critical_dissipation",
    "turbulent_breakage_rate",
    "KERNEL_COLUMNS",
    "KernelEntry",
    "kernel_table",
    "FileFormatError",
    "GeometryError",
    "GeometryWarning",
    "UnitWarning",
]


def __dir__() -> list[str]:
    """What the package offers, without the modules in which it stands."""
    return sorted(__all__)
