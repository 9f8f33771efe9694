"""Faces, owners, neighbours, patches and zones of a mesh, in the order that OpenFOAM requires.

Internal faces come first, by owner and then by neighbour; the owner is the cell of the lower number, and the normal of
a face points out of it. The faces of each patch follow one another.

Order of the corners of cells: polyMesh has none, and needs faces with normals that point out of the cells.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise, permutations
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.capabilities import make_unique
from hexmend.io.base.content import concatenate_sets, from_mesh
from hexmend.io.base.lower_order import reduce_order
from hexmend.io.base.polyhedra import LOOPS, check_distinct_nodes, faces_from_cells
from hexmend.io.formats.openfoam.boundary import DEFAULT_PATCH, Patch
from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA, FACES, UNIT_CUBE
from hexmend.mesh.mesh import Mesh

#: Numbering of the mirrored cell of each kind but hexes.
_MIRRORED = {"tetra": [0, 2, 1, 3], "pyramid": [0, 3, 2, 1, 4], "wedge": [0, 2, 1, 3, 5, 4]}
#: Cells that are ordered at a time, which limits the memory.
_CHUNK = 1 << 16


def standard_order(kind: str, cells: np.ndarray) -> np.ndarray:
    """Rotate cells so that the lowest possible node comes first, and the lowest possible one second.

    Parameters
    ----------
    kind : str
        A key of `ROTATIONS`.
    cells : (k, width) int64
        Nodes in VTK's order.

    Returns
    -------
    (k, width) int64
        The same cells in VTK's order, not mirrored.

    Examples
    --------
    >>> standard_order("tetra", np.array([[7, 3, 5, 4]]))
    array([[3, 4, 5, 7]])
    """
    turns, ordered = ROTATIONS[kind], np.empty_like(cells)
    for begin in range(0, len(cells), _CHUNK):
        part = cells[begin : begin + _CHUNK].astype(np.int64)
        limit = part.max() + 1
        best = (part[:, turns[:, 0]] * limit + part[:, turns[:, 1]]).argmin(axis=1)
        ordered[begin : begin + _CHUNK] = np.take_along_axis(part, turns[best], axis=1)
    return ordered


def with_outward_faces(kind: str, cells: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Mirror the numbering of cells with a negative volume: not all programs number wedges alike.

    Parameters
    ----------
    kind : str
        "tetra", "pyramid" or "wedge"; hexes are returned as they are.
    cells : (k, width) int
    points : (n, 3) float64

    Returns
    -------
    (k, width) int
    """
    if kind not in _MIRRORED:
        return cells
    corners = points[cells] - points[cells].mean(axis=1, keepdims=True)
    volume = np.zeros(len(cells))
    for first, *others in LOOPS[kind]:  # seen from inside
        for second, third in pairwise(others):
            normal = np.cross(corners[:, second], corners[:, third])
            volume -= np.einsum("ki,ki->k", corners[:, first], normal)
    return np.where(volume[:, None] < 0, cells[:, _MIRRORED[kind]], cells)


def _hex_rotations() -> list[list[int]]:
    """The 24 rotations: corner a comes first, and one of its neighbours second."""
    turns = []
    for a, *neighbours in CORNER_TETRAHEDRA.tolist():
        for k in range(3):
            corners = UNIT_CUBE[a] + UNIT_CUBE @ (UNIT_CUBE[np.roll(neighbours, -k)] - UNIT_CUBE[a])
            turns.append([int((corner == UNIT_CUBE).all(axis=1).argmax()) for corner in corners])
    return turns


def _is_even(order: tuple[int, ...]) -> bool:
    return sum(a > b for k, a in enumerate(order) for b in order[k + 1 :]) % 2 == 0


#: Numberings of each kind that describe the same cell, in VTK's order, (r, width).
ROTATIONS = {
    "hex": np.array(_hex_rotations()),
    "wedge": np.array(
        [
            [0, 1, 2, 3, 4, 5], [1, 2, 0, 4, 5, 3], [2, 0, 1, 5, 3, 4],
            [3, 5, 4, 0, 2, 1], [5, 4, 3, 2, 1, 0], [4, 3, 5, 1, 0, 2],
        ]
    ),
    "pyramid": np.array([[0, 1, 2, 3, 4], [1, 2, 3, 0, 4], [2, 3, 0, 1, 4], [3, 0, 1, 2, 4]]),
    "tetra": np.array([order for order in permutations(range(4)) if _is_even(order)]),
}  # fmt: skip


#: Types of patches that need no other entries; `cyclic` needs the other patch. Others become patch.
_TYPES = frozenset({"patch", "wall", "symmetry", "symmetryPlane", "empty", "wedge"})
#: Place in `FACES` of each loop of a hex as `faces_from_cells` numbers them.
_LOOP_ROW = [next(r for r in range(6) if set(FACES[r]) == set(loop)) for loop in LOOPS["hex"]]
_FORBIDDEN = frozenset("{}()[];\"'/\\$#")


@dataclass(frozen=True, eq=False)
class PolyTopology:
    """Everything that the files of polyMesh hold.

    Parameters
    ----------
    points : (n, 3) float64
    loops : (f, 4) int64
        Nodes of each face; -1 in the fourth column of a triangle.
    owner : (f,) int64
    neighbour : (i,) int64
    patches : list of Patch
    n_cells : int
    cell_zones, point_zones : dict of str to (k,) int64
    face_zones : dict of str to ((k,) int64, (k,) bool)
        Faces, and True for those seen from their neighbour.
    """

    points: np.ndarray
    loops: np.ndarray
    owner: np.ndarray
    neighbour: np.ndarray
    patches: list[Patch]
    n_cells: int
    cell_zones: dict[str, np.ndarray]
    point_zones: dict[str, np.ndarray]
    face_zones: dict[str, tuple[np.ndarray, np.ndarray]]


def poly_topology(path: Path, mesh: Mesh) -> PolyTopology:
    """Find the faces of a mesh and order them.

    Parameters
    ----------
    path : Path
        Named in errors.
    mesh : Mesh
        Side sets become patches, those with inner faces or faces of earlier patches zones of faces. Sets of triangles
        and quads become patches too.

    Returns
    -------
    PolyTopology

    Raises
    ------
    FileError
        For a cell with a repeated node, and a face of more than two cells.
    """
    content = reduce_order(from_mesh(mesh), frozenset(LOOPS) | {"triangle", "quad"})
    volumes = [block for block in content.blocks if block.kind in LOOPS]
    check_distinct_nodes(path, volumes, "its faces do not form a polyhedron")
    outward = [(block.kind, with_outward_faces(block.kind, block.nodes, content.points)) for block in volumes]
    loops, halves = faces_from_cells(outward)
    n_faces, n_cells = len(loops), len(halves)
    face = halves.values >> 1
    count = np.bincount(face, minlength=n_faces)
    if count.max(initial=0) > 2:
        wrong = loops[count.argmax()]
        problem = f"the face of the nodes {', '.join(str(k) for k in wrong if k >= 0)} belongs to {count.max()} cells"
        raise FileError(path, problem, "Repair the mesh with hexmend repair.")
    owner, other = _cells_of_faces(face, np.repeat(np.arange(n_cells), halves.lengths), count)
    hex_faces = face[: 6 * mesh.n_hexes].reshape(-1, 6)
    face_at = np.empty((mesh.n_hexes, 6), np.int64)
    face_at[:, _LOOP_ROW] = hex_faces
    inner = np.flatnonzero(count == 2)
    inner = inner[np.lexsort((other[inner], owner[inner]))]
    patches, zones = _patches(mesh, content, loops, count == 1, face_at)
    every = np.concatenate([inner, *patches.values()])
    number = np.empty(n_faces, np.int64)
    number[every] = np.arange(n_faces)
    starts = len(inner) + np.cumsum([0, *map(len, patches.values())])
    cells_by_set = concatenate_sets([block.sets for block in volumes], [len(block) for block in volumes])
    turned = np.where(loops[:, 3:] < 0, np.column_stack([loops[:, 2::-1], loops[:, 3:]]), loops[:, ::-1])
    titles = zone_titles(mesh)
    return PolyTopology(
        content.points,
        turned[every],
        owner[every],
        other[inner],
        _described(mesh, patches, starts),
        n_cells,
        {titles[name]: np.unique(members) for name, members in cells_by_set.items()},
        {titles[name]: np.unique(nodes) for name, nodes in content.node_sets.items()},
        {titles[name]: (number[faces], owner[faces] != hexes) for name, (faces, hexes) in zones.items()},
    )


def _cells_of_faces(face: np.ndarray, cell: np.ndarray, count: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the lower and the higher cell of each face, -1 where there is one cell alone, (f,) int64 each.

    `face` and `cell` (h,) are those of each side of a face, `count` (f,) is the number of sides.
    """
    order = np.argsort(face, kind="stable")
    first = np.cumsum(count) - count
    other = np.full(len(count), -1)
    other[count == 2] = cell[order[first[count == 2] + 1]]
    return cell[order[first]], other


def _patches(mesh: Mesh, content, loops: np.ndarray, is_outer: np.ndarray, face_at: np.ndarray):
    """Faces of each patch by its name, and of each zone: faces and hexes."""
    taken, patches, zones = ~is_outer, {}, {}
    for name in sorted(mesh.side_sets, key=lambda name: name not in mesh.side_set_types):
        rows = np.asarray(mesh.side_sets[name], np.int64).reshape(-1, 2)
        faces, at = np.unique(face_at[rows[:, 0], rows[:, 1]], return_index=True)
        at.sort()
        faces = face_at[rows[at, 0], rows[at, 1]]  # in the order of the set, which couples cyclic patches
        if taken[faces].any():
            zones[name] = faces, rows[at, 0]
        else:
            taken[faces] = True
            patches[name] = faces
    lower = [block for block in content.blocks if block.kind in ("triangle", "quad") and block.sets]
    keys = {tuple(sorted(loops[face].tolist())): face for face in np.flatnonzero(~taken)} if lower else {}
    for block in lower:
        for name, members in block.sets.items():
            nodes = np.sort(block.nodes[members], axis=1).tolist()
            found = (keys.pop((-1, *row) if len(row) == 3 else tuple(row), None) for row in nodes)
            faces = np.array([face for face in found if face is not None], np.int64)
            taken[faces] = True
            _extend(patches, name, faces)
    rest = np.flatnonzero(~taken)
    if rest.size:
        _extend(patches, DEFAULT_PATCH, rest)
    return patches, zones


def _extend(patches: dict[str, np.ndarray], name: str, faces: np.ndarray) -> None:
    """Add faces to the patch of a name, or a new patch."""
    if name in patches or faces.size:
        patches[name] = np.concatenate([patches.get(name, faces[:0]), faces])


def _described(mesh: Mesh, patches: dict[str, np.ndarray], starts: np.ndarray) -> list[Patch]:
    titles, described = patch_titles(mesh), []
    partner = {first: second for pair in mesh.periodic_pairs for first, second in (pair, pair[::-1])}
    for (name, faces), start in zip(patches.items(), starts.tolist(), strict=False):
        kind = mesh.side_set_types.get(name, "patch")
        other = partner.get(name, "") if kind == "cyclic" and partner.get(name) in patches else ""
        kind = kind if kind in _TYPES or other else "patch"
        described.append(Patch(titles[name], kind, start, len(faces), titles.get(other, "")))
    return described


def patch_titles(mesh: Mesh) -> dict[str, str]:
    """Names of patches as they are written: words of OpenFOAM."""
    lower = (cells.sets for cells in mesh.cells if cells.dimension == 2)
    return make_unique([*mesh.side_sets, *(name for sets in lower for name in sets), DEFAULT_PATCH], _word)


def zone_titles(mesh: Mesh) -> dict[str, str]:
    """Names of zones as they are written: words of OpenFOAM."""
    solids = (cells.sets for cells in mesh.cells if cells.dimension == 3)
    names = [*mesh.hex_sets, *(name for sets in solids for name in sets), *mesh.node_sets, *mesh.side_sets]
    return make_unique(names, _word)


def _word(name: str, suffix: str) -> str:
    """Form of a name without the letters that end a word."""
    letters = (letter if letter.isprintable() and letter not in _FORBIDDEN else " " for letter in name + suffix)
    return "_".join("".join(letters).split()) or "unnamed"
