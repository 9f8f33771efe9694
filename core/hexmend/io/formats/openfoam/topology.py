"""Faces, owners, neighbours, patches and zones of a mesh, in the order that OpenFOAM requires.

Internal faces come first, by owner and then by neighbour; the owner is the cell of the lower number, and the normal of
a face points out of it. The faces of each patch follow one another.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import from_mesh
from hexmend.io.base.lower_order import reduce_order
from hexmend.io.base.polyhedra import LOOPS, faces_from_cells
from hexmend.io.base.unique_names import make_unique
from hexmend.io.formats.openfoam.boundary import DEFAULT_PATCH, Patch
from hexmend.io.formats.openfoam.standard_order import with_outward_faces
from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.mesh import Mesh

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
    _check_cells(path, volumes)
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
    outer = [faces for _, faces in patches]
    every = np.concatenate([inner, *outer])
    number = np.empty(n_faces, np.int64)
    number[every] = np.arange(n_faces)
    starts = len(inner) + np.cumsum([0, *map(len, outer)])
    cells_by_set = _cell_zones(volumes)
    turned = np.where(loops[:, 3:] < 0, np.column_stack([loops[:, 2::-1], loops[:, 3:]]), loops[:, ::-1])
    titles = zone_titles(mesh)
    return PolyTopology(
        content.points,
        turned[every],
        owner[every],
        other[inner],
        _described(mesh, patches, starts),
        n_cells,
        {titles[name]: members for name, members in cells_by_set.items()},
        {titles[name]: np.unique(nodes) for name, nodes in content.node_sets.items()},
        {titles[name]: (number[faces], owner[faces] != hexes) for name, (faces, hexes) in zones.items()},
    )


def _check_cells(path: Path, volumes: list) -> None:
    """Raise `FileError` for a cell with a repeated node."""
    for block in volumes:
        twice = np.flatnonzero((np.diff(np.sort(block.nodes, axis=1), axis=1) == 0).any(axis=1))
        if twice.size:
            problem = f"{block.kind} {twice[0]} has a node twice, so that its faces do not form a polyhedron"
            raise FileError(path, problem, "Repair it with hexmend repair, or write .vtu instead.")


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
    """Faces of each patch by its name, as pairs, and of each zone: faces and hexes."""
    taken, patches, zones = ~is_outer, [], {}
    for name in sorted(mesh.side_sets, key=lambda name: name not in mesh.side_set_types):
        rows = np.asarray(mesh.side_sets[name], np.int64).reshape(-1, 2)
        faces, at = np.unique(face_at[rows[:, 0], rows[:, 1]], return_index=True)
        at.sort()
        faces = face_at[rows[at, 0], rows[at, 1]]  # in the order of the set, which couples cyclic patches
        if taken[faces].any():
            zones[name] = faces, rows[at, 0]
        else:
            taken[faces] = True
            patches.append((name, faces))
    keys = {tuple(sorted(loops[face].tolist())): face for face in np.flatnonzero(~taken)} if _has_sets(content) else {}
    for block in content.blocks:
        for name, members in block.sets.items() if block.kind in ("triangle", "quad") else ():
            nodes = np.sort(block.nodes[members], axis=1).tolist()
            found = (keys.pop((-1, *row) if len(row) == 3 else tuple(row), None) for row in nodes)
            faces = np.array([face for face in found if face is not None], np.int64)
            taken[faces] = True
            _extend(patches, name, faces)
    rest = np.flatnonzero(~taken)
    if rest.size:
        _extend(patches, DEFAULT_PATCH, rest)
    return patches, zones


def _has_sets(content) -> bool:
    return any(block.sets for block in content.blocks if block.kind in ("triangle", "quad"))


def _extend(patches: list[tuple[str, np.ndarray]], name: str, faces: np.ndarray) -> None:
    """Add faces to the patch of a name, or a new patch."""
    for k, (known, own) in enumerate(patches):
        if known == name:
            patches[k] = name, np.concatenate([own, faces])
            return
    if faces.size:
        patches.append((name, faces))


def _described(mesh: Mesh, patches: list[tuple[str, np.ndarray]], starts: np.ndarray) -> list[Patch]:
    titles, described = patch_titles(mesh), []
    partner = {first: second for pair in mesh.periodic_pairs for first, second in (pair, pair[::-1])}
    names = {name for name, _ in patches}
    for (name, faces), start in zip(patches, starts.tolist(), strict=False):
        kind = mesh.side_set_types.get(name, "patch")
        other = partner.get(name, "") if kind == "cyclic" and partner.get(name) in names else ""
        kind = kind if kind in _TYPES or other else "patch"
        described.append(Patch(titles[name], kind, start, len(faces), titles.get(other, "")))
    return described


def _cell_zones(volumes) -> dict[str, np.ndarray]:
    members: dict[str, list[np.ndarray]] = {}
    first = 0
    for block in volumes:
        for name, own in block.sets.items():
            members.setdefault(name, []).append(np.asarray(own, np.int64) + first)
        first += len(block)
    return {name: np.unique(np.concatenate(parts)) for name, parts in members.items()}


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
