"""Formats that the library meshlane reads and writes: XDMF, Tecplot, AVS-UCD and Netgen."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from importlib import import_module
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import from_mesh, to_mesh
from hexmend.io.base.cursor import quoted
from hexmend.io.base.fixed_marks import with_marks
from hexmend.io.base.format import Capability, register
from hexmend.io.base.lower_order import lost_mid_nodes, reduce_order
from hexmend.io.base.meshio_content import content_of, meshio_fields
from hexmend.io.base.remedies import DAMAGED
from hexmend.mesh.mesh import Mesh


@dataclass(frozen=True)
class LibraryFormat:
    """A format of meshlane.

    Parameters
    ----------
    title : str
    module : str
        Its module in meshlane.
    suffixes : tuple of str
    pattern : bytes
        Regular expression at the beginning of a file; files that do not have it are of another format.
    kinds : tuple of str
        Kinds of cells that are written; none for a format that is only read.
    kept : tuple of Capability
        What is kept besides the cells.
    options : tuple of (str, object)
        Arguments of the writer.
    """

    title: str
    module: str
    suffixes: tuple[str, ...]
    pattern: bytes
    kinds: tuple[str, ...] = ()
    kept: tuple[Capability, ...] = ()
    options: tuple[tuple[str, object], ...] = ()

    def read(self, path: Path) -> Mesh:
        """Read a file; whatever the library raises becomes a `FileError`."""
        with open(path, "rb") as file:
            head = file.read(1 << 16)
        if not self.matches(head) or b"<!DOCTYPE" in head or b"<!ENTITY" in head:
            raise FileError(path, f"does not begin like a file of {self.title}", "Check what it is, and its suffix.")
        content = self._guarded(path, "read as", lambda: content_of(self._library_mesh(path)))
        return to_mesh(path, content)

    def _library_mesh(self, path: Path) -> Any:
        """Read a mesh of the library, with three coordinates a node."""
        library = import_module(f"meshlane.{self.module}")
        in_memory = self.module != "xdmf"  # whose arrays may be in files beside it
        mesh = library.read(_Text(path.read_text("utf-8", errors="replace")) if in_memory else path)
        points = np.asarray(mesh.points, dtype=np.float64)
        if points.ndim != 2 or not 2 <= points.shape[1] <= 3:
            raise FileError(path, "has no nodes", DAMAGED)
        mesh.points = np.column_stack([points, np.zeros((len(points), 3 - points.shape[1]))])
        return mesh

    def write(self, path: Path, mesh: Mesh, encoding: str) -> None:
        """Write cells, and the data that the format has."""
        content = reduce_order(replace(from_mesh(mesh), node_data=with_marks(mesh)), self.kinds)
        points, cells, fields = meshio_fields(content)
        named = {"point_data": Capability.NODE_DATA, "cell_data": Capability.HEX_DATA}
        data = {name: fields[name] for name, kind in named.items() if kind in self.kept}
        own = import_module("meshlane").Mesh(points, cells, **data)
        library = import_module(f"meshlane.{self.module}")
        self._guarded(path, "written as", lambda: library.write(path, own, **dict(self.options)))

    def matches(self, head: bytes) -> bool:
        """Return True if a file begins as those of the format."""
        return re.match(self.pattern, head, re.IGNORECASE | re.DOTALL) is not None

    def _guarded(self, path: Path, verb: str, call: Callable[[], Any]) -> Any:
        """Call the library; exceptions of any type become a `FileError`."""
        try:
            return call()
        except (FileError, MemoryError, OSError):
            raise
        except (Exception, SystemExit) as error:
            detail = quoted(" ".join(str(error).split())[:20] or type(error).__name__)
            raise FileError(path, f"cannot be {verb} {self.title} ({detail})", DAMAGED) from None


class _Text(StringIO):
    """Text of a file whose end is an error where a reader goes on asking for lines."""

    n_ends = 0

    def readline(self, *size: int) -> str:
        """Read a line; raises `EOFError` when the end has been met several times."""
        line = super().readline(*size)
        self.n_ends += not line
        if self.n_ends > _MOST_ENDS:
            raise EOFError("it is cut short")
        return line


#: Lines that a reader may ask for at the end of a file.
_MOST_ENDS = 100
_LINEAR = ("hex", "tetra", "wedge", "pyramid", "quad", "triangle", "line", "vertex")
_CELLS = (Capability.VERTICES, Capability.LOWER_CELLS, Capability.OTHER_CELLS)
_DATA = (Capability.NODE_DATA, Capability.HEX_DATA, Capability.FIXED_NODES)
_COMMENTS = rb"(?:\s*#[^\n]*\n)*\s*"

_FORMATS = {
    "xdmf": LibraryFormat(
        "XDMF", "xdmf", (".xdmf", ".xmf"), rb"\s*(?:<\?xml[^>]*>\s*)?(?:<!--.*?-->\s*)*<Xdmf", _LINEAR[:-1],
        (*_CELLS[1:], *_DATA), (("data_format", "XML"),),
    ),
    "tecplot": LibraryFormat("Tecplot", "tecplot", (".tec",), _COMMENTS + rb"(?:TITLE|VARIABLES)\s*=", ("hex",)),
    "avsucd": LibraryFormat(
        "AVS-UCD", "avsucd", (".avs", ".ucd"), _COMMENTS + rb"\d+[ \t]+\d+[ \t]+\d+[ \t]+\d+[ \t]+\d+[ \t]*\r?\n",
        _LINEAR, _CELLS,
    ),
    "netgen": LibraryFormat("Netgen", "netgen", (".vol",), rb"\s*(?:#[^\n]*\n\s*)*mesh3d"),
}  # fmt: skip


def _limitations(format: LibraryFormat) -> Callable[[Mesh], list[str]]:
    return lambda mesh: lost_mid_nodes(mesh, format.kinds)


for _name, _format in _FORMATS.items():
    register(
        name=_name,
        title=_format.title,
        suffixes=_format.suffixes,
        encodings=("ascii",) if _format.kinds else (),
        read=_format.read,
        write=_format.write if _format.kinds else None,
        capabilities=frozenset(_format.kept),
        limitations=_limitations(_format),
        matches=_format.matches,
    )
