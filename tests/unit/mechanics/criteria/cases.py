"""Contact loads with known parts, for tests of failure criteria."""

import numpy as np

import rheoclast as rc


def loads(tension, shear, bending, twisting, seed=0):
    """Contacts (C,) in any direction that carry the given tension, shear, bending and twisting, (..., C) each."""
    rng = np.random.default_rng(seed)
    parts = np.broadcast_arrays(tension, shear, bending, twisting)
    tension, shear, bending, twisting = (np.atleast_1d(np.asarray(part, float))[..., None] for part in parts)
    normals = _unit(rng.normal(size=(tension.shape[-2], 3)))
    across = [_unit(np.cross(normals, rng.normal(size=normals.shape))) for _ in range(2)]
    return rc.ContactLoads(normals, tension * normals + shear * across[0], twisting * normals + bending * across[1])


def random_loads(seed, shape=(20,)):
    """Loads of either sign and of many sizes."""
    rng = np.random.default_rng(seed)
    parts = rng.normal(size=(4, *shape)) * 10.0 ** rng.uniform(-2, 2, size=(4, *shape))
    return loads(parts[0], abs(parts[1]), abs(parts[2]), parts[3], seed)


def random_bonds(seed, count=20):
    """Another strength of every contact against each load."""
    strength = 10.0 ** np.random.default_rng(seed).uniform(-1, 1, (4, count))
    return rc.Bonds(1.0, 1.0, 1.0, 1.0, *strength)


def times(factor, carried):
    """The same loads, `factor` times as large."""
    return rc.ContactLoads(carried.normals, factor * carried.force, factor * carried.moment)


def _unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
