"""Files: aggregates are read and written, tables written."""

from rheoclast.io.histories import read_histories, write_histories
from rheoclast.io.kernel_files import write_kernel
from rheoclast.io.reading import read, read_spheres
from rheoclast.io.writing import write, write_table

__all__ = ["read", "read_histories", "read_spheres", "write", "write_histories", "write_kernel", "write_table"]
