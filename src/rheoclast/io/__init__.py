"""Files: aggregates are read and written, tables written."""

from rheoclast.io.reading import read, read_spheres
from rheoclast.io.writing import write, write_table

__all__ = ["read", "read_spheres", "write", "write_table"]
