"""What comes with a mesh besides points and hexes, in words."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping

import numpy as np

from hexmend.io.base.content import ID
from hexmend.io.base.fixed_marks import held_by_pins, needs_marks
from hexmend.io.base.format import Capability
from hexmend.mesh.mesh import Mesh

#: Whole numbers up to here are the same as real ones.
_EXACT = 1 << 53


def found_in(mesh: Mesh, names: Collection[str] = ()) -> dict[Capability, str]:
    """What a mesh has of what formats can hold or cannot, each with its names, as "point data (temperature)".

    Data and sets of some `names` are passed over.
    """
    data = [mesh.hex_data, *(cells.data for cells in mesh.cells)]
    volumes = [mesh.hex_sets, *(cells.sets for cells in mesh.cells if cells.dimension == 3)]
    lower = [cells.sets for cells in mesh.cells if cells.dimension < 3]
    kinds = {
        Capability.NODE_DATA: [name for name in mesh.node_data if name not in (ID, held_by_pins(mesh))],
        Capability.HEX_DATA: [name for name in _all(data) if name != ID],
        Capability.IDS: [""] if ID in mesh.node_data or ID in _all(data) else [],
        Capability.NODE_SETS: _filled([mesh.node_sets]),
        Capability.HEX_SETS: _filled(volumes),
        Capability.CELL_SETS: _filled(lower),
        Capability.SIDE_SETS: _filled([mesh.side_sets]),
        Capability.EMPTY_SETS: [
            name
            for sets in ([mesh.node_sets], [*volumes, *lower], [mesh.side_sets])
            for name in set(_all(sets)) - set(_filled(sets))
        ],
        Capability.PINS: [""] if needs_marks(mesh) else [],
        Capability.LOWER_CELLS: [""] if any(0 < cells.dimension < 3 for cells in mesh.cells) else [],
        Capability.VERTICES: [""] if any(cells.dimension == 0 for cells in mesh.cells) else [],
        Capability.OTHER_CELLS: [""] if any(cells.dimension == 3 for cells in mesh.cells) else [],
        Capability.SECOND_ORDER: [""] if mesh.mid_nodes is not None else [],
        Capability.FIELD_DATA: list(mesh.field_data),
    }
    left = {kind: [name for name in found if name not in names] for kind, found in kinds.items()}
    return {
        kind: f"{kind.value} ({', '.join(sorted(found))})" if any(found) else kind.value
        for kind, found in left.items()
        if found
    }


def rounded(mesh: Mesh) -> list[str]:
    """That whole numbers are rounded by a format whose data are real numbers, in words; nothing where none are."""
    left = []
    for what, arrays in arrays_of(mesh).items():
        names = {name for name, values in arrays if values.dtype.kind in "iu" and _beyond(values)}
        left += [f"whole numbers of {what} above 2^53, which are rounded ({', '.join(sorted(names))})"] if names else []
    return left


def no_numbers(mesh: Mesh) -> list[str]:
    """Data that are texts or complex numbers, in words, for formats whose data are numbers; nothing where none are."""
    left = []
    for what, arrays in arrays_of(mesh).items():
        names = {name for name, values in arrays if values.dtype.kind not in "biuf"}
        left += [f"{what} that are no numbers ({', '.join(sorted(names))})"] if names else []
    return left


def arrays_of(mesh: Mesh) -> dict[str, list[tuple[str, np.ndarray]]]:
    """Names and values of all data but ids, those of nodes as "point data" and those of cells as "cell data"."""
    parts = {"point data": [mesh.node_data], "cell data": [mesh.hex_data, *(cells.data for cells in mesh.cells)]}
    return {
        what: [(name, np.asarray(values)) for one in data for name, values in one.items() if name != ID]
        for what, data in parts.items()
    }


def _beyond(values: np.ndarray) -> bool:
    return bool(((values > _EXACT) | (values < -_EXACT)).any())


def _filled(parts: Iterable[Mapping[str, np.ndarray]]) -> list[str]:
    """The names of sets that have members in some part, each once."""
    return list(dict.fromkeys(name for part in parts for name, members in part.items() if len(members)))


def _all(parts: Iterable[Mapping[str, object]]) -> list[str]:
    """The names of all parts, each once."""
    return list(dict.fromkeys(name for part in parts for name in part))
