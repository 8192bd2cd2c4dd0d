"""The families by name, for those who choose one in a file or on the command line."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from rheoclast.generation.ballistic_cluster_cluster import ballistic_cluster_cluster
from rheoclast.generation.ballistic_migration import ballistic_migration
from rheoclast.generation.ballistic_particle_cluster import ballistic_particle_cluster
from rheoclast.generation.chains import bent_chain, straight_chain
from rheoclast.generation.cluster_cluster import cluster_cluster
from rheoclast.generation.compaction import compacted_cluster
from rheoclast.generation.diffusion_limited_cluster_cluster import diffusion_limited_cluster_cluster
from rheoclast.generation.diffusion_limited_particle_cluster import diffusion_limited_particle_cluster
from rheoclast.generation.lattices import lattice_ball, lattice_block
from rheoclast.generation.random_packing import random_packed_ball
from rheoclast.generation.reaction_limited_cluster_cluster import reaction_limited_cluster_cluster
from rheoclast.generation.rings import cross, ring
from rheoclast.generation.thinned import thinned_fcc_ball
from rheoclast.particles.aggregate import Aggregate

Family = Callable[..., Aggregate]

FAMILIES: Mapping[str, Family] = MappingProxyType(
    {
        family.__name__.replace("_", "-"): family
        for family in (
            straight_chain,
            bent_chain,
            ring,
            cross,
            lattice_block,
            lattice_ball,
            ballistic_particle_cluster,
            ballistic_cluster_cluster,
            diffusion_limited_particle_cluster,
            diffusion_limited_cluster_cluster,
            reaction_limited_cluster_cluster,
            cluster_cluster,
            ballistic_migration,
            random_packed_ball,
            thinned_fcc_ball,
            compacted_cluster,
        )
    }
)
"""All that grow an aggregate from nothing, by their names with hyphens."""
