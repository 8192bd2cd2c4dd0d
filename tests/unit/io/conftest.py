from pathlib import Path

import numpy as np
import pytest

from rheoclast import Aggregate, Spheres


@pytest.fixture
def aggregate():
    """Five unequal spheres in a bent chain, in metres, far from round numbers."""
    radii = np.array([1.1, 0.7, 1.3, 0.9, 1.0]) * 1e-6 / 3
    rng = np.random.default_rng(3)
    directions = np.array([1.0, 0.4, 0.3]) + 0.3 * rng.standard_normal((4, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    steps = (radii[1:] + radii[:-1])[:, None] * directions
    return Aggregate.touching(Spheres(np.vstack([np.zeros(3), np.cumsum(steps, axis=0)]) - 1e-7 / 3, radii))


@pytest.fixture
def sphere_columns(aggregate):
    rng = np.random.default_rng(4)
    return {"force_N": 1e-12 * rng.standard_normal((len(aggregate), 3)), "depth": rng.random(len(aggregate))}


@pytest.fixture
def file(tmp_path):
    """Writes text to a file in a temporary folder and returns its path."""

    def written(name, content):
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    return written


@pytest.fixture(scope="session")
def data():
    return Path(__file__).parents[3] / "examples" / "clusters"
