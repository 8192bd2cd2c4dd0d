"""
Loads of a floc in shear
========================

Which contact of a floc carries most, and at what shear rate does it fail?

An open aggregate of 150 spheres, grown cluster by cluster, floats freely in water that is sheared. Contacts are red
where the flow pulls them apart and blue where it presses them together. The contact that fails first is rarely at the
rim: inner contacts hold together large parts, on which much of the flow pulls.
"""

from __future__ import annotations

from matplotlib.figure import Figure

import rheoclast as rc
from rheoclast import view

FLOW = rc.simple_shear(rate=1e5)


def loaded_floc() -> tuple[rc.Aggregate, rc.ContactLoads, rc.Initiation]:
    """A floc, what its contacts carry in the flow, and the failure that comes first as the rate is raised."""
    floc = rc.generation.cluster_cluster(150, radius=0.5e-6, seed=11)
    bonds = rc.jkr_bonds(floc, rc.MATERIALS["polystyrene"])
    response = rc.rigid_response(floc.spheres, rc.StokesianDynamics(), viscosity=1e-3)
    table = rc.contact_response(floc, response, bonds)
    return floc, table.loads(FLOW), rc.initiation(table, bonds, FLOW)


def loads_of_a_floc_in_shear() -> Figure:
    """The floc with its contacts coloured by tension, and the critical one ringed."""
    floc, carried, first = loaded_floc()
    print(f"largest tension {carried.tension.max():.3g} N, largest bending {carried.bending.max():.3g} N m")
    print(f"contact {first.contact} fails first, by {first.criterion}, at {first.rate:.3g} 1/s")
    return view.draw(floc, carried.tension, flow=FLOW, critical=first.contact)


if __name__ == "__main__":
    loads_of_a_floc_in_shear().savefig("loads_of_a_floc_in_shear.png")
