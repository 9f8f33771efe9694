"""What comes with a mesh besides points and hexes, in words."""

from __future__ import annotations

from collections.abc import Collection

from hexmend.io.content import FIXED, ID
from hexmend.io.format import Holds
from hexmend.mesh import Mesh


def found_in(mesh: Mesh, names: Collection[str] = ()) -> dict[Holds, str]:
    """What a mesh has of what formats can hold or cannot, each with its names, as "point data (temperature)".

    Data and sets of some `names` are passed over.
    """
    data = [name for name in mesh.node_data if name != ID and name.lower() != FIXED]
    kinds = {
        Holds.NODE_DATA: data,
        Holds.HEX_DATA: [name for name in mesh.hex_data if name != ID],
        Holds.IDS: [""] if ID in mesh.node_data or ID in mesh.hex_data else [],
        Holds.NODE_SETS: list(mesh.node_sets),
        Holds.HEX_SETS: list(mesh.hex_sets),
        Holds.SIDE_SETS: list(mesh.side_sets),
        Holds.PINS: [""] if mesh.pinned is not None and mesh.pinned.any() else [],
        Holds.LOWER_CELLS: [""] if any(0 < cells.dimension < 3 for cells in mesh.cells) else [],
        Holds.VERTICES: [""] if any(cells.dimension == 0 for cells in mesh.cells) else [],
        Holds.OTHER_CELLS: [""] if any(cells.dimension == 3 for cells in mesh.cells) else [],
        Holds.SECOND_ORDER: [""] if mesh.mid_nodes is not None else [],
        Holds.FIELD_DATA: list(mesh.field_data),
    }
    left = {kind: [name for name in found if name not in names] for kind, found in kinds.items()}
    return {
        kind: f"{kind.value} ({', '.join(sorted(found))})" if any(found) else kind.value
        for kind, found in left.items()
        if found
    }
