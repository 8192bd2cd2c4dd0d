"""Spheres as an image: a z-buffer, soft light and ambient occlusion in NumPy, arrays in, arrays out.

Orthographic projection. All lengths are in pixels: x to the right and y upwards from the lower left corner of the
image, z towards the viewer. Row 0 of every image is its bottom row.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial import cKDTree

from rheoclast._checks import FloatArray, IntArray

SPHERE_COLOUR = (0.89, 0.89, 0.89)
RIM_COLOUR = (0.25, 0.25, 0.25)
LIGHT = np.array([-0.48, 0.58, 0.66]) / np.linalg.norm([-0.48, 0.58, 0.66])
AMBIENT, DIFFUSE = 0.4, 0.7
PAINT_GLOW = 0.8  # share of the shadow that vivid paint is spared, so that it can be read off the colour bar
FADE = 0.4  # share of a collar's reach over which its paint fades
OCCLUSION = 0.7  # share of the light from the hidden sky that is lost
OCCLUDERS = 24  # neighbours that may shade a sphere
SMALLEST_COLLAR = 4.0  # pixels, or all of a smaller sphere, so that its paint can be seen
FULL_RIM, FAINTEST_RIM = 6.0, 0.3  # radius in pixels from which on a limb is fully dark, and share of that in dots
BAND = 64  # rows shaded at a time, which bounds the memory
NOTHING = -1

Image = NDArray[np.float32]
Window = tuple[tuple[slice, slice], Image, Image]


@dataclass(frozen=True, eq=False)
class Rendering:
    """Image of spheres.

    Attributes
    ----------
    image
        (H, W, 4) red, green, blue and opacity from 0 to 1; the background is transparent.
    owner
        (H, W) index of the sphere seen at each pixel's middle, −1 where there is none.
    contact
        (H, W) index of the contact whose collar is seen there, −1 where there is none.
    """

    image: Image
    owner: NDArray[np.int32]
    contact: NDArray[np.int32]


@dataclass(frozen=True, eq=False)
class Collars:
    """Patches painted around the C contact points, on both spheres of each contact.

    Attributes
    ----------
    pairs
        (C, 2) indices of the two spheres.
    points
        (C, 3) contact points in pixels.
    reaches
        (C,) largest distance of painted surface points from the contact point, in pixels.
    colours
        (C, 3) red, green, blue.
    """

    pairs: IntArray
    points: FloatArray
    reaches: FloatArray
    colours: FloatArray

    @classmethod
    def around(
        cls, pairs: IntArray, points: FloatArray, radii: FloatArray, share: float, colours: FloatArray
    ) -> Collars:
        """Patches that reach over a share of the smaller radius (C,) of each contact."""
        return cls(pairs, points, np.maximum(share * radii, np.minimum(2 * radii, SMALLEST_COLLAR)), colours)

    @classmethod
    def none(cls) -> Collars:
        """No patches."""
        return cls(np.empty((0, 2), dtype=np.intp), np.empty((0, 3)), np.empty(0), np.empty((0, 3)))


def render(
    centers: FloatArray,
    radii: FloatArray,
    collars: Collars,
    width: int,
    height: int,
    *,
    colours: ArrayLike = SPHERE_COLOUR,
    samples: int = 3,
) -> Rendering:
    """Image of spheres (N, 3), (N,) with painted contacts, `samples`² points per pixel.

    `colours` are red, green, blue of every sphere (N, 3) or of all (3,).
    """
    centers, radii = samples * centers, samples * radii
    depth, owner = visible_surface(centers, radii, height * samples, width * samples)
    own_colours = np.broadcast_to(np.asarray(colours, dtype=np.float32), (len(radii), 3))
    colour, contact = _painted(depth, owner, own_colours, collars, samples)
    openness = _openness(centers, radii, depth, owner, samples)
    for top in range(0, len(depth), BAND * samples):
        band = slice(top, top + BAND * samples)
        _shade(colour[band], centers, radii, depth[band], owner[band], openness[band], top, samples)
    middle = np.s_[samples // 2 :: samples, samples // 2 :: samples]
    return Rendering(_averaged(colour, owner != NOTHING, samples), owner[middle].copy(), contact[middle].copy())


def visible_surface(centers: FloatArray, radii: FloatArray, height: int, width: int) -> tuple[Image, NDArray[np.int32]]:
    """Height z of the nearest surface (−∞ where none) and the sphere it belongs to (−1 where none), both (H, W)."""
    depth = np.full((height, width), -np.inf, dtype=np.float32)
    owner = np.full((height, width), NOTHING, dtype=np.int32)
    heights, squares = centers[:, 2].astype(np.float32), (radii**2).astype(np.float32)
    for i, (window, across, along) in enumerate(_windows(centers, radii, depth.shape)):
        above = squares[i] - across**2 - along**2
        surface = heights[i] + np.sqrt(np.maximum(above, 0))
        nearer = (above > 0) & (surface > depth[window])
        depth[window][nearer] = surface[nearer]
        owner[window][nearer] = i
    return depth, owner


def _windows(points: FloatArray, reaches: FloatArray, shape: Sequence[int]) -> Iterator[Window]:
    """Part of the image within reach of each point, and the offsets x (1, w) and y (h, 1) of its pixel middles."""
    limits = np.array(shape[::-1])
    low = np.clip(np.floor(points[:, :2] - reaches[:, None]), 0, limits).astype(int)
    high = np.clip(np.ceil(points[:, :2] + reaches[:, None]), low, limits).astype(int)
    columns, rows = (np.arange(length) + 0.5 for length in limits)
    for (x, y, _), (left, bottom), (right, top) in zip(points.tolist(), low.tolist(), high.tolist(), strict=True):
        across = (columns[left:right] - x).astype(np.float32)
        along = (rows[bottom:top] - y).astype(np.float32)
        yield np.s_[bottom:top, left:right], across[None, :], along[:, None]


def _painted(
    depth: Image, owner: NDArray[np.int32], sphere_colours: Image, collars: Collars, samples: int
) -> tuple[Image, NDArray[np.int32]]:
    """Colour (H, W, 3) of the visible surface before light falls on it, and the nearest contact painted there.

    The paint is full near the contact point and fades out towards `reaches`; where collars meet, they add.
    """
    colour = np.zeros((*depth.shape, 3), dtype=np.float32)
    colour[owner != NOTHING] = sphere_colours[owner[owner != NOTHING]]
    contact = np.full(depth.shape, NOTHING, dtype=np.int32)
    nearest = np.full(depth.shape, np.inf, dtype=np.float32)
    paint = collars.colours.astype(np.float32)
    seen = np.flatnonzero(_visible(owner, len(sphere_colours))[collars.pairs].any(axis=1))
    points, reaches = samples * collars.points[seen], samples * collars.reaches[seen]
    for k, (window, across, along) in enumerate(_windows(points, reaches, depth.shape)):
        c, reach = seen[k], reaches[k]
        distance2 = across**2 + along**2 + (depth[window] - np.float32(points[k, 2])) ** 2
        ours = (owner[window] == collars.pairs[c, 0]) | (owner[window] == collars.pairs[c, 1])
        ours &= distance2 < np.float32(reach**2)
        distance = np.sqrt(distance2[ours])
        share = np.clip((1 - distance / np.float32(reach)) / np.float32(FADE), 0, 1)
        colour[window][ours] += (share * share * (3 - 2 * share))[:, None] * (
            paint[c] - sphere_colours[owner[window][ours]]
        )
        first = distance < nearest[window][ours]
        ours[ours] = first
        contact[window][ours] = c
        nearest[window][ours] = distance[first]
    return colour, contact


def _shade(
    colour: Image,
    centers: FloatArray,
    radii: FloatArray,
    depth: Image,
    owner: NDArray[np.int32],
    openness: Image,
    first_row: int,
    samples: int,
) -> None:
    """Light the covered points of a band of the image, whose lowest row is `first_row`."""
    row, column = np.nonzero(owner != NOTHING)
    sphere, height = owner[row, column], depth[row, column]
    radius = radii.astype(np.float32)[sphere]
    normal = np.stack([column + 0.5, row + (first_row + 0.5), height], axis=1).astype(np.float32)
    normal = (normal - centers.astype(np.float32)[sphere]) / radius[:, None]
    paint = np.clip(colour[row, column], 0, 1)
    light = 0.5 + 0.5 * (normal @ LIGHT.astype(np.float32))
    brightness = openness[row, column] * (AMBIENT + DIFFUSE * light)
    brightness += PAINT_GLOW * np.ptp(paint, axis=1) * (1 - brightness)
    paint *= brightness[:, None]
    _draw_rims(paint, normal, radius, samples)
    _fade_with_distance(paint, height, centers[:, 2], radii)
    colour[row, column] = np.clip(paint, 0, 1)


def _openness(centers: FloatArray, radii: FloatArray, depth: Image, owner: NDArray[np.int32], samples: int) -> Image:
    """Share (H, W) of the sky over a surface point that neighbouring spheres leave open, one value per pixel block.

    A sphere of radius r at v from the point, n·v > 0, hides (n·v)/|v| (r/|v|)² of the cosine-weighted sky.
    """
    half = samples // 2
    coarse_owner, coarse_depth = owner[half::samples, half::samples], depth[half::samples, half::samples]
    openness = np.ones(coarse_owner.shape, dtype=np.float32)
    count = min(OCCLUDERS, len(radii) - 1)
    if count:
        seen = np.flatnonzero(_visible(coarse_owner, len(radii)))
        neighbours = np.asarray(cKDTree(centers).query(centers[seen], k=[*range(2, count + 2)])[1])
        windows = _windows(centers[seen] / samples, radii[seen] / samples, openness.shape)
        for i, others, (window, across, along) in zip(seen, neighbours, windows, strict=True):
            mine = coarse_owner[window] == i
            row, column = np.nonzero(mine)
            height = coarse_depth[window][mine] - np.float32(centers[i, 2])
            offset = np.stack([samples * across[0, column], samples * along[row, 0], height], axis=1)
            openness[window][mine] = _open_sky(offset, radii[i], centers[others] - centers[i], radii[others])
    return openness.repeat(samples, axis=0).repeat(samples, axis=1)


def _open_sky(offset: Image, radius: float, others: FloatArray, other_radii: FloatArray) -> Image:
    """Open share (P,) of the sky over surface points (P, 3) of a sphere, between spheres (J, 3), from its centre."""
    a, others, other_radii = np.float32(radius), others.astype(np.float32), other_radii.astype(np.float32)
    along_normal = (offset / a) @ others.T
    distance2 = np.sum(others**2, axis=1) + a**2 - 2 * a * along_normal
    hidden = np.maximum(along_normal - a, 0) * other_radii**2 / np.maximum(distance2, 1e-12) ** 1.5
    return np.asarray(np.prod(1 - OCCLUSION * np.minimum(hidden, 1), axis=1), dtype=np.float32)


def _visible(owner: NDArray[np.int32], count: int) -> NDArray[np.bool_]:
    """Which of the spheres (count,) are seen anywhere."""
    seen = np.zeros(count + 1, dtype=np.bool_)  # the last for `NOTHING`
    seen[owner] = True
    return seen[:count]


def _draw_rims(colour: Image, normal: Image, radius: Image, samples: int) -> None:
    """Darken the limb of every sphere, a line about one pixel wide, less where the whole sphere is hardly more."""
    inside = radius * (1 - np.hypot(normal[:, 0], normal[:, 1]))
    width = np.minimum(1.1 * samples, 0.14 * radius)
    strength = 0.85 * np.clip(1.5 - inside / width, 0, 1) * np.clip(radius / samples / FULL_RIM, FAINTEST_RIM, 1)
    colour += strength[:, None] * (np.asarray(RIM_COLOUR, dtype=np.float32) - colour)


def _fade_with_distance(colour: Image, depth: Image, heights: FloatArray, radii: FloatArray) -> None:
    """Mix what lies far behind with white, little where the whole is only a few spheres deep."""
    nearest, span = float((heights + radii).max()), float(np.ptp(heights))
    strength = 0.45 * span / (span + 12 * float(radii.mean()))
    share = strength * np.clip((nearest - depth) / max(span, 1e-12), 0, 1)
    colour += share[:, None] * (1 - colour)


def _averaged(colour: Image, covered: NDArray[np.bool_], samples: int) -> Image:
    """Image (H, W, 4) from `samples`² points per pixel."""
    height, width = (length // samples for length in covered.shape)
    blocks = (height, samples, width, samples)
    opacity = covered.reshape(blocks).mean(axis=(1, 3), dtype=np.float32)
    total = colour.reshape(*blocks, 3).mean(axis=(1, 3), dtype=np.float32)
    return np.dstack([total / np.maximum(opacity, 1e-6)[..., None], opacity])
