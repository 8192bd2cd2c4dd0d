"""Exceptions and warnings that a caller may want to tell apart."""


class GeometryError(ValueError):
    """The spheres do not form the rigid aggregate that was asked for: they overlap or fall apart."""


class FileFormatError(ValueError):
    """A file cannot be understood; the message names the file and, where there is one, the line."""


class UnitWarning(UserWarning):
    """A length is so large or small, or a viscosity so large, that its unit is probably wrong."""


class GeometryWarning(UserWarning):
    """Contacts reach across gaps so wide that the spheres in them are probably not those that touch."""
