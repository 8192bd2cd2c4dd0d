"""Aggregates made here: one way of growing per module, seeded, exactly touching."""

# isort: off
from rheoclast.generation.chains import bent_chain, straight_chain
from rheoclast.generation.rings import cross, ring
from rheoclast.generation.lattices import LATTICES, lattice_ball, lattice_block

from rheoclast.generation.ballistic_particle_cluster import ballistic_particle_cluster
from rheoclast.generation.ballistic_cluster_cluster import ballistic_cluster_cluster
from rheoclast.generation.diffusion_limited_particle_cluster import diffusion_limited_particle_cluster
from rheoclast.generation.diffusion_limited_cluster_cluster import diffusion_limited_cluster_cluster
from rheoclast.generation.reaction_limited_cluster_cluster import reaction_limited_cluster_cluster
from rheoclast.generation.cluster_cluster import cluster_cluster

from rheoclast.generation.ballistic_migration import ballistic_migration
from rheoclast.generation.random_packing import random_packed_ball
from rheoclast.generation.thinned import thinned, thinned_fcc_ball
from rheoclast.generation.compaction import compacted, compacted_cluster
from rheoclast.generation.families import FAMILIES
# isort: on

__all__ = [
    "straight_chain",
    "bent_chain",
    "ring",
    "cross",
    "LATTICES",
    "lattice_block",
    "lattice_ball",
    "ballistic_particle_cluster",
    "ballistic_cluster_cluster",
    "diffusion_limited_particle_cluster",
    "diffusion_limited_cluster_cluster",
    "reaction_limited_cluster_cluster",
    "cluster_cluster",
    "ballistic_migration",
    "random_packed_ball",
    "thinned",
    "thinned_fcc_ball",
    "compacted",
    "compacted_cluster",
    "FAMILIES",
]
