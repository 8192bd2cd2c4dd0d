"""Clusters of PyFracVAL and our own tunable ones ↔ the same measures."""

from pathlib import Path

import numpy as np
import pytest

import rheoclast as rc

CLUSTERS = Path(__file__).parents[2] / "examples" / "clusters"


@pytest.mark.parametrize(
    ("file", "dimension", "prefactor"),
    [("fracval_n300_df1.8.dat", 1.8, 1.3), ("fracval_n200_df1.9_polydisperse.dat", 1.9, 1.2)],
)
def test_stated_dimension(file, dimension, prefactor):
    """The law that the generator states holds for the cluster, and the pair correlation gives its dimension.

    One cluster of some hundred spheres scatters by 0.1 to 0.2.
    """
    floc = rc.read(CLUSTERS / file, unit="nm")
    mean_radius = np.exp(np.mean(np.log(floc.spheres.radii)))
    gyration = rc.radius_of_gyration(floc.spheres) / mean_radius
    assert prefactor * gyration**dimension == pytest.approx(len(floc), rel=2e-3)
    found = rc.pair_correlation_dimension(floc)
    assert abs(found.dimension - dimension) < 0.15
    assert found.interval[0] < dimension < found.interval[1]


@pytest.mark.parametrize(("dimension", "prefactor"), [(1.6, 1.4), (1.8, 1.3), (2.1, 1.2)])
def test_tunable_clusters_have_it_too(dimension, prefactor):
    """Mean over eight clusters of 1 200 spheres; the range of distances is short, hence the bias allowed."""
    flocs = [
        rc.generation.cluster_cluster(1200, fractal_dimension=dimension, prefactor=prefactor, seed=k) for k in range(8)
    ]
    for floc in flocs:
        assert prefactor * rc.radius_of_gyration(floc.spheres) ** dimension == pytest.approx(1200, rel=1e-9)
    mean = np.mean([rc.pair_correlation_dimension(floc).dimension for floc in flocs])
    assert abs(mean - dimension) < 0.15
