"""What can go wrong, said so that the reader knows what to do.

Every message names the thing, the value, what was expected and the remedy. The library raises; only the command line
and the viewer talk.
"""

from __future__ import annotations

from pathlib import Path


class HexmendError(Exception):
    """Root of every error that Hexmend raises on purpose."""


class MeshError(HexmendError):
    """A mesh that cannot be what it claims to be: a node number out of range, a coordinate that is no number."""


class ParameterError(HexmendError):
    """A parameter's name or value that its declaration does not admit."""


class InstallationError(HexmendError, ImportError):
    """A part of Hexmend that is not installed, or not built."""


class InsufficientMemoryError(HexmendError):
    """A run that needs more memory than there is."""


class FileError(HexmendError):
    """A file that cannot be read, written or used.

    Parameters
    ----------
    path : path-like
        The file; the message begins with its name.
    problem : str
        What is wrong and where in the file: the line, the section, the cell.
    remedy : str
        What the reader can do about it, as a sentence.

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
        super().__init__(f"{self.path.name}: {self.problem}{end} {remedy}".rstrip())
