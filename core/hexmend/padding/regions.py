"""Faces under which a layer is laid: the whole boundary, a set, or those of hexes that cannot be mended."""

from __future__ import annotations

import numpy as np

from hexmend.arrays import find_rows, mask
from hexmend.errors import MeshError
from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules.named_sets import nodes_in_set
from hexmend.mesh.rules.two_dimensional import EMPTY, WEDGE
from hexmend.padding.inserted_layer import CrossingError, Sheet


def whole_sheet(mesh: Mesh) -> Sheet:
    """Return the sheet under the whole boundary.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    Sheet

    Raises
    ------
    MeshError
        For a mesh that cannot be padded; see `check_mesh`. For one whose boundary belongs to other cells as well.
    """
    check_mesh(mesh)
    solids = {cells.kind: len(cells.nodes) for cells in mesh.cells if cells.dimension == 3 and len(cells.nodes)}
    if solids:
        listed = " and ".join(f"{count:,} {kind} cells" for kind, count in solids.items())
        raise MeshError(
            f"the mesh has {listed}, and its boundary is theirs too: a layer under it consists of hexes only. Pad a "
            "set of hexes instead (--set NAME), or the hexes that need it (--around inverted)"
        )
    return region_sheet(mesh, np.ones(mesh.n_hexes, dtype=bool))


def region_sheet(mesh: Mesh, region: np.ndarray) -> Sheet:
    """Return the sheet under all faces of a region of hexes, those towards other hexes included: it is closed.

    Parameters
    ----------
    mesh : Mesh
    region : (m,) bool

    Returns
    -------
    Sheet

    Raises
    ------
    MeshError
        See `check_mesh`.
    """
    check_mesh(mesh)
    across = mesh.topology.hex_neighbours
    return Sheet(mesh, region, np.argwhere(region[:, None] & ((across < 0) | ~region[across])))


def around_sheet(mesh: Mesh, hexes: np.ndarray, rings: int = 1) -> Sheet:
    """Return the sheet that encloses some hexes and rings of hexes around them.

    Where the region that is enclosed touches itself at an edge, the hexes around that edge are added to it.

    Parameters
    ----------
    mesh : Mesh
    hexes : (k,) int
    rings : int
        Number of rings; each adds the hexes that share a node with those before.

    Returns
    -------
    Sheet

    Raises
    ------
    MeshError
        For a hex that does not exist, and see `check_mesh`.
    """
    region = mesh.topology.hexes_around(hexes, rings)[: mesh.n_hexes]
    while True:
        try:
            return region_sheet(mesh, region)
        except CrossingError as error:
            larger = region | (mask(error.nodes, mesh.n_nodes)[mesh.hexes].sum(axis=1) == 2)
            if (larger == region).all():
                raise
            region = larger


def set_sheet(mesh: Mesh, name: str) -> Sheet:
    """Return the sheet under the faces of a set of hexes, sides, quads or nodes.

    Of a set of hexes these are all its faces. A layer under some faces of the boundary ends on the others: there, at
    each edge of its rim, a single hex has a face of the set and one beside it, so that the layer divides the latter.

    Parameters
    ----------
    mesh : Mesh
    name : str
        Of a node set those boundary faces count whose four nodes are in it.

    Returns
    -------
    Sheet

    Raises
    ------
    MeshError
        For a set that does not exist, has no boundary face or no hex, and where its layer cannot be closed; see
        `check_mesh`.
    """
    check_mesh(mesh)
    if name in mesh.hex_sets and name not in mesh.side_sets:
        if not len(mesh.hex_sets[name]):
            raise MeshError(f"the set {name!r} has no hexes: expected one or more, under whose faces a layer is laid")
        return region_sheet(mesh, mask(mesh.hex_sets[name], mesh.n_hexes))
    sides = _boundary_sides(mesh, name)
    sheet = Sheet(mesh, np.ones(mesh.n_hexes, dtype=bool), sides)
    _check_rim(sheet, name)
    return sheet


def check_mesh(mesh: Mesh) -> None:
    """Check that a mesh can be padded.

    Parameters
    ----------
    mesh : Mesh

    Raises
    ------
    MeshError
        For a two-dimensional mesh, one with non-manifold faces, and one with hexes that use a node twice.
    """
    for name, kind in mesh.side_set_types.items():
        if kind in (EMPTY, WEDGE) and len(mesh.side_sets.get(name, ())):
            raise MeshError(
                f"the side {name!r} is of the type {kind}: the mesh is two-dimensional, one layer of hexes thick. "
                "Padding is for meshes in three dimensions"
            )
    if mesh.topology.n_nonmanifold_faces:
        raise MeshError(
            f"{mesh.topology.n_nonmanifold_faces:,} faces (counted once a hex) belong to more than two hexes, or to "
            "two on the same side: find overlapping hexes with hexmend info MESH --doctor, and remove them"
        )
    rows = np.sort(mesh.hexes, axis=1)
    repeated = (rows[:, 1:] == rows[:, :-1]).any(axis=1)
    if repeated.any():
        raise MeshError(
            f"hex {repeated.argmax()} (counted from 0) uses a node twice: expected hexes of eight nodes. Convert it, "
            "or remove it with hexmend repair"
        )


def _boundary_sides(mesh: Mesh, name: str) -> np.ndarray:
    """Find the sides of hexes on the boundary that are in a set, (k, 2) int64."""
    on_boundary = mesh.topology.hex_neighbours < 0
    if name in mesh.side_sets:
        chosen = np.zeros_like(on_boundary)
        rows = mesh.side_sets[name]
        chosen[rows[:, 0], rows[:, 1]] = True
    else:
        quads = [cells.nodes[cells.sets[name]] for cells in mesh.cells if cells.dimension == 2 and name in cells.sets]
        if quads and name not in mesh.node_sets:
            chosen = _sides_on(mesh, quads)
        else:
            chosen = mask(nodes_in_set(mesh, name), mesh.n_nodes)[mesh.hexes[:, FACES]].all(axis=2)
    sides = np.argwhere(chosen & on_boundary)
    if not len(sides):
        raise MeshError(f"the set {name!r} has no face on the boundary: expected a set of boundary faces, or of hexes")
    return sides


def _sides_on(mesh: Mesh, quads: list[np.ndarray]) -> np.ndarray:
    """Mark the boundary sides whose corners are those of one of some quads (j, 4 or more), (m, 6) bool."""
    marks = np.zeros((mesh.n_hexes, 6), dtype=bool)
    sides = np.argwhere(mesh.topology.hex_neighbours < 0)
    corners = np.sort(mesh.hexes[sides[:, :1], FACES[sides[:, 1]]], axis=1)
    given = np.sort(np.concatenate([quad[:, :4] for quad in quads if quad.shape[1] >= 4] or [corners[:0]]), axis=1)
    found = find_rows(given, corners) >= 0
    marks[sides[found, 0], sides[found, 1]] = True
    return marks


def _check_rim(sheet: Sheet, name: str) -> None:
    """Raise where a sheet under boundary faces cannot end on the others."""
    mesh, on_boundary = sheet.mesh, sheet.mesh.topology.hex_neighbours < 0
    rest = on_boundary & ~sheet.is_padded
    behind, side = sheet.faces[sheet.rim[:, 0], 0], sheet.rim[:, 1]
    ends = np.stack([sheet.quads[sheet.rim[:, 0], k % 4] for k in (side, side + 1)], axis=1)
    at_edge = (mesh.hexes[behind][:, FACES][..., None] == ends[:, None, None, :]).any(axis=2).all(axis=2)
    open_ = ~(at_edge & rest[behind]).any(axis=1)
    if open_.any():
        first, count = ends[open_.argmax()], np.count_nonzero(open_)
        raise MeshError(
            f"a layer under the set {name!r} cannot be closed at {count:,} of the {len(open_):,} edges at which it "
            f"ends, such as that between the nodes {first[0]} and {first[1]}: the boundary continues there "
            "flat or into a corner, and a layer that ends there would have hexes with two faces in one plane. Add the "
            "faces next to it to the set, up to a sharp edge, or pad the whole boundary"
        )
    _check_single_copies(sheet, np.unique(ends), name)
    hexes, faces = np.nonzero(rest)
    copies = sheet.copy_of_corner[hexes[:, None], FACES[faces]]
    on_rim = sheet.inner_hexes[behind[:, None], (mesh.hexes[behind][:, None] == ends[:, :, None]).argmax(axis=2)]
    lone = (copies >= 0) & ~mask(on_rim - mesh.n_nodes, len(sheet.originals))[copies]
    if lone.any():
        node = sheet.originals[copies[lone][0]]
        raise MeshError(
            f"a layer under the set {name!r} cannot be closed at node {node}: other faces of the boundary meet the set "
            "there in this node alone. Add these faces to the set, or pad the whole boundary"
        )
    solid = [cells.nodes.ravel() for cells in mesh.cells if cells.dimension == 3]
    shared = np.intersect1d(sheet.originals, np.concatenate(solid)) if solid else np.empty(0)
    if shared.size:
        raise MeshError(
            f"node {shared[0]} of the set {name!r} belongs to a cell that is not a hex: a layer consists of hexes "
            "only. Pad a set of hexes instead"
        )


def _check_single_copies(sheet: Sheet, nodes: np.ndarray, name: str) -> None:
    """Raise if hexes at one of some nodes (k,) of the rim touch there without a common face."""
    mesh = sheet.mesh
    highest = np.full(mesh.n_nodes, -1)
    np.maximum.at(highest, mesh.hexes, sheet.copy_of_corner)
    divided = mask(nodes, mesh.n_nodes)[mesh.hexes] & (sheet.copy_of_corner != highest[mesh.hexes])
    if divided.any():
        raise MeshError(
            f"a layer under the set {name!r} cannot be closed at node {mesh.hexes[divided][0]}: it ends there, and "
            "hexes touch there without a common face. Divide the node, or pad the whole boundary"
        )
