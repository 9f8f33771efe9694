"""Problems of corner numbering: left-handed hexes, contradictory faces, and voxels labelled as hexahedra."""

from __future__ import annotations

import numpy as np

from hexmend.arrays import mask
from hexmend.doctor.problem import NONE_FOUND, Finding, Problem, register_problem
from hexmend.mesh.hexahedron import VOXEL_ORDER
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.orientation import left_handed_are, left_handed_hexes, mirror_hexes
from hexmend.mesh.topology.face_parity import face_parity
from hexmend.quality import corner_determinants
from hexmend.terminal_text import count_phrase


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
