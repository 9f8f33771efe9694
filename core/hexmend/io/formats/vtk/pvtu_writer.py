"""Writing of PVTU: pieces in a folder of their own, and then the file that names them.

Pieces are new files: no file is overwritten that the folder has, so that the file that is replaced is whole until the
new one is, and files of the same names that belong to others stay. The pieces of the file that is replaced are removed
if Hexmend has written them for it, which a comment in it says, and no other PVTU file of the folder names them.

Pieces number their nodes and cells by `NODE_ID` and `CELL_ID`, from which the order of the mesh is restored.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import chain, count
from os.path import realpath
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.capabilities import non_numeric_data
from hexmend.io.formats.vtk.grid import Grid, from_mesh
from hexmend.io.formats.vtk.merge_grids import CELL_ID, NODE_ID, piece_names
from hexmend.io.formats.vtk.vtu_writer import array_attributes, writable, write_grid
from hexmend.io.storage.atomic import atomic_write, check_writable
from hexmend.io.storage.temporary_files import flush_folder
from hexmend.mesh.mesh import Mesh

#: Characters that the name of a piece cannot have: those that XML or UTF-8 has not, and those of paths of Windows.
_UNSUITABLE = re.compile("[:\\\\\x00-\x1f\ud800-\udfff\ufffe\uffff]")
#: Comment of a PVTU file whose pieces Hexmend has written.
_OWN_PIECES = "<!-- Hexmend has written the pieces, and removes them with this file -->"


@dataclass(frozen=True)
class PieceFiles:
    """Names of the files of a PVTU file that is to be written.

    Parameters
    ----------
    path : Path
        The PVTU file.
    folder, prefix : str
        Piece k is the file `folder`/`prefix`k.vtu beside it.
    replaced : tuple of Path
        Pieces of the file that is replaced, which Hexmend has written for it and no other file names.
    """

    path: Path
    folder: str
    prefix: str
    replaced: tuple[Path, ...] = ()

    @classmethod
    def new(cls, path: Path) -> PieceFiles:
        """Choose names that no file has."""
        stem = _UNSUITABLE.sub("_", path.stem)
        stem = stem if stem.strip(".") else "mesh"
        folder = path.parent / stem
        there = [file.name for file in folder.iterdir()] if folder.is_dir() else []
        prefixes = (f"{stem}{end}_" for end in chain([""], (f"-{number}" for number in count(2))))
        free = next(
            prefix
            for prefix in prefixes
            if not any(re.fullmatch(re.escape(prefix) + r"\d+\.vtu", name, re.IGNORECASE) for name in there)
        )
        return cls(path, stem, free, tuple(_own_pieces(path, stem)))

    def name(self, k: int) -> str:
        """Return the name of a piece in the file."""
        return f"{self.folder}/{self.prefix}{k}.vtu"

    def piece(self, k: int) -> Path:
        """Return the path of a piece."""
        return self.path.parent / self.folder / f"{self.prefix}{k}.vtu"

    def make_folder(self) -> None:
        """Make the folder of the pieces.

        Raises
        ------
        FileError
            Where it cannot be made.
        """
        check_writable(self.path)
        folder = self.path.parent / self.folder
        try:
            folder.mkdir(exist_ok=True)
        except OSError as error:
            problem = f"cannot be written: its pieces need the folder {folder} ({error.strerror or error})"
            raise FileError(self.path, problem, "Check free space and permissions, or choose another name.") from None
        flush_folder(self.path.parent)

    def write_piece(self, k: int, grid: Grid, encoding: str = "binary") -> None:
        """Write a piece, whose node data and cell data have `NODE_ID` and `CELL_ID`."""
        with atomic_write(self.piece(k)) as temporary:
            write_grid(temporary, grid, encoding)

    def finish(self, count: int, grid: Grid) -> None:
        """Write the file that names the pieces and the arrays of each, and remove the pieces of an old file."""
        with atomic_write(self.path) as temporary:
            temporary.write_bytes(self._header(count, grid).encode("utf-8", "replace"))
        self.remove_replaced()

    def remove_replaced(self) -> None:
        """Remove the pieces of the file that is replaced; those that cannot be removed stay."""
        for piece in self.replaced:
            with suppress(OSError):
                piece.unlink()

    def discard(self, k: int) -> None:
        """Remove a new piece, and the folder if nothing else is in it, where the file that names it is not written."""
        with suppress(OSError):
            self.piece(k).unlink(missing_ok=True)
            self.piece(k).parent.rmdir()

    def _header(self, count: int, grid: Grid) -> str:
        root = 'VTKFile type="PUnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64"'
        lines = ['<?xml version="1.0" encoding="utf-8"?>', _OWN_PIECES]
        lines += [f"<{root}>", '<PUnstructuredGrid GhostLevel="0">']
        sections = ("PPoints", {"Points": grid.points}), ("PPointData", grid.node_data), ("PCellData", grid.cell_data)
        for section, arrays in sections:
            lines += [f"<{section}>", *_declarations(self.path, arrays), f"</{section}>"]
        sources = (array_attributes(Source=self.name(k)) for k in range(count))
        lines += [f"<Piece {source}/>" for source in sources]
        return "\n".join([*lines, "</PUnstructuredGrid>", "</VTKFile>", ""])


def _own_pieces(path: Path, stem: str) -> list[Path]:
    """List the pieces that Hexmend has written for a file, and that no other file in its folder names."""
    own, named = re.compile(re.escape(f"{stem}/{stem}") + r"(-\d+)?_\d+\.vtu"), _named_pieces(path)
    try:
        if not named or _OWN_PIECES.encode() not in path.read_bytes():
            return []
        files, itself = [one for one in path.parent.iterdir() if one.suffix.lower() == ".pvtu"], realpath(path)
    except OSError:
        return []
    names = [name.replace("\\", "/") for one in files if realpath(one) != itself for name in _named_pieces(one)]
    shared = {realpath(path.parent / name) for name in names}
    pieces = [path.parent / name for name in named if own.fullmatch(name)]
    return [piece for piece in pieces if realpath(piece) not in shared]


def _named_pieces(path: Path) -> list[str]:
    """List the names of the pieces of a file; none for a file that is missing or lists none."""
    try:
        return piece_names(path)
    except (FileError, OSError):
        return []


def _declarations(path: Path, arrays: Mapping[str, np.ndarray]) -> list[str]:
    """Declarations of the arrays that every piece has, without those of width 0 and those of strings."""
    found = []
    for name, values in arrays.items():
        array = writable(path, name, values)
        if np.size(array) and not isinstance(array, list):
            found.append(f"<PDataArray {array_attributes(array, Name=name)}/>")
    return found


def numbered(grid: Grid, nodes: np.ndarray, cells: np.ndarray) -> Grid:
    """Return a grid with the numbers of its nodes (n,) and cells (c,) in the whole mesh, int64."""
    node_data, cell_data = {**grid.node_data, NODE_ID: nodes}, {**grid.cell_data, CELL_ID: cells}
    return replace(grid, node_data=node_data, cell_data=cell_data)


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write a mesh as one piece.

    Raises
    ------
    FileError
        For an array of a type that VTK does not have, and where the files cannot be written.
    """
    grid, files = from_mesh(mesh), PieceFiles.new(path)
    grid = numbered(grid, np.arange(len(grid.points)), np.arange(len(grid.types)))
    files.make_folder()
    try:
        files.write_piece(0, grid, encoding)
        files.finish(1, grid)
    except BaseException:
        files.discard(0)
        raise


def remove(path: Path) -> None:
    """Remove a file, then its pieces, and their folder if nothing else is in it."""
    files = PieceFiles.new(path)
    path.unlink(missing_ok=True)
    files.remove_replaced()
    with suppress(OSError):
        (path.parent / files.folder).rmdir()


def names_not_kept(mesh: Mesh) -> list[str]:
    """Describe what the file cannot hold: data that are not numbers, and those with the names of its own numbers."""
    of_cells = [name for data in (mesh.hex_data, *(cells.data for cells in mesh.cells)) for name in data]
    return [*non_numeric_data(mesh), *names_taken(mesh.node_data, of_cells)]


def names_taken(node_data: Iterable[str], cell_data: Iterable[str]) -> list[str]:
    """Describe the data, of these names, that the numbers of the file replace."""
    taken = [f"point data ({NODE_ID})"] * (NODE_ID in node_data) + [f"cell data ({CELL_ID})"] * (CELL_ID in cell_data)
    return [f"{one}, a name that it uses itself" for one in taken]
