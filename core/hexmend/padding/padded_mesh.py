"""Mesh with a layer of hexes: points, hexes, sets and data."""

from __future__ import annotations

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.padding.inserted_layer import Sheet
from hexmend.padding.mid_nodes import padded_mid_nodes
from hexmend.padding.padded_data import Numbering, extended_data, extended_node_data, extended_set, padded_node_set
from hexmend.padding.placement import displacements, neighbours_behind
from hexmend.padding.sides import padded_cells, padded_side_set


def padded_mesh(sheet: Sheet, thickness: float | None = None) -> Mesh:
    """Return the mesh of a sheet with its new hexes.

    Nodes and hexes keep their numbers; the copies of nodes, further mid-nodes, and the new hexes follow them. A new hex
    has the sets, the material and the data of the hex behind it, and on its outer face the side sets that were there.

    Parameters
    ----------
    sheet : Sheet
    thickness : float, optional
        See `displacements`.

    Returns
    -------
    Mesh
        Without rules of motion; hexes may be inverted.
    """
    mesh, behind = sheet.mesh, sheet.faces[:, 0]
    moves = displacements(sheet, thickness)
    sources, mid_nodes = sheet.originals, None
    if mesh.mid_nodes is not None:
        mid_nodes, more = padded_mid_nodes(sheet)
        sources = np.concatenate([sources, more])
    nodes, share = neighbours_behind(sheet, moves)
    nodes = np.concatenate([nodes, sources[nodes.size :]])
    share = np.concatenate([share, np.zeros(sources.size - share.size)])
    ids = Numbering(mesh.hex_data, *(cells.data for cells in mesh.cells))
    flat = Mesh(
        points=np.concatenate([mesh.points, mesh.points[sources]]),
        hexes=np.concatenate([sheet.inner_hexes, sheet.new_hexes]),
        pinned=None if mesh.pinned is None else np.concatenate([mesh.pinned, np.zeros(sources.size, dtype=bool)]),
        node_data=extended_node_data(mesh.node_data, sources, nodes, share),
        hex_data=extended_data(mesh.hex_data, behind, ids),
        node_sets={name: padded_node_set(sheet, members) for name, members in mesh.node_sets.items()},
        hex_sets={name: extended_set(members, behind, mesh.n_hexes) for name, members in mesh.hex_sets.items()},
        cells=tuple(padded_cells(sheet, cells, mid_nodes, ids) for cells in mesh.cells),
        name=mesh.name,
        side_sets={name: padded_side_set(sheet, sides) for name, sides in mesh.side_sets.items()},
        mid_nodes=mid_nodes,
        field_data=mesh.field_data,
        notes=mesh.notes,
        side_set_types=mesh.side_set_types,
        periodic_pairs=mesh.periodic_pairs,
    )
    points = flat.points.copy()
    points[mesh.n_nodes : mesh.n_nodes + len(moves)] += moves
    return flat.with_points(points)
