"""The load that every contact carries."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from rheoclast import _checks
from rheoclast._checks import FloatArray, IntArray
from rheoclast.frames.springs import spring_frame
from rheoclast.frames.statics import tree_loads
from rheoclast.loads import SphereLoads
from rheoclast.mechanics.bonds import Bonds
from rheoclast.particles.aggregate import Aggregate
from rheoclast.vectors import LEVI_CIVITA

Method = Literal["auto", "statics", "springs"]
BALANCE_TOLERANCE = 1e-8


@dataclass(frozen=True, eq=False)
class ContactLoads:
    """Force and moment in every contact.

    Attributes
    ----------
    normals
        (C, 3) unit vectors from sphere i to sphere j of each contact.
    force
        (C, 3), or (..., C, 3) for a batch: what sphere j exerts on sphere i, in N.
    moment
        Same shape: the same about the contact point, in N m.
    """

    normals: FloatArray
    force: FloatArray
    moment: FloatArray

    def __post_init__(self) -> None:
        normals = _checks.real_array("normals", self.normals, ("C", 3))
        object.__setattr__(self, "normals", normals)
        for name in ("force", "moment"):
            array = getattr(self, name)
            shape = (*np.shape(array)[:-2], *normals.shape)
            object.__setattr__(self, name, _checks.real_array(name, array, shape))

    @property
    def tension(self) -> FloatArray:
        """Normal force (..., C) in N, positive when the contact is pulled apart."""
        return np.sum(self.normals * self.force, axis=-1)

    @property
    def shear(self) -> FloatArray:
        """Magnitude (..., C) in N of the force across the normal."""
        return np.linalg.norm(np.cross(self.normals, self.force), axis=-1)

    @property
    def bending(self) -> FloatArray:
        """Magnitude (..., C) in N m of the moment across the normal."""
        return np.linalg.norm(np.cross(self.normals, self.moment), axis=-1)

    @property
    def twisting(self) -> FloatArray:
        """Moment (..., C) in N m about the normal, positive when right-handed about n on sphere i."""
        return np.sum(self.normals * self.moment, axis=-1)


def contact_loads(
    aggregate: Aggregate, loads: SphereLoads, bonds: Bonds | None = None, method: Method = "auto"
) -> ContactLoads:
    """Force and moment in every contact of an aggregate under balanced loads.

    Parameters
    ----------
    aggregate
        Spheres and contacts.
    loads
        Force and torque on every sphere, (..., N, 3). Their totals must vanish, as for a freely suspended aggregate.
    bonds
        Stiffness of the contacts. It decides how loops share the load; a tree does not need it. Stiffnesses (bending
        and twisting over a²) up to ten decades apart are shared to six digits or more.
    method
        "statics" from balance alone (trees), "springs" from the stiffness of the contacts, "auto" chooses statics for
        a tree.

    Raises
    ------
    ValueError
        If there is no contact, the loads do not match the spheres or do not balance, the bonds do not match the
        contacts, or loops are to be solved without bonds.
    ArithmeticError
        If springs are so soft, or a chain so long (thousands of spheres in line), that balance is not reached.
    """
    check_loads(aggregate, loads)
    by_statics = _by_statics(aggregate, bonds, method)
    stiffness = None if bonds is None else dimensionless_stiffness(aggregate, bonds)
    geometry = dimensionless_geometry(aggregate)
    cases, size = dimensionless_cases(aggregate, loads)
    if by_statics or stiffness is None:
        carried = tree_loads(*geometry, cases)
    else:
        carried = spring_frame(*geometry, stiffness).joint_loads(cases)
    return dimensional_loads(aggregate, carried, size, loads.force.shape[:-2])


def dimensionless_geometry(aggregate: Aggregate) -> tuple[FloatArray, IntArray, FloatArray]:
    """Centres (N, 3), pairs (C, 2) and contact points (C, 3), lengths in mean radii from the centre of mass."""
    length, origin = aggregate.spheres.mean_radius, aggregate.spheres.center_of_mass
    return (aggregate.spheres.centers - origin) / length, aggregate.pairs, (aggregate.contact_points - origin) / length


def dimensionless_stiffness(aggregate: Aggregate, bonds: Bonds) -> FloatArray:
    """Stiffness (C, 4) of the contacts in mean radii and mean normal stiffnesses."""
    length = aggregate.spheres.mean_radius
    stiffness = bonds.stiffness(len(aggregate.pairs)) / [1, 1, length**2, length**2]
    return stiffness / stiffness[:, 0].mean()


def dimensionless_cases(aggregate: Aggregate, loads: SphereLoads) -> tuple[FloatArray, FloatArray]:
    """Load cases (N, 6, K) in units of each case's largest load, and that size (K,) in N."""
    cases = np.concatenate([loads.force, loads.torque / aggregate.spheres.mean_radius], axis=-1)
    cases = cases.reshape(-1, *cases.shape[-2:]).transpose(1, 2, 0)
    size = np.abs(cases).max(axis=(0, 1))
    size[size == 0] = 1.0
    return cases / size, size


def dimensional_loads(
    aggregate: Aggregate, carried: FloatArray, size: FloatArray, batch: tuple[int, ...]
) -> ContactLoads:
    """Loads (..., C) of the contacts from joint loads (C, 6, K) in units of each case's size (K,) in N."""
    cases = (size * carried).transpose(2, 0, 1)
    shape = (*batch, len(carried), 3)
    force, moment = cases[..., :3].reshape(shape), aggregate.spheres.mean_radius * cases[..., 3:].reshape(shape)
    return ContactLoads(aggregate.normals, force, moment)


def _by_statics(aggregate: Aggregate, bonds: Bonds | None, method: Method) -> bool:
    if method not in ("auto", "statics", "springs"):
        raise ValueError(f"method: expected 'auto', 'statics' or 'springs', got {method!r}")
    degree = aggregate.hyperstaticity
    if method == "statics" and degree:
        raise ValueError(
            f"method='statics' needs a tree, but the contacts close loops (hyperstaticity {degree}); use 'springs'"
        )
    if bonds is None and (degree or method == "springs"):
        purpose = f"share the load among loops (hyperstaticity {degree})" if degree else "solve by springs"
        raise ValueError(f"bonds: needed to {purpose}, got none; give for instance jkr_bonds(aggregate, material)")
    return method == "statics" or (method == "auto" and degree == 0)


def check_loads(aggregate: Aggregate, loads: SphereLoads) -> None:
    """Refuse loads that do not belong to the spheres or do not balance, and a single sphere."""
    _checks.instance("aggregate", aggregate, Aggregate, "for instance Aggregate.touching(spheres)")
    _checks.instance("loads", loads, SphereLoads, "for instance response.loads(flow)")
    refuse_single_sphere(aggregate)
    if loads.force.shape[-2] != len(aggregate):
        raise ValueError(f"loads: expected one per sphere ({len(aggregate)}), got {loads.force.shape[-2]}")
    _refuse_unbalanced(aggregate.spheres.centers - aggregate.spheres.center_of_mass, loads)


def refuse_single_sphere(aggregate: Aggregate) -> None:
    """Refuse an aggregate without contacts."""
    if len(aggregate.pairs) == 0:
        raise ValueError("the aggregate is a single sphere and has no contact; expected at least two touching spheres")


def _refuse_unbalanced(arms: FloatArray, loads: SphereLoads) -> None:
    extent = np.linalg.norm(arms, axis=1).max()
    force_size = np.linalg.norm(loads.force, axis=-1).sum(axis=-1)
    torque_size = np.linalg.norm(loads.torque, axis=-1).sum(axis=-1) + extent * force_size
    force = loads.force.sum(axis=-2)
    torque = loads.torque.sum(axis=-2) + np.einsum("ijk,...jk->...i", LEVI_CIVITA, arms.T @ loads.force)  # Σ x × F
    rounding = len(arms) * loads.rounding
    for name, resultant, size, slack in (
        ("force", force, force_size, rounding),
        ("torque", torque, torque_size, extent * rounding),
    ):
        total, gross = np.ravel(np.linalg.norm(resultant, axis=-1)), np.ravel(size)
        unbalanced = np.flatnonzero(total > BALANCE_TOLERANCE * gross + slack)
        if len(unbalanced):
            case = int(unbalanced[0])
            which = f" of case {case}" if len(total) > 1 else ""
            raise ValueError(
                f"loads{which}: expected a total {name} of zero, "
                f"got {total[case]:.3g} against {gross[case]:.3g} in all; "
                "use the loads of the free aggregate, response.loads(flow) or settling(force).net_loads"
            )
