"""Problems of corner numbering: mirrored parts, flipped hexes, and voxels labelled as hexahedra."""

from __future__ import annotations

import numpy as np

from hexmend.doctor.problem import NONE_FOUND, Finding, Problem, register_problem
from hexmend.mesh.hexahedron import FACES, VOXEL_ORDER
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.orientation import mirror_hexes, mirrored_parts, whole_parts_are
from hexmend.quality import corner_determinants
from hexmend.terminal_text import count_phrase

_RENUMBER = "Reverse their numbering; the nodes stay in place."


@register_problem
class MirroredParts(Problem):
    """Parts numbered left-handed; readers renumber them unless asked to keep the mesh as it is."""

    name, title = "mirrored-parts", "Mirrored parts"
    rank = 0
    remedy = _RENUMBER
    action = "reverse the numbering of their hexes"

    def locate(self, mesh: Mesh, quick: bool = False) -> np.ndarray:
        return np.flatnonzero(mirrored_parts(mesh))

    def describe(self, mesh: Mesh, where: np.ndarray) -> Finding:
        are = whole_parts_are(where.size, mesh.n_hexes)
        return self.finding(where, f"{are} inside out: corners are numbered left-handed.")

    def mend(self, mesh: Mesh) -> Mesh:
        return mirror_hexes(mesh, mirrored_parts(mesh))


@register_problem
class FlippedHexes(Problem):
    """Single hexes numbered left-handed among valid neighbours: wrong numbering, not tangling."""

    name, title = "flipped-hexes", "Flipped hexes"
    rank = 2
    remedy = _RENUMBER
    action = "reverse their numbering"

    def locate(self, mesh: Mesh, quick: bool = False) -> np.ndarray:
        return np.flatnonzero(self._which(mesh))

    def describe(self, mesh: Mesh, where: np.ndarray) -> Finding:
        return self.finding(
            where,
            f"{count_phrase(where.size, 'hex is', 'hexes are')} numbered left-handed, and valid if numbered like "
            "their neighbours.",
        )

    def mend(self, mesh: Mesh) -> Mesh:
        return mirror_hexes(mesh, self._which(mesh))

    def _which(self, mesh: Mesh) -> np.ndarray:
        sigma = corner_determinants(mesh.points, mesh.hexes)
        inside_out, sound = (sigma < 0).all(axis=1), (sigma > 0).all(axis=1)
        inside_out &= ~mirrored_parts(mesh)
        rows = np.flatnonzero(inside_out)
        mirrored = mirror_hexes(mesh, inside_out)  # whose faces have their nodes in the order of the neighbours
        neighbours = mirrored.topology.face_neighbours[rows]
        inner = neighbours >= 0
        fine = ~inner | (sound | inside_out)[neighbours] & _on_opposite_sides(mirrored, rows, neighbours)
        inside_out[rows] = fine.all(axis=1) & (inner & sound[neighbours]).any(axis=1)
        return inside_out


def _on_opposite_sides(mesh: Mesh, rows: np.ndarray, neighbours: np.ndarray) -> np.ndarray:
    """True if hexes (k,) and their neighbours (k, 6) lie on opposite sides of their common face, (k, 6) bool."""
    faces = mesh.points[mesh.hexes[rows][:, FACES]]
    middle = faces.mean(axis=2)
    normal = np.cross(faces[:, :, 2] - faces[:, :, 0], faces[:, :, 3] - faces[:, :, 1])
    own = mesh.points[mesh.hexes[rows]].mean(axis=1)[:, None]
    other = mesh.points[mesh.hexes[neighbours]].mean(axis=2)
    return ((own - middle) * normal).sum(axis=2) * ((other - middle) * normal).sum(axis=2) < 0


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
        alone = (mesh.topology.face_neighbours[:, :2] < 0).all(axis=1)
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
