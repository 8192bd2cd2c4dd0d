"""Velocity gradients along fluid paths in isotropic turbulence, made here: one stochastic model per module, seeded."""

# isort: off
from rheoclast.turbulence._requests import kolmogorov_time
from rheoclast.turbulence.gaussian import gaussian_histories
from rheoclast.turbulence.recent_deformation import recent_deformation_histories
from rheoclast.turbulence.models import TURBULENCE_MODELS
# isort: on

__all__ = ["kolmogorov_time", "gaussian_histories", "recent_deformation_histories", "TURBULENCE_MODELS"]
