"""Spheres of an aggregate that roll over their neighbours towards the centre of mass. Compiled by Numba.

Lengths are in sphere radii. A sphere moves only if the rest holds together without it, and only to a place in contact
with other spheres, so that the aggregate is connected, touching and free of overlap after every move.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from rheoclast._checks import FloatArray, IntArray
from rheoclast.generation._pockets import REACH, distance2, is_clear, touching_places

TOUCH = (2 + 1e-9) ** 2
NEIGHBORHOOD = 6.0**2
"""Squared distance over which a move can open or close a place: two radii to a mate and four to what touches both."""
MOST_TOUCHING = 12
MOST_NEAR = 125
"""By volume: unit spheres with centres within 4 radii lie in a ball of 5."""
HELD = 4
"""Contacts from which a sphere does not roll: the place it finds has three, in general."""
APPROACH = 0.01
"""Least approach to the centre of mass in one move, in radii."""
SHUFFLE = 2.0
"""Largest random length, in radii, in the order of the spheres."""
TILT = 1e-3
"""Of the direction in which a sphere rolls onto a second one: decides where symmetry leaves it open."""


class Neighbors(NamedTuple):
    """Of each of N spheres, the first `number` (N,) of `indices` (N, M): spheres within a squared distance `reach2`."""

    indices: IntArray
    number: IntArray
    reach2: float


class Assembly(NamedTuple):
    """Centres (N, 3), their mean (3,), the spheres that touch each, and those that a third sphere can touch with it.

    A settled sphere could not roll, and no sphere near it has moved since.
    """

    centers: FloatArray
    middle: FloatArray
    touching: Neighbors
    near: Neighbors
    settled: NDArray[np.bool_]


class Moves(NamedTuple):
    """Spheres (M,) moved one after the other, the places (M, 3) they went to, and the `extent` (M, 2) after each."""

    spheres: IntArray
    places: FloatArray
    extents: FloatArray


@njit(cache=True)
def assembled(centers: FloatArray) -> Assembly:
    """Assembly of spheres at given centres, all that touch being in contact."""
    count = len(centers)
    middle = np.zeros(3)
    for i in range(count):
        middle += centers[i] / count
    touching = Neighbors(np.zeros((count, MOST_TOUCHING), np.intp), np.zeros(count, np.intp), TOUCH)
    near = Neighbors(np.zeros((count, MOST_NEAR), np.intp), np.zeros(count, np.intp), REACH**2)
    for i in range(count):
        _attach(touching, centers, i, i)
        _attach(near, centers, i, i)
    return Assembly(centers, middle, touching, near, np.zeros(count, np.bool_))


@njit(cache=True)
def extent(assembly: Assembly) -> FloatArray:
    """Number of contacts, and radius of gyration of the centres."""
    total = 0.0
    for i in range(len(assembly.centers)):
        total += distance2(assembly.centers[i], assembly.middle)
    return np.array([assembly.touching.number.sum() / 2, math.sqrt(total / len(assembly.centers))])


@njit(cache=True)
def roll_all(assembly: Assembly, rng: np.random.Generator) -> Moves:
    """Let each sphere roll that can, inner ones first, lest others bury them before they do."""
    order = _inner_first(assembly, rng)
    moves, moved = Moves(order, np.empty((len(order), 3)), np.empty((len(order), 2))), 0
    for sphere in order.copy():
        if _roll(assembly, sphere, rng):
            _note(moves, moved, assembly, sphere)
            moved += 1
    return Moves(moves.spheres[:moved], moves.places[:moved], moves.extents[:moved])


@njit(cache=True)
def transfer_outermost(assembly: Assembly, wanted: int) -> Moves:
    """Transfer the spheres farthest from the centre of mass to the nearest sphere that offers them a place.

    They lose whatever contacts they have. Where the farthest finds no place nearer to the centre of mass, the next ones
    find none either. All spheres count as unsettled again: what they may do also depends, if seldom, on moves far away.
    """
    order = _outermost(assembly, wanted)
    moves, moved = Moves(order, np.empty((len(order), 3)), np.empty((len(order), 2))), 0
    assembly.settled[:] = False
    for sphere in order.copy():
        if not _transfer(assembly, sphere):
            break
        _note(moves, moved, assembly, sphere)
        moved += 1
    return Moves(moves.spheres[:moved], moves.places[:moved], moves.extents[:moved])


@njit(cache=True)
def _note(moves: Moves, moved: int, assembly: Assembly, sphere: int) -> None:
    moves.spheres[moved] = sphere
    moves.places[moved] = assembly.centers[sphere]
    moves.extents[moved] = extent(assembly)


@njit(cache=True)
def _inner_first(assembly: Assembly, rng: np.random.Generator) -> IntArray:
    """All spheres by distance from the centre of mass, to which each adds a random length."""
    keys = np.empty(len(assembly.centers))
    for i in range(len(keys)):
        keys[i] = math.sqrt(distance2(assembly.centers[i], assembly.middle)) + SHUFFLE * rng.random()
    return np.argsort(keys)


@njit(cache=True)
def _roll(assembly: Assembly, sphere: int, rng: np.random.Generator) -> bool:
    """Let a loosely held sphere roll over a neighbour into a pocket, or a hanging one onto a second neighbour."""
    contacts = assembly.touching.number[sphere]
    if contacts >= HELD or assembly.settled[sphere]:
        return False
    assembly.settled[sphere] = True
    if not _is_dispensable(assembly, sphere):
        return False
    place, mates = np.empty(3), assembly.touching.indices[sphere, :contacts]
    finds_pocket = _find_pocket(assembly, sphere, mates, place)
    if finds_pocket or (contacts == 1 and _find_saddle(assembly, sphere, mates[0], rng, place)):
        _move(assembly, sphere, place)
        return True
    return False


@njit(cache=True)
def _transfer(assembly: Assembly, sphere: int) -> bool:
    """Move a sphere to a pocket on the sphere nearest to it that offers one."""
    if not _is_dispensable(assembly, sphere):
        return False
    place = np.empty(3)
    distances = np.empty(len(assembly.centers))
    for i in range(len(distances)):
        distances[i] = distance2(assembly.centers[i], assembly.centers[sphere])
    order = np.argsort(distances)
    for k in range(1, len(order)):
        if _find_pocket(assembly, sphere, order[k : k + 1], place):
            _move(assembly, sphere, place)
            return True
    return False


@njit(cache=True)
def _outermost(assembly: Assembly, wanted: int) -> IntArray:
    """Those spheres farthest from the centre of mass, farthest first, without which the rest holds together."""
    distances = np.empty(len(assembly.centers))
    for i in range(len(distances)):
        distances[i] = distance2(assembly.centers[i], assembly.middle)
    chosen, found = np.empty(wanted, np.intp), 0
    for sphere in np.argsort(-distances):
        if found < wanted and _is_dispensable(assembly, sphere):
            chosen[found] = sphere
            found += 1
    return chosen[:found]


@njit(cache=True)
def _is_dispensable(assembly: Assembly, sphere: int) -> bool:
    """Whether the other spheres hold together without this one: its neighbours are all reached from the first."""
    mates, number, _ = assembly.touching
    missing = number[sphere] - 1
    if missing <= 0:
        return missing == 0
    seen, queue, head, tail = np.zeros(len(number), np.bool_), np.empty(len(number), np.intp), 0, 1
    queue[0] = mates[sphere, 0]
    seen[sphere] = seen[queue[0]] = True
    while head < tail and missing:
        here = queue[head]
        head += 1
        for k in range(number[here]):
            mate = mates[here, k]
            if not seen[mate]:
                seen[mate] = True
                missing -= distance2(assembly.centers[mate], assembly.centers[sphere]) <= TOUCH
                queue[tail] = mate
                tail += 1
    return missing == 0


@njit(cache=True)
def _find_pocket(assembly: Assembly, sphere: int, supports: IntArray, place: FloatArray) -> bool:
    """Whether a place on one of `supports` and two more is nearer to the centre of mass; `place` gets the nearest."""
    centers, middle = assembly.centers, assembly.middle
    farthest = max(0.0, math.sqrt(distance2(centers[sphere], middle)) - APPROACH)
    nearest = before = farthest**2
    places = np.empty((2, 3))
    for support in supports:
        around = assembly.near.indices[support, : assembly.near.number[support]]
        for m in range(len(around)):
            for n in range(m):
                second, third = around[m], around[n]
                if sphere in (second, third):
                    continue
                if not touching_places(centers[support], centers[second], centers[third], places):
                    continue
                for side in range(2):
                    distance = distance2(places[side], middle)
                    if distance < nearest and is_clear(places[side], centers, around, sphere):
                        nearest = distance
                        for k in range(3):
                            place[k] = places[side, k]
    return nearest < before


@njit(cache=True)
def _find_saddle(assembly: Assembly, sphere: int, mate: int, rng: np.random.Generator, place: FloatArray) -> bool:
    """Whether a sphere can roll over its only mate onto a second one, nearer to the centre of mass; `place` gets where.

    Of the circle of places that touch both it takes the one on its own side; among several second ones, the nearest.
    """
    centers, middle = assembly.centers, assembly.middle
    around = assembly.near.indices[mate, : assembly.near.number[mate]]
    before = distance2(centers[sphere], middle)
    shortest, tried, side = np.inf, np.empty(3), np.empty(3)
    for second in around:
        if second == sphere:
            continue
        gap2 = distance2(centers[second], centers[mate])
        along = 0.0
        for k in range(3):
            side[k] = centers[sphere, k] - centers[mate, k] + TILT * rng.standard_normal()
            along += side[k] * (centers[second, k] - centers[mate, k]) / gap2
        for k in range(3):
            side[k] -= along * (centers[second, k] - centers[mate, k])
        height = math.sqrt((4 - gap2 / 4) / (side[0] ** 2 + side[1] ** 2 + side[2] ** 2))
        for k in range(3):
            tried[k] = 0.5 * (centers[mate, k] + centers[second, k]) + height * side[k]
        step = distance2(tried, centers[sphere])
        if step < shortest and distance2(tried, middle) < before and is_clear(tried, centers, around, sphere):
            shortest = step
            for k in range(3):
                place[k] = tried[k]
    return shortest < np.inf


@njit(cache=True)
def _move(assembly: Assembly, sphere: int, place: FloatArray) -> None:
    """Put a sphere elsewhere; the centre of mass and the neighbours follow."""
    centers, middle, touching, near, settled = assembly
    for i in range(len(centers)):
        if distance2(centers[i], centers[sphere]) < NEIGHBORHOOD or distance2(centers[i], place) < NEIGHBORHOOD:
            settled[i] = False
    for k in range(3):
        middle[k] += (place[k] - centers[sphere, k]) / len(centers)
        centers[sphere, k] = place[k]
    for neighbors in (touching, near):
        _detach(neighbors, sphere)
        _attach(neighbors, centers, sphere, len(centers))


@njit(cache=True)
def _detach(neighbors: Neighbors, sphere: int) -> None:
    """Take a sphere out of the lists of its neighbours, and them out of its own."""
    indices, number, _ = neighbors
    for k in range(number[sphere]):
        mate = indices[sphere, k]
        number[mate] -= 1
        last = indices[mate, number[mate]]
        for m in range(number[mate]):
            if indices[mate, m] == sphere:
                indices[mate, m] = last
    number[sphere] = 0


@njit(cache=True)
def _attach(neighbors: Neighbors, centers: FloatArray, sphere: int, among: int) -> None:
    """List a sphere that has no neighbours yet, and those it has among the first ones, as each other's."""
    indices, number, reach2 = neighbors
    for i in range(among):
        if i != sphere and distance2(centers[i], centers[sphere]) <= reach2:
            indices[sphere, number[sphere]] = i
            indices[i, number[i]] = sphere
            number[sphere] += 1
            number[i] += 1
