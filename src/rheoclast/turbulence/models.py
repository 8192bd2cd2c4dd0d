"""The models of turbulence by name, for those who choose one in a file or on the command line."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from rheoclast.histories import GradientHistory
from rheoclast.turbulence.gaussian import gaussian_histories
from rheoclast.turbulence.recent_deformation import recent_deformation_histories

TurbulenceModel = Callable[..., tuple[GradientHistory, ...]]

TURBULENCE_MODELS: Mapping[str, TurbulenceModel] = MappingProxyType(
    {
        model.__name__.removesuffix("_histories").replace("_", "-"): model
        for model in (gaussian_histories, recent_deformation_histories)
    }
)
"""All that make histories from dissipation and viscosity, by their names with hyphens, without `histories`."""
