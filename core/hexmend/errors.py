"""Errors that Hexmend raises on purpose.

Every message names the object, the value, the expectation and the remedy. The library raises; only the command line and
the viewer print.
"""

from __future__ import annotations

from pathlib import Path


class HexmendError(Exception):
    """Base class of every error that Hexmend raises on purpose."""


class MeshError(HexmendError):
    """Invalid mesh data, such as a node number out of range or a coordinate that is not finite."""


class ParameterError(HexmendError):
    """Name or value of a parameter that its declaration does not allow."""


class InstallationError(HexmendError, ImportError):
    """Part of Hexmend that is not installed, or not built."""


class InsufficientMemoryError(HexmendError):
    """Run that needs more memory than is available."""


class FileError(HexmendError):
    """File that cannot be read, written or used.

    Parameters
    ----------
    path : path-like
        Path of the file; the message begins with its name.
    problem : str
        Description of the problem and its location in the file: line, section or cell.
    remedy : str
        Advice as a sentence.

    Examples
    --------
    >>> str(FileError("dir/five.vtk", "cell 12 is a VTK_WEDGE", "Convert the cell to a hexahedron."))
    'five.vtk: cell 12 is a VTK_WEDGE. Convert the cell to a hexahedron.'
    """

    def __init__(self, path: str | Path, problem: str, remedy: str = ""):
        self.path = Path(path)
        self.problem = problem.rstrip(".")
        self.remedy = remedy
        end = "" if self.problem.endswith("?") else "."
        super().__init__(f"{self.path.name or self.path}: {self.problem}{end} {remedy}".rstrip())
