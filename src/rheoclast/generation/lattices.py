"""Pieces of crystal lattices of touching spheres: blocks of layers, and balls.

Every lattice is stacked from equal layers, and every layer from equal straight rows; odd rows and odd layers are
shifted (N. W. Ashcroft & N. D. Mermin, Solid State Physics (1976), chapter 4).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray, IntArray
from rheoclast.generation._unit_spheres import unit_sphere_aggregate
from rheoclast.particles.aggregate import Aggregate


@dataclass(frozen=True)
class Lattice:
    """Sites of touching unit spheres: site (i, j, k) is the i-th of row j of layer k.

    Parameters
    ----------
    spacing
        From site to site in a row (x), from row to row (y) and from layer to layer (z).
    row_shift
        Of odd rows along x.
    layer_shift
        Of odd layers along x and y.
    coordination
        Neighbours that each site touches.
    """

    spacing: tuple[float, float, float]
    row_shift: float
    layer_shift: tuple[float, float]
    coordination: int

    def sites(self, indices: IntArray) -> FloatArray:
        """Centres (..., 3) of sites (..., 3), in sphere radii."""
        _, row, layer = np.moveaxis(indices, -1, 0) % 2
        shift = np.stack([row * self.row_shift + layer * self.layer_shift[0], layer * self.layer_shift[1], 0 * row], -1)
        return indices * np.array(self.spacing) + shift


_BCC_EDGE = 4 / np.sqrt(3)

LATTICES: Mapping[str, Lattice] = MappingProxyType(
    {
        "sc": Lattice((2.0, 2.0, 2.0), 0.0, (0.0, 0.0), 6),
        "bcc": Lattice((_BCC_EDGE, _BCC_EDGE, _BCC_EDGE / 2), 0.0, (_BCC_EDGE / 2, _BCC_EDGE / 2), 8),
        "fcc": Lattice((2.0, 2.0, np.sqrt(2)), 0.0, (1.0, 1.0), 12),
        "hcp": Lattice((2.0, np.sqrt(3), np.sqrt(8 / 3)), 1.0, (1.0, 1 / np.sqrt(3)), 12),
    }
)
"""Simple, body-centred and face-centred cubic, in square layers; hexagonal close-packed, in triangular layers."""

_BALL_DIRECTION = np.array([1.0, np.sqrt(2), np.sqrt(3)])


def lattice_block(lattice: str, counts: tuple[int, int, int], radius: float = 1.0) -> Aggregate:
    """Block of equal spheres, `radius` in m, on one of `LATTICES`: nx spheres in a row, ny rows, nz layers.

    Rows run along x and layers are normal to z: square layers for sc, bcc and fcc, triangular ones for hcp. One
    layer gives a planar aggregate. Spheres are ordered row by row and layer by layer.

    Raises
    ------
    ValueError
        If the lattice is unknown, a count is below one, or the block is one layer of bcc, where no two spheres touch.
    """
    shape = _block_shape(counts)
    if lattice == "bcc" and shape[2] == 1 and max(shape) > 1:
        raise ValueError(f"counts: expected at least 2 layers of bcc, whose layers do not hold alone, got {shape}")
    indices = np.moveaxis(np.indices(shape[::-1]), 0, -1)[..., ::-1].reshape(-1, 3)
    return unit_sphere_aggregate(_lattice(lattice).sites(indices), radius)


def lattice_ball(lattice: str, count: int, radius: float = 1.0) -> Aggregate:
    """The `count` sites of one of `LATTICES` nearest to a site, occupied by equal spheres, `radius` in m.

    Spheres are ordered from the centre outwards. Where an outermost shell is not full, its sites nearest to the plane
    through the centre normal to (1, √2, √3) are taken first, so that opposite sites enter one after the other and the
    ball stays balanced. It is connected, as every site touches one that is nearer to the centre.

    Raises
    ------
    ValueError
        If the lattice is unknown or the count is below one.
    """
    count = _checks.whole_number("count", count, 1)
    shape = _lattice(lattice)
    # Spheres fill at least the share π/6 of space, so that this radius holds them all, and so do these indices.
    reach = np.ceil((2 + 2 * np.cbrt(count)) / np.array(shape.spacing)).astype(int) + 1
    indices = np.moveaxis(np.indices(2 * reach + 1), 0, -1).reshape(-1, 3) - reach
    sites = shape.sites(indices)
    distance = np.round(np.linalg.norm(sites, axis=1), 9)
    height = np.round(sites @ _BALL_DIRECTION, 9)
    nearest = np.lexsort((height, np.abs(height), distance))[:count]
    return unit_sphere_aggregate(sites[nearest], radius)


def _lattice(name: str) -> Lattice:
    if name not in LATTICES:
        raise ValueError(f"lattice: expected one of {', '.join(LATTICES)}, got {name!r}")
    return LATTICES[name]


def _block_shape(counts: Any) -> tuple[int, int, int]:
    if np.shape(counts) != (3,):
        raise ValueError(f"counts: expected three integers (row, rows, layers), got {counts!r}")
    nx, ny, nz = (_checks.whole_number(f"counts[{axis}]", counts[axis], 1) for axis in range(3))
    return nx, ny, nz
