"""Problems of connectivity: non-manifold faces, corners that overlap, and disconnected parts.

Problems of corner numbering: left-handed hexes, contradictory faces, and voxels labelled as hexahedra.

Problems of hexes: duplicates, and hexes with repeated nodes.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from hexmend.arrays import mask
from hexmend.doctor.problem import NONE_FOUND, Finding, Problem, register_problem
from hexmend.locking import describe_overlap, hexes_without_valid_position, nodes_without_valid_position
from hexmend.mesh.collapsed_hexes import are_flat, has_repeated_node, keep_hexes, with_collapsed_converted
from hexmend.mesh.hexahedron import FACES, VOXEL_ORDER
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.orientation import left_handed_are, left_handed_hexes, mirror_hexes, parts_of
from hexmend.mesh.topology.face_parity import face_parity
from hexmend.quality import corner_determinants
from hexmend.terminal_text import count_phrase


@register_problem
class NonManifoldFaces(Problem):
    """Faces of more than two hexes, or of two on the same side."""

    name, title = "crowded-faces", "Non-manifold faces"
    rank = 8
    remedy = "Look for overlapping hexes."

    def locate(self, mesh: Mesh, quick: bool = False) -> np.ndarray:
        if not mesh.topology.n_nonmanifold_faces:
            return NONE_FOUND
        faces = np.sort(mesh.hexes[:, FACES], axis=2).reshape(-1, 4)
        _, which, times = np.unique(faces, axis=0, return_inverse=True, return_counts=True)
        alone = mesh.topology.face_neighbours[: mesh.n_hexes].ravel() < 0
        return np.unique(np.flatnonzero(alone & (times[which.reshape(-1)] > 1)) // 6)

    def describe(self, mesh: Mesh, where: np.ndarray) -> Finding:
        count = mesh.topology.n_nonmanifold_faces
        faces = count_phrase(count, "face (counted once a hex) belongs", "faces (counted once a hex) belong")
        return self.finding(
            where,
            f"{faces} to more than two hexes, or to two on the same side; {'it is' if count == 1 else 'they are'} "
            "treated as boundary.",
            count=count,
        )


@register_problem
class OverlappingCorners(Problem):
    """Hexes that overlap or are inverted wherever the nodes are: `hexmend.locking.hexes_without_valid_position`."""

    name, title = "overlapping-corners", "Overlapping corners"
    rank = 11
    remedy = "Correct the connectivity there where the mesh was made."

    def locate(self, mesh: Mesh, quick: bool = False) -> np.ndarray:
        return hexes_without_valid_position(mesh)

    def describe(self, mesh: Mesh, where: np.ndarray) -> Finding:
        return replace(self.finding(where, describe_overlap(mesh)), nodes=nodes_without_valid_position(mesh))


@register_problem
class DisconnectedParts(Problem):
    """Parts of the mesh that neither hexes nor other cells connect."""

    name, title = "parts", "Parts apart"
    rank = 9
    remedy = (
        "Each is smoothed by itself. If they should be one, merge their coincident nodes, of one material and without "
        "contact cards: hexmend repair MESH -o OUT --only coincident-nodes, or Edit > Doctor in the window."
    )

    def locate(self, mesh: Mesh, quick: bool = False) -> np.ndarray:
        if mesh.topology.parts < 2:
            return NONE_FOUND
        part = parts_of(mesh, others=True)
        return np.flatnonzero(part != np.bincount(part).argmax())

    def describe(self, mesh: Mesh, where: np.ndarray) -> Finding:
        sizes = np.sort(np.bincount(parts_of(mesh, others=True)))[::-1]
        more = len(sizes) - 1
        if more > 2:
            listed, last = sizes[:3], f"{more - 2:,} others"
        else:
            listed, last = sizes[:-1], count_phrase(int(sizes[-1]), "hex", "hexes")
        largest = ", ".join(f"{size:,}" for size in listed)
        text = f"The mesh consists of {len(sizes):,} parts that are not connected: {largest} and {last}."
        return self.finding(where, text, count=len(sizes))


@register_problem
class LeftHandedHexes(Problem):
    """Hexes numbered left-handed; readers renumber them unless asked to keep the mesh as it is."""

    name, title = "left-handed-hexes", "Left-handed hexes"
    rank = 0
    remedy = "Reverse their numbering; the nodes stay in place."
    action = "reverse their numbering"

    def locate(self, mesh: Mesh, quick: bool = False) -> np.ndarray:
        return np.flatnonzero(left_handed_hexes(mesh))

    def describe(self, mesh: Mesh, where: np.ndarray) -> Finding:
        are = left_handed_are(mesh, mask(where, mesh.n_hexes))
        return self.finding(where, f"{are} inside out: corners are numbered left-handed.")

    def mend(self, mesh: Mesh) -> Mesh:
        return mirror_hexes(mesh, left_handed_hexes(mesh))


@register_problem
class ContradictoryFaces(Problem):
    """Hexes that cannot all be numbered alike, as in a ring that is closed by a reflection."""

    name, title = "contradictory-faces", "Contradictory faces"
    rank = 2
    remedy = "No numbering makes all of them valid: correct the hexes that close a ring where the mesh was made."

    def locate(self, mesh: Mesh, quick: bool = False) -> np.ndarray:
        return np.flatnonzero(face_parity(mesh.hexes, mesh.topology.neighbours_in_any_order)[1] == 0)

    def describe(self, mesh: Mesh, where: np.ndarray) -> Finding:
        hexes = count_phrase(where.size, "hex shares", "hexes share")
        return self.finding(where, f"{hexes} faces so that one is left-handed in any numbering (non-orientable).")


@register_problem
class VoxelOrder(Problem):
    """Hexes with corners in the order of VTK's voxel, which makes them twisted."""

    name, title = "voxel-order", "Voxels labelled as hexahedra"
    rank = 1
    remedy = "Put their corners in the order of hexahedra (type 12)."
    action = "put their corners in the order of hexahedra"

    def locate(self, mesh: Mesh, quick: bool = False) -> np.ndarray:
        if mesh.mid_nodes is not None:
            return NONE_FOUND
        # In the wrong order x- and x+ are not faces of the hex, so that no neighbour shares them.
        alone = (mesh.topology.neighbours_in_any_order[:, :2] < 0).all(axis=1)
        twisted = np.flatnonzero(alone & (corner_determinants(mesh.points, mesh.hexes) <= 0).any(axis=1))
        return twisted[(corner_determinants(mesh.points, mesh.hexes[twisted][:, VOXEL_ORDER]) > 0).all(axis=1)]

    def describe(self, mesh: Mesh, where: np.ndarray) -> Finding:
        return self.finding(
            where,
            f"{count_phrase(where.size, 'hex is', 'hexes are')} twisted, and valid with corners read in the order of "
            "voxels (VTK type 11).",
        )

    def mend(self, mesh: Mesh) -> Mesh:
        which = self.locate(mesh)
        hexes = mesh.hexes.copy()
        hexes[which] = hexes[which][:, VOXEL_ORDER]
        return mesh.rebuilt(hexes=hexes)


@register_problem
class DuplicateHexes(Problem):
    """Hexes with the same nodes as an earlier hex."""

    name, title = "duplicate-hexes", "Duplicate hexes"
    rank = 3
    remedy = "Remove the duplicates."
    action = "keep the first of each"

    def locate(self, mesh: Mesh, quick: bool = False) -> np.ndarray:
        return np.flatnonzero(_repeated(np.sort(mesh.hexes, axis=1)))

    def describe(self, mesh: Mesh, where: np.ndarray) -> Finding:
        phrase = count_phrase(where.size, "hex stands", "hexes stand")
        return self.finding(where, f"{phrase} on the nodes of others.")

    def mend(self, mesh: Mesh) -> Mesh:
        _, first, which = np.unique(np.sort(mesh.hexes, axis=1), axis=0, return_index=True, return_inverse=True)
        representative = first[which.reshape(-1)]
        return keep_hexes(mesh, representative == np.arange(mesh.n_hexes), representative)


@register_problem
class DegenerateHexes(Problem):
    """Hexes that use a node twice: their collapsed edges make good corners impossible."""

    name, title = "degenerate-hexes", "Collapsed hexes"
    rank = 5
    remedy = "Convert them to wedges, pyramids and tetrahedra, or remesh them."
    action = "make wedges, pyramids and tetrahedra of those that are, and remove flat ones, with the sides on them"

    def locate(self, mesh: Mesh, quick: bool = False) -> np.ndarray:
        return np.flatnonzero(has_repeated_node(mesh.hexes))

    def describe(self, mesh: Mesh, where: np.ndarray) -> Finding:
        flat = np.count_nonzero(are_flat(mesh.points, mesh.hexes[where]))
        return self.finding(
            where,
            f"{count_phrase(where.size, 'hex uses', 'hexes use')} a node twice, so that edges are collapsed"
            f"{f'; {flat:,} of them are flat' if flat else ''}: as hexes they can never be good.",
            mendable=self.mend(mesh) is not mesh,
        )

    def mend(self, mesh: Mesh) -> Mesh:
        converted = with_collapsed_converted(mesh)[0]
        where = self.locate(converted)
        flat = where[are_flat(converted.points, converted.hexes[where])]
        if not 0 < flat.size < converted.n_elements:
            return converted
        return keep_hexes(converted, ~np.isin(np.arange(converted.n_hexes), flat))


def _repeated(rows: np.ndarray) -> np.ndarray:
    """True for rows (n, k) that are equal to an earlier row, (n,) bool."""
    order = np.lexsort(rows.T)
    same = (rows[order][1:] == rows[order][:-1]).all(axis=1)
    again = np.zeros(len(rows), dtype=bool)
    again[order[1:][same]] = True  # lexsort is stable: the first of equal rows comes first
    return again
