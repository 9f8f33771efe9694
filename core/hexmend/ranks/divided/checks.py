"""Checks whether the parts of a mesh tell all that a run needs, or only the whole mesh does."""

from __future__ import annotations

import numpy as np

from hexmend.io.formats.vtk.grid import HEXAHEDRON, KIND_BY_TYPE, WIDTH_BY_TYPE
from hexmend.io.formats.vtk.merge_grids import GHOSTS
from hexmend.io.slices import GridSlice
from hexmend.layers.detection import THIN, sizes_at_wall
from hexmend.mesh.cells import CELL_KINDS
from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.materials import is_name_of_materials
from hexmend.ranks.mpi_ranks import MPIRanks
from hexmend.ranks.rank_part import RankPart

#: Prefix of arrays of ones and zeros that hold sets.
_SET = "set:"
#: Walls with a smaller share of the boundary's faces are not looked for: a scrambled mesh has thin hexes anywhere.
_LEAST_SHARE = 1 / 300


class NotDivisibleError(Exception):
    """One process has to read the whole mesh; the text says why."""


def check_divisible(ranks: MPIRanks, piece: GridSlice, n_nodes: int) -> None:
    """Check the slices that the ranks have read; they call it together.

    Cells other than hexes may be of lower dimension only; others, and errors in the file, are left to a reader of the
    whole. So are materials, whose interfaces are kept.

    Raises
    ------
    NotDivisibleError
        On all ranks.
    """
    schema = [[(name, np.asarray(rows).dtype.str, rows.shape[1:]) for name, rows in data.items()]
              for data in (piece.node_data, piece.cell_data)]  # fmt: skip
    if any(other != schema for other in ranks.comm.allgather(schema)):
        raise NotDivisibleError("its pieces have different data")
    if any(ranks.any(piece.cell_data[name] & bits) for name, bits in GHOSTS.items() if name in piece.cell_data):
        raise NotDivisibleError("it has ghost cells")
    if ranks.any(not _has_known_cells(piece)) or not ranks.any(piece.types == HEXAHEDRON):
        raise NotDivisibleError("it has cells other than hexes of eight nodes and their faces and edges")
    wrong = (piece.nodes < 0) | (piece.nodes >= n_nodes)
    if ranks.any(wrong) or ranks.any(~np.isfinite(piece.points)) or not _is_complete(ranks, piece, n_nodes):
        raise NotDivisibleError("its numbers of nodes or its coordinates have to be looked at")
    if any(_tells_materials(ranks, name, rows[piece.types == HEXAHEDRON]) for name, rows in piece.cell_data.items()):
        raise NotDivisibleError("it has materials or sets of hexes")


def check_nodes(ranks: MPIRanks, at: np.ndarray, rows: np.ndarray, points: np.ndarray) -> None:
    """Check the rows (j, 3) that a rank has got of the nodes at (j,) that it keeps, whose points are (k, 3).

    Raises
    ------
    NotDivisibleError
        On all ranks, where one number is that of nodes at different places, or of none.
    """
    has = np.zeros(len(points), dtype=bool)
    has[at] = True
    if ranks.any(~has) or ranks.any(points[at] != rows):
        raise NotDivisibleError("its numbers of nodes or its coordinates have to be looked at")


def _has_known_cells(piece: GridSlice) -> bool:
    """Return True if all cells are hexes of eight nodes, or of lower dimension."""
    flat = {number for number, kind in KIND_BY_TYPE.items() if kind in CELL_KINDS and CELL_KINDS[kind].dimension < 3}
    allowed = [*sorted(flat), HEXAHEDRON]
    widths = np.full(256, -1)
    widths[allowed] = [WIDTH_BY_TYPE[number] for number in allowed]
    return bool((widths[piece.types] == np.diff(piece.start)).all())


def _is_complete(ranks: MPIRanks, piece: GridSlice, n_nodes: int) -> bool:
    """Return True if all ranks together have each cell once, and at least as many rows of nodes as there are nodes."""
    cells = ranks.sum(len(piece.cell_ids)), ranks.greatest(int(piece.cell_ids.max(initial=-1))) + 1
    return cells[0] == cells[1] and ranks.sum(len(piece.node_ids)) >= n_nodes


def _tells_materials(ranks: MPIRanks, name: str, values: np.ndarray) -> bool:
    """Return True on all ranks if data of their hexes may divide these into materials."""
    if not name.startswith(_SET) and not is_name_of_materials(name):
        return False
    rows = np.asarray(values, np.float64).reshape(len(values), -1)
    low, high = ranks.least(float(rows.min(initial=np.inf))), ranks.greatest(float(rows.max(initial=-np.inf)))
    return low != high


def may_have_layers(part: RankPart) -> bool:
    """Return False if the divided mesh has no boundary layers; all ranks call it together.

    Only the whole mesh tells whether it has, see `hexmend.layers.find_layers`. Volumes over several faces tell thin
    hexes: single edges of a scrambled mesh may be short anywhere.
    """
    mesh, ranks = part.mesh, part.ranks
    hexes, faces = np.nonzero(mesh.topology.face_neighbours < 0)
    quads = mesh.hexes[hexes[:, None], FACES[faces]]
    real = part.owned[quads].any(axis=1)  # others are where the part ends
    hexes, faces, quads = hexes[real], faces[real], quads[real]
    volume, area, side = sizes_at_wall(mesh, hexes, faces)
    nodes = quads.ravel()
    at_nodes = (ranks.complete(np.bincount(nodes, np.repeat(of, 4), mesh.n_nodes)) for of in (volume, area))
    volumes, areas = (values[quads].sum(axis=1) for values in at_nodes)
    thin = volumes * THIN < side * areas
    counted = part.counted[hexes]
    share = _LEAST_SHARE * ranks.sum(int(np.count_nonzero(counted)))
    return ranks.sum(int(np.count_nonzero(thin & counted))) >= max(1, share)
