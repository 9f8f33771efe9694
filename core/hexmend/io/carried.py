"""What comes with a mesh besides points and hexes, in words."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping

from hexmend.io.content import ID
from hexmend.io.format import Holds
from hexmend.io.pins import held_by_pins
from hexmend.mesh import Mesh


def found_in(mesh: Mesh, names: Collection[str] = ()) -> dict[Holds, str]:
    """What a mesh has of what formats can hold or cannot, each with its names, as "point data (temperature)".

    Data and sets of some `names` are passed over.
    """
    data = [mesh.hex_data, *(cells.data for cells in mesh.cells)]
    volumes = [mesh.hex_sets, *(cells.sets for cells in mesh.cells if cells.dimension == 3)]
    lower = [cells.sets for cells in mesh.cells if cells.dimension < 3]
    kinds = {
        Holds.NODE_DATA: [name for name in mesh.node_data if name not in (ID, held_by_pins(mesh))],
        Holds.HEX_DATA: [name for name in _all(data) if name != ID],
        Holds.IDS: [""] if ID in mesh.node_data or ID in _all(data) else [],
        Holds.NODE_SETS: list(mesh.node_sets),
        Holds.HEX_SETS: _all(volumes),
        Holds.CELL_SETS: _all(lower),
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


def _all(parts: Iterable[Mapping[str, object]]) -> list[str]:
    """The names of all parts, each once."""
    return list(dict.fromkeys(name for part in parts for name in part))
