"""How hexes hang together."""

from __future__ import annotations

import numpy as np

from hexmend.doctor.ailment import Ailment, Finding, ailment
from hexmend.hexahedron import FACES
from hexmend.mesh import Mesh
from hexmend.orientation import parts_of


@ailment
class CrowdedFaces(Ailment):
    """Faces that more than two hexes share."""

    name, title = "crowded-faces", "Non-manifold faces"
    rank = 8

    def find(self, mesh: Mesh, quick: bool = False) -> Finding | None:
        count = mesh.topology.crowded_faces
        if not count:
            return None
        faces = np.sort(mesh.hexes[:, FACES], axis=2).reshape(-1, 4)
        _, which, times = np.unique(faces, axis=0, return_inverse=True, return_counts=True)
        hexes = np.unique(np.flatnonzero(times[which.reshape(-1)] > 2) // 6)
        return Finding(
            self.name, count,
            f"{count:,} faces (counted once a hex) belong to more than two hexes; they are treated as boundary.",
            "Look for overlapping hexes.", hexes=hexes,
        )  # fmt: skip


@ailment
class Parts(Ailment):
    """Parts that hang together with no other."""

    name, title = "parts", "Parts apart"
    rank = 9

    def find(self, mesh: Mesh, quick: bool = False) -> Finding | None:
        more = mesh.topology.parts - 1
        if more < 1:
            return None
        part = parts_of(mesh)
        sizes = np.bincount(part)
        small = np.flatnonzero(part != sizes.argmax())
        return Finding(
            self.name, more,
            f"The mesh has {more:,} part{'s' * (more > 1)} besides the largest that hang together with no other "
            f"({sizes.max():,} hexes, then {', '.join(f'{n:,}' for n in np.sort(sizes)[::-1][1:4])}).",
            "Merge coincident nodes if they should be joined.", hexes=small,
        )  # fmt: skip
