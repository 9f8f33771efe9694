"""Reading of polyMesh: hexes and other cells from their faces, patches as side sets, zones as sets."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hexmend.arrays import index_of, mask
from hexmend.errors import FileError
from hexmend.io.base.content import ID, Block, Content, to_mesh
from hexmend.io.base.numbering import first_out_of_range
from hexmend.io.base.polyhedra import RaggedArray, cells_from_faces
from hexmend.io.formats.openfoam.boundary import DEFAULT_PATCH, Patch, read_patches, read_zones
from hexmend.io.formats.openfoam.case import SUFFIXES, CaseFiles, find_case
from hexmend.io.formats.openfoam.foam_file import FoamFile
from hexmend.io.formats.openfoam.lists import read_faces, read_labels, read_vectors
from hexmend.io.formats.openfoam.split_cells import cells_with_split_faces
from hexmend.io.formats.openfoam.topology import standard_order
from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules.two_dimensional import with_two_dimensional_motion
from hexmend.terminal_text import count_phrase


@dataclass(frozen=True, eq=False)
class PolyMesh:
    """Points, faces and cells of polyMesh, with its patches.

    Parameters
    ----------
    points : (n, 3) float64
    faces : RaggedArray
        Nodes of each face; its normal points from the owner to the neighbour, or out of the mesh.
    owner : (f,) int64
    neighbour : (i,) int64
        Of the internal faces, which come first.
    patches : list of Patch
    """

    points: np.ndarray
    faces: RaggedArray
    owner: np.ndarray
    neighbour: np.ndarray
    patches: list[Patch]

    @property
    def n_cells(self) -> int:
        """Number of cells."""
        return int(max(self.owner.max(initial=-1), self.neighbour.max(initial=-1))) + 1

    def cells(self) -> dict[str, tuple[np.ndarray, np.ndarray]]:
        """Cells of known kinds by kind: their numbers and their nodes, as of `cells_from_faces`."""
        numbers = np.concatenate([np.arange(len(self.owner)), np.arange(len(self.neighbour))])
        order = np.argsort(np.concatenate([self.owner, self.neighbour]), kind="stable")
        counts = np.bincount(self.owner, minlength=self.n_cells)
        counts += np.bincount(self.neighbour, minlength=self.n_cells)
        start = np.concatenate([[0], np.cumsum(counts)])
        is_owner = order < len(self.owner)  # which sees the face in reverse: its normal points out of the cell
        narrow = RaggedArray(self.faces.start, self.faces.values.astype(np.int32))  # half of the memory to go through
        cells = RaggedArray(start, numbers[order])
        found = cells_from_faces(narrow, cells, is_owner)
        other = np.ones(self.n_cells, bool)
        for which, _ in found.values():
            other[which] = False
        at = np.flatnonzero(other)
        if at.size:
            own = np.repeat(other, cells.lengths)
            rest = RaggedArray(np.concatenate([[0], np.cumsum(cells.lengths[at])]), cells.values[own])
            for kind, (which, nodes) in cells_with_split_faces(self.points, narrow, rest, is_owner[own]).items():
                known = found.get(kind, (at[:0], nodes[:0]))
                which, nodes = np.append(known[0], at[which]), np.concatenate([known[1], nodes])
                found[kind] = np.sort(which), nodes[np.argsort(which)]
        return {kind: (which, standard_order(kind, nodes)) for kind, (which, nodes) in found.items()}


def read(path: Path) -> Mesh:
    """Read the mesh of a case.

    Parameters
    ----------
    path : Path
        See `find_case`.

    Returns
    -------
    Mesh
        Patches and zones of faces are side sets, zones of cells and points are hex and node sets. Nodes of polyhedra
        are pinned. Between empty or wedge patches nodes move in the plane of these patches.
    """
    files = find_case(path)
    if files is None:
        problem = f"there is no OpenFOAM mesh {'next to it' if path.suffix.lower() in SUFFIXES else 'in it'}"
        raise FileError(path, problem, "Choose the folder of a case, which holds constant/polyMesh.")
    poly = read_poly_mesh(files)
    cells = poly.cells()
    hex_of = np.full(poly.n_cells, -1)
    numbers, hexes = cells.get("hex", (np.zeros(0, np.int64), np.zeros((0, 8), np.int64)))
    hex_of[numbers] = np.arange(len(numbers))
    counts = {"cellZones": poly.n_cells, "faceZones": len(poly.faces), "pointZones": len(poly.points)}
    zones = {name: read_zones(files, name, count) for name, count in counts.items()}
    pinned, notes, unread = _polyhedra(poly, cells)
    sides = {patch.name: patch.faces for patch in poly.patches}
    sides |= {name: faces for name, faces in zones["faceZones"].items() if name not in sides}
    content = Content(
        poly.points,
        (*_blocks(poly, cells, zones["cellZones"]), *_boundary_of_others(poly, hex_of)),
        node_sets=zones["pointZones"],
        side_sets={name: _sides(poly, faces, hex_of, hexes) for name, faces in sides.items()},
        pinned=pinned,
        notes=notes,
        unread=unread,
    )
    mesh = to_mesh(path, content).replace(
        name=path.stem if path.suffix.lower() in SUFFIXES else files.root.name,
        side_set_types={patch.name: patch.type for patch in poly.patches},
        periodic_pairs=_pairs(poly.patches),
    )
    return with_two_dimensional_motion(mesh)


def read_poly_mesh(files: CaseFiles) -> PolyMesh:
    """Read points, faces, owners and patches, and check that they agree; raises `FileError` where they do not."""
    if not files.points.is_file():
        files.part("points")
    points = read_vectors(FoamFile(files.points), "points")
    faces = read_faces(FoamFile(files.part("faces")))
    path = files.part("faces")
    outside = first_out_of_range(faces.values, len(points))
    if outside is not None:
        problem = f"a face refers to point {outside}: expected 0 to {len(points) - 1}"
        raise FileError(path, problem, f"Is {files.points.parent.name}/points of the same mesh?")
    owner = read_labels(FoamFile(files.part("owner")), "owner", len(faces))
    neighbour_path = files.part("neighbour")
    neighbour = read_labels(FoamFile(neighbour_path), "neighbour")
    if len(neighbour) == len(owner):  # of old versions: -1 for faces of the boundary
        neighbour = neighbour[: len(neighbour) - int((neighbour[::-1] >= 0).argmax())] if (neighbour >= 0).any() else []
        neighbour = np.asarray(neighbour, np.int64)
    if len(neighbour) > len(owner):
        raise FileError(neighbour_path, f"holds {len(neighbour):,} numbers: expected at most {len(owner):,}, as owner")
    for name, labels in (("owner", owner), ("neighbour", neighbour)):
        if first_out_of_range(labels, len(faces)) is not None:  # a cell has a face of its own or more
            problem = f"refers to cells from {labels.min()} to {labels.max()}: expected 0 to {len(faces) - 1} at most"
            raise FileError(files.part(name), problem, "Check that it belongs to the same mesh as faces.")
    patches = read_patches(files.part("boundary"), len(neighbour), len(owner))
    return PolyMesh(points, faces, owner, neighbour, patches)


def _pairs(patches: list[Patch]) -> tuple[tuple[str, str], ...]:
    """Cyclic patches, each pair once."""
    found = {frozenset((patch.name, patch.neighbour)): (patch.name, patch.neighbour) for patch in reversed(patches)}
    return tuple(pair for pair in reversed(found.values()) if pair[1])


def _blocks(poly: PolyMesh, cells: dict, zones: dict[str, np.ndarray]) -> list[Block]:
    """Blocks of the cells; their numbers are kept as ids where hexes are not all of the cells."""
    blocks = []
    for kind, (numbers, nodes) in cells.items():
        place = index_of(numbers, poly.n_cells)
        sets = {name: place[members][place[members] >= 0] for name, members in zones.items()}
        sets = {name: members for name, members in sets.items() if kind == "hex" or len(members)}
        data = {} if len(numbers) == poly.n_cells else {ID: numbers}
        blocks.append(Block(kind, nodes, data, sets))
    return blocks


def _sides(poly: PolyMesh, faces: np.ndarray, hex_of: np.ndarray, hexes: np.ndarray) -> np.ndarray:
    """Rows of a side set for faces: the hex on one side, the owner if both are hexes, and the row of FACES."""
    own, lengths = hex_of[poly.owner[faces]], poly.faces.lengths[faces]
    inner = (own < 0) & (faces < len(poly.neighbour))
    own[inner] = hex_of[poly.neighbour[faces[inner]]]
    faces, own, lengths = (each[(own >= 0) & (lengths >= 4)] for each in (faces, own, lengths))
    places = np.minimum(np.arange(int(lengths.max(initial=4))), lengths[:, None] - 1)
    nodes = poly.faces.values[poly.faces.start[faces][:, None] + places]  # with those that hang at its edges
    alike = (hexes[own][:, FACES][..., None] == nodes[:, None, None, :]).any(axis=3).all(axis=2)
    is_whole = alike.any(axis=1)  # others are parts of a split face
    return np.column_stack([own, alike.argmax(axis=1)])[is_whole]


def _boundary_of_others(poly: PolyMesh, hex_of: np.ndarray) -> list[Block]:
    """Triangles and quads of patches that are not faces of hexes, with the patches as sets."""
    blocks = []
    for kind, width in (("triangle", 3), ("quad", 4)):
        chosen = {
            patch.name: patch.faces[(hex_of[poly.owner[patch.faces]] < 0) & (poly.faces.lengths[patch.faces] == width)]
            for patch in poly.patches
            if patch.name != DEFAULT_PATCH
        }
        faces = np.concatenate([np.zeros(0, np.int64), *chosen.values()])
        ends = np.cumsum([0, *map(len, chosen.values())])
        sets = {name: np.arange(ends[k], ends[k + 1]) for k, name in enumerate(chosen) if ends[k] < ends[k + 1]}
        if len(faces):
            nodes = poly.faces.values[poly.faces.start[faces][:, None] + np.arange(width)]
            blocks.append(Block(kind, nodes, sets=sets))
    return blocks


def _polyhedra(poly: PolyMesh, cells: dict) -> tuple[np.ndarray | None, tuple[str, ...], dict[str, int]]:
    """Nodes of cells of unknown kinds, (n,) bool or None, a note on these cells, and their number for errors."""
    other = np.ones(poly.n_cells, bool)
    for numbers, _ in cells.values():
        other[numbers] = False
    n_other = int(other.sum())
    if not n_other:
        return None, (), {}
    at = other[poly.owner]
    at[: len(poly.neighbour)] |= other[poly.neighbour]
    pinned = mask(poly.faces.values[np.repeat(at, poly.faces.lengths)], len(poly.points))
    found = count_phrase(n_other, "polyhedron is", "polyhedra are")
    note = f"{found} kept in the case alone, and their nodes are fixed."
    return pinned, (note,), {"polyhedral shape": n_other}
