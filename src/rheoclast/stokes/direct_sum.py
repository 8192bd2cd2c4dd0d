"""Direct sums at order 2, force, torque and stresslet in closed form (Faxén), compiled by Numba.

Arrays are stored component by component with the spheres last, so that the innermost loop runs over source spheres in
contiguous memory and vectorizes. It runs over slices of one component each and counts from zero: an index that the
compiler must suspect of being negative, or a slice of several components, turns every load into a gather and halves the
speed. Tensors that are symmetric and traceless are given by xx, xy, xz, yy, yz.
"""

from __future__ import annotations

import numpy as np
from numba import njit, prange

from rheoclast._checks import FloatArray, IntArray


@njit(parallel=True, fastmath=True, error_model="numpy", cache=True)
def pair_velocities(
    centers: FloatArray,
    radii: FloatArray,
    loads: FloatArray,
    group: IntArray,
    first_range: IntArray,
    ranges: IntArray,
    out: FloatArray,
) -> None:
    """Add 8π times the motion of every sphere in the flow of the loads on other spheres to `out`.

    With d = x_i − x_j, r = |d| and radii a, b of target and source, the flow is (1 + b²/6 ∇²) G·F + T × d / r³
    − (1 + b²/10 ∇²) ∇G : S, and the target's motion (1 + a²/6 ∇²) u, ½ ∇ × u, (1 + a²/10 ∇²) sym ∇u
    (Kim & Karrila 1991, sections 2.5, 3.2 and 3.5).

    Parameters
    ----------
    centers, radii
        (3, N) and (N,).
    loads
        (K, 11, N) force, torque and stresslet on the fluid.
    group
        (N,) group of every target sphere.
    first_range, ranges
        Source spheres of group g are those of the half-open ranges `ranges[first_range[g]:first_range[g + 1]]`, (R, 2).
    out
        (K, 11, N) velocity, angular velocity and strain rate.
    """
    count = radii.size
    for i in prange(count):
        xi, yi, zi, ai = centers[0, i], centers[1, i], centers[2, i], radii[i] ** 2
        for k in range(loads.shape[0]):
            ux = uy = uz = wx = wy = wz = exx = exy = exz = eyy = eyz = 0.0
            for part in range(first_range[group[i]], first_range[group[i] + 1]):
                first, end = ranges[part, 0], ranges[part, 1]
                x, y, z, b = centers[0, first:end], centers[1, first:end], centers[2, first:end], radii[first:end]
                load = loads[k]
                force_x, force_y, force_z = load[0, first:end], load[1, first:end], load[2, first:end]
                torque_x, torque_y, torque_z = load[3, first:end], load[4, first:end], load[5, first:end]
                xx, xy, xz = load[6, first:end], load[7, first:end], load[8, first:end]
                yy, yz = load[9, first:end], load[10, first:end]
                for j in range(end - first):
                    dx, dy, dz = xi - x[j], yi - y[j], zi - z[j]
                    inverse = 0.0 if j == i - first else 1.0 / np.sqrt(dx * dx + dy * dy + dz * dz)
                    g2 = inverse * inverse
                    g3 = inverse * g2
                    g5 = g3 * g2
                    g7 = g5 * g2
                    bj = b[j] ** 2
                    fx, fy, fz = force_x[j], force_y[j], force_z[j]
                    tx, ty, tz = torque_x[j], torque_y[j], torque_z[j]
                    sxx, sxy, sxz, syy, syz = xx[j], xy[j], xz[j], yy[j], yz[j]
                    px = sxx * dx + sxy * dy + sxz * dz
                    py = sxy * dx + syy * dy + syz * dz
                    pz = sxz * dx + syz * dy - (sxx + syy) * dz
                    df = dx * fx + dy * fy + dz * fz
                    dt = dx * tx + dy * ty + dz * tz
                    dp = dx * px + dy * py + dz * pz
                    cx, cy, cz = ty * dz - tz * dy, tz * dx - tx * dz, tx * dy - ty * dx
                    both = ai + bj
                    size = ai / 6 + bj / 10
                    along = (g3 - both * g5) * df + (3 * g5 - 30 * size * g7) * dp
                    force, bend = inverse + both / 3 * g3, 12 * size * g5
                    ux += force * fx + along * dx + g3 * cx + bend * px
                    uy += force * fy + along * dy + g3 * cy + bend * py
                    uz += force * fz + along * dz + g3 * cz + bend * pz
                    spin, turn = 1.5 * g5 * dt, 0.5 * g3
                    vx, vy, vz = g3 * fx + 3 * g5 * px, g3 * fy + 3 * g5 * py, g3 * fz + 3 * g5 * pz
                    wx += vy * dz - vz * dy + spin * dx - turn * tx
                    wy += vz * dx - vx * dz + spin * dy - turn * ty
                    wz += vx * dy - vy * dx + spin * dz - turn * tz
                    back, both = ai / 10 + bj / 6, both / 10
                    outer = (30 * back * g7 - 3 * g5) * df + (210 * both * g7 * g2 - 15 * g7) * dp
                    round_ = (g3 - 6 * back * g5) * df + (3 * g5 - 30 * both * g7) * dp
                    by_force, by_bend, own = 6 * back * g5, 3 * g5 - 60 * both * g7, 12 * both * g5
                    vx = by_bend * px - by_force * fx - 1.5 * g5 * cx + 0.5 * outer * dx
                    vy = by_bend * py - by_force * fy - 1.5 * g5 * cy + 0.5 * outer * dy
                    vz = by_bend * pz - by_force * fz - 1.5 * g5 * cz + 0.5 * outer * dz
                    exx += 2 * dx * vx + round_ + own * sxx
                    exy += dx * vy + dy * vx + own * sxy
                    exz += dx * vz + dz * vx + own * sxz
                    eyy += 2 * dy * vy + round_ + own * syy
                    eyz += dy * vz + dz * vy + own * syz
            out[k, 0, i] += ux
            out[k, 1, i] += uy
            out[k, 2, i] += uz
            out[k, 3, i] += wx
            out[k, 4, i] += wy
            out[k, 5, i] += wz
            out[k, 6, i] += exx
            out[k, 7, i] += exy
            out[k, 8, i] += exz
            out[k, 9, i] += eyy
            out[k, 10, i] += eyz


@njit(parallel=True, fastmath=True, error_model="numpy", cache=True)
def force_velocities(
    centers: FloatArray,
    radii: FloatArray,
    loads: FloatArray,
    group: IntArray,
    first_range: IntArray,
    ranges: IntArray,
    out: FloatArray,
) -> None:
    """The part of `pair_velocities` from force to velocity, which is all of order 1: loads and out are (K, 3, N)."""
    for i in prange(radii.size):
        xi, yi, zi, ai = centers[0, i], centers[1, i], centers[2, i], radii[i] ** 2
        for k in range(loads.shape[0]):
            ux = uy = uz = 0.0
            for part in range(first_range[group[i]], first_range[group[i] + 1]):
                first, end = ranges[part, 0], ranges[part, 1]
                x, y, z, b = centers[0, first:end], centers[1, first:end], centers[2, first:end], radii[first:end]
                force_x, force_y, force_z = loads[k, 0, first:end], loads[k, 1, first:end], loads[k, 2, first:end]
                for j in range(end - first):
                    dx, dy, dz = xi - x[j], yi - y[j], zi - z[j]
                    inverse = 0.0 if j == i - first else 1.0 / np.sqrt(dx * dx + dy * dy + dz * dz)
                    g2 = inverse * inverse
                    g3 = inverse * g2
                    both = ai + b[j] ** 2
                    fx, fy, fz = force_x[j], force_y[j], force_z[j]
                    along = (g3 - both * g3 * g2) * (dx * fx + dy * fy + dz * fz)
                    force = inverse + both / 3 * g3
                    ux += force * fx + along * dx
                    uy += force * fy + along * dy
                    uz += force * fz + along * dz
            out[k, 0, i] += ux
            out[k, 1, i] += uy
            out[k, 2, i] += uz
