"""Force, torque and stresslet of spheres by Faxén's laws: order 2 in closed form.

Cartesian tensors, viscosity 1, written apart from the package. A sphere j with force F, torque L and stresslet S on
the fluid makes the flow 8π u_i = (1 + a²/6 ∇²) G_ij F_j + ½ ε_jkl ∂_k G_ij L_l − (1 + a²/10 ∇²) ∂_k G_ij S_jk, with
G the Oseen tensor of r = x − x_j; in a flow u, sphere i moves with U = (1 + a²/6 ∇²) u, Ω = ½ ∇ × u and strains with
E = (1 + a²/10 ∇²) sym ∇u. ∇⁴ G = 0, so that the two Laplacians of a pair add.
"""

from functools import reduce
from itertools import permutations
from math import factorial

import numpy as np

from rheoclast.vectors import LEVI_CIVITA, STRAIN_BASIS


def derivative_of_power(power, order, vector):
    """All derivatives of the given order of r^power at one vector (3,): a tensor of that rank.

    With φ_0 = r^q and φ_(k+1) = φ_k'/r = q (q−2) … (q−2k) r^(q−2k−2), the derivative of order n is the sum over s of
    φ_(n−s) times the sum of all distinct products of s unit tensors and n − 2s vectors: each stands 2^s s! (n−2s)!
    times among the n! orders of the axes.
    """
    distance = np.linalg.norm(vector)
    tensor = np.zeros((3,) * order)
    for deltas in range(order // 2 + 1):
        steps = order - deltas
        ladder = np.prod(power - 2.0 * np.arange(steps)) * distance ** (power - 2 * steps)
        product = reduce(np.multiply.outer, [np.eye(3)] * deltas + [vector] * (order - 2 * deltas), np.array(1.0))
        alike = 2**deltas * factorial(deltas) * factorial(order - 2 * deltas)
        tensor += ladder / alike * sum(np.transpose(product, axes) for axes in permutations(range(order)))
    return tensor


def oseen_derivative(order, vector):
    """Derivatives of G_ij = δ_ij ∇²r − ∂_i ∂_j r of the given order; axes i, j, then the derivatives."""
    plain = np.multiply.outer(np.eye(3), 2 * derivative_of_power(-1, order, vector))
    return plain - derivative_of_power(1, order + 2, vector)


def oseen_laplacian_derivative(order, vector):
    """Derivatives of ∇²G_ij = −2 ∂_i ∂_j (1/r) of the given order; axes as in `oseen_derivative`."""
    return -2 * derivative_of_power(-1, order + 2, vector)


def pair_block(vector, target_radius, source_radius):
    """(11, 11): motion of the target sphere from loads of the source sphere; `vector` from source to target."""
    a2, b2 = target_radius**2, source_radius**2

    def corrected(order, factor):
        return oseen_derivative(order, vector) + factor * oseen_laplacian_derivative(order, vector)

    spin = 0.5 * LEVI_CIVITA
    block = np.empty((11, 11))
    block[:3, :3] = corrected(0, a2 / 6 + b2 / 6)
    once = oseen_derivative(1, vector)
    block[:3, 3:6] = np.einsum("jkl,ijk->il", spin, once)
    block[3:6, :3] = np.einsum("lki,ijk->lj", spin, once)
    block[:3, 6:] = -np.einsum("ijk,sjk->is", corrected(1, a2 / 6 + b2 / 10), STRAIN_BASIS)
    block[6:, :3] = np.einsum("ijk,sik->sj", corrected(1, a2 / 10 + b2 / 6), STRAIN_BASIS)
    twice = oseen_derivative(2, vector)
    block[3:6, 3:6] = np.einsum("mpi,jkl,ijkp->ml", spin, spin, twice)
    block[3:6, 6:] = -np.einsum("mpi,ijkp,sjk->ms", spin, twice, STRAIN_BASIS)
    block[6:, 3:6] = np.einsum("sip,jkl,ijkp->sl", STRAIN_BASIS, spin, twice)
    block[6:, 6:] = -np.einsum("sip,ijkp,tjk->st", STRAIN_BASIS, corrected(2, a2 / 10 + b2 / 10), STRAIN_BASIS)
    return block / (8 * np.pi)


def own_block(radius):
    """(11, 11): motion of a lone sphere from its own loads on the fluid, Stokes 6πa, 8πa³, 20/3 πa³."""
    translation, rotation, strain = 6 * np.pi * radius, 8 * np.pi * radius**3, 20 / 3 * np.pi * radius**3
    return np.diag(1 / np.repeat([translation, rotation, strain], [3, 3, 5]))


def grand_mobility(centers, radii):
    """(N, 11, N, 11): motions of all spheres from the loads of all on the fluid."""
    count = len(centers)
    mobility = np.empty((count, 11, count, 11))
    for i in range(count):
        mobility[i, :, i] = own_block(radii[i])
        for j in range(count):
            if i != j:
                mobility[i, :, j] = pair_block(centers[i] - centers[j], radii[i], radii[j])
    return mobility


def probes(count):
    """(N, 11, 11): at order 2 the modes are the loads themselves."""
    return np.broadcast_to(np.eye(11), (count, 11, 11))
