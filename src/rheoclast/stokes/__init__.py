"""Stokes flow around rigid spheres as one hierarchy of multipoles: arrays in, arrays out, unit viscosity."""
