"""Conversion of meshes to and from meshio."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from hexmend.errors import MeshError
from hexmend.interop.conversion import convert_to_mesh, import_library, with_side_marks
from hexmend.io.base.content import HEX_KINDS, Block, Content, concatenate_data, from_mesh, merge_blocks, to_mesh
from hexmend.io.base.fixed_marks import with_marks
from hexmend.io.base.remedies import unread_note
from hexmend.mesh.cells import CELL_KINDS
from hexmend.mesh.mesh import Mesh
from hexmend.terminal_text import count_phrase

TYPE_CHECKING = False
if TYPE_CHECKING:
    import meshio

#: Kinds of cells by meshio's names.
KINDS = {"hexahedron": "hex", "hexahedron20": "hex20", "hexahedron27": "hex27", **{kind: kind for kind in CELL_KINDS}}
NAMES = {kind: name for name, kind in KINDS.items()}

#: Permutation of nodes between Hexmend's order, which is VTK's, and meshio's, where they differ; its own inverse.
_ORDER = {"wedge": [0, 2, 1, 3, 5, 4]}

#: Entries of cell sets from meshio's reader of Gmsh that hold no cells.
_NOT_SETS = {"gmsh:bounding_entities"}

#: Cell data of Gmsh that hold the number of a cell's physical group; its name and dimension are field data.
_PHYSICAL = "gmsh:physical"


def to_meshio(mesh: Mesh) -> meshio.Mesh:
    """Convert a mesh to meshio: hexes, cells of other kinds, data and sets.

    Node sets are point sets; element sets are cell sets. meshio has no sets of faces: bit k of the cell data
    "sides:inlet" marks face k of a cell as one of the side set "inlet". Point data "fixed" are 1 for nodes that are
    marked as fixed. Data of hexes alone are NaN or 0 for other cells. Left out are the name and the notes of the mesh
    and the order of the faces of a side set.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    meshio.Mesh
        A copy: changing it does not change the mesh.

    Raises
    ------
    InstallationError
        Where meshio is not installed.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> to_meshio(make("cube", size=27)).cells  # doctest: +SKIP
    [<meshio CellBlock, type: hexahedron, num cells: 27, tags: []>]
    """
    meshio = import_library("meshio")
    content = from_mesh(with_side_marks(mesh))
    lengths = [len(block) for block in content.blocks]
    data = concatenate_data([block.data for block in content.blocks], lengths)
    sets = dict.fromkeys(name for block in content.blocks for name in block.sets)
    return meshio.Mesh(
        np.array(content.points),
        [(NAMES[block.kind], _reordered(block.kind, block.nodes)) for block in content.blocks],
        point_data={name: np.array(values) for name, values in with_marks(mesh).items()},
        cell_data={name: np.split(values, np.cumsum(lengths)[:-1]) for name, values in data.items()},
        field_data=dict(content.field_data),
        point_sets={name: np.array(members) for name, members in content.node_sets.items()},
        cell_sets={name: [np.array(block.sets.get(name, ()), np.int64) for block in content.blocks] for name in sets},
    )


def from_meshio(meshio_mesh: meshio.Mesh, *, as_is: bool = False) -> Mesh:
    """Convert a meshio mesh with hexahedra: its hexes, cells of other kinds, data and sets.

    Arrays named as `to_meshio` names them become side sets and marks of fixed nodes again; physical groups of Gmsh
    become sets. Cells of other kinds are handled as in a file: see `hexmend.read`.

    Parameters
    ----------
    meshio_mesh : meshio.Mesh
    as_is : bool
        Keep hexes that are numbered left-handed; else they are renumbered.

    Returns
    -------
    Mesh
        A copy: changing the meshio mesh does not change it. Its `notes` list the changes.

    Raises
    ------
    InstallationError
        Where meshio is not installed.
    MeshError
        For an object that is no meshio mesh or holds no hexahedra, and for cells or points that make no mesh.
    """
    meshio = import_library("meshio")
    if not isinstance(meshio_mesh, meshio.Mesh):
        given = f"an object of type {type(meshio_mesh).__name__}"
        raise MeshError(f"from_meshio() was given {given}; expected a meshio.Mesh")
    return convert_to_mesh("meshio mesh", lambda title: to_mesh(title, _content(meshio_mesh)), as_is)


def _content(mesh: meshio.Mesh) -> Content:
    """Make the content of a meshio mesh: one block of cells for each kind."""
    sets = _physical_groups(mesh) | {name: parts for name, parts in mesh.cell_sets.items() if name not in _NOT_SETS}
    blocks: dict[str, list[Block]] = {}
    unread: Counter[str] = Counter()
    for index, cells in enumerate(mesh.cells):
        kind = KINDS.get(cells.type)
        if kind is None:
            unread[f"type {cells.type}"] += len(cells)
            continue
        data = {name: np.array(parts[index]) for name, parts in mesh.cell_data.items()}
        members = {name: _members(parts, index) for name, parts in sets.items()}
        blocks.setdefault(kind, []).append(Block(kind, _reordered(kind, cells.data), data, members))
    merged = [merge_blocks(group) for group in blocks.values()]
    merged.sort(key=lambda block: block.kind not in HEX_KINDS)
    notes = []
    if unread:
        kinds = ", ".join(sorted(unread))
        cells = count_phrase(sum(unread.values()), f"cell of another kind ({kinds})", f"cells of other kinds ({kinds})")
        notes.append(unread_note(cells))
    points = np.array(mesh.points)
    node_data = {name: np.array(values) for name, values in mesh.point_data.items()}
    node_sets = {name: np.array(members, np.int64) for name, members in mesh.point_sets.items()}
    content = tuple(_without_empty_sets(merged))
    return Content(points, content, node_data, node_sets, {}, None, dict(mesh.field_data), tuple(notes), unread)


def _physical_groups(mesh: meshio.Mesh) -> dict[str, list[np.ndarray]]:
    """Convert Gmsh's physical groups (field data with number and dimension, for files of version 2) to cell sets."""
    groups = {}
    for name, entry in mesh.field_data.items():
        numbers = np.asarray(entry)
        if _PHYSICAL in mesh.cell_data and numbers.shape == (2,) and numbers.dtype.kind in "iu":
            groups[name] = [
                np.flatnonzero((np.asarray(tags) == numbers[0]) & (cells.dim == numbers[1]))
                for cells, tags in zip(mesh.cells, mesh.cell_data[_PHYSICAL], strict=True)
            ]
    return groups


def _members(parts: Sequence[object], index: int) -> np.ndarray:
    """Members of a cell set in one block; meshio's readers may give None, or too few parts, for empty ones."""
    part = parts[index] if index < len(parts) else None
    return np.array(() if part is None else part, np.int64)


def _without_empty_sets(blocks: Sequence[Block]) -> list[Block]:
    """Drop empty sets of blocks where another block has members; sets without any member stay in the first block."""
    filled = {name for block in blocks for name, members in block.sets.items() if len(members)}
    kept = []
    for block in blocks:
        empty = set() if block is not blocks[0] else block.sets.keys() - filled
        sets = {name: members for name, members in block.sets.items() if len(members) or name in empty}
        kept.append(replace(block, sets=sets))
    return kept


def _reordered(kind: str, nodes: np.ndarray) -> np.ndarray:
    nodes = np.array(nodes, np.int64)
    return nodes[:, _ORDER[kind]] if kind in _ORDER else nodes
