"""Checks whether the parts of a mesh tell all that a run needs, or only the whole mesh does.

Orientation of hexes of a divided mesh: left-handed ones are found, renumbered and refused as in one process.

Figures of a divided mesh as a whole.
"""

from __future__ import annotations

import numpy as np

from hexmend.io.formats.vtk.grid import HEXAHEDRON, KIND_BY_TYPE, WIDTH_BY_TYPE
from hexmend.io.formats.vtk.merge_grids import GHOSTS
from hexmend.io.slices import GridSlice
from hexmend.kernels import elements
from hexmend.layers.detection import THIN, sizes_at_wall
from hexmend.mesh.cells import CELL_KINDS
from hexmend.mesh.edge_length import edge_lengths, robust_mean, sample_stride
from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.materials import is_name_of_materials
from hexmend.mesh.orientation import all_corners_negative, are_left_handed, left_handed_error, signed_volumes
from hexmend.mesh.topology import Topology
from hexmend.mesh.topology.face_parity import face_parity, signed_components
from hexmend.quality import measure
from hexmend.quality.measure import locked_hexes
from hexmend.quality.validity import least_jacobian
from hexmend.ranks.divided.divided_mesh import DividedMesh
from hexmend.ranks.mpi_ranks import MPIRanks
from hexmend.ranks.rank_part import RankPart
from hexmend.summary import Summary
from hexmend.terminal_text import count_phrase


def mean_edge_length(part: RankPart, hex_ids: np.ndarray) -> float:
    """Compute the mean edge length of the whole mesh; see `hexmend.mesh.edge_length.mean_edge_length`.

    All ranks call it together; `hex_ids` (m,) are the numbers of the hexes of the part.
    """
    mesh, ranks = part.mesh, part.ranks
    own = mesh.hexes[part.counted]
    total = elements.mean_edge_length(mesh.points, own) * len(own) if len(own) else 0.0
    sampled = part.counted & (hex_ids % sample_stride(part.n_hexes) == 0)
    sample = ranks.gather(edge_lengths(mesh.points, mesh.hexes[sampled]))
    return robust_mean(ranks.sum(total) / part.n_hexes, sample)


def summarise_part(part: RankPart, points: np.ndarray) -> Summary:
    """Summarise the whole mesh, whose part has points (n, 3); all ranks call it together."""
    ranks, own, hexes = part.ranks, part.counted, part.mesh.hexes
    quality = measure(points, hexes)
    q, m = quality.q[own], part.n_hexes
    mean = ranks.sum(float(q.sum())) / m
    locked = locked_hexes(points, hexes, part.mesh.fixed, quality.inverted)
    inverted = ranks.sum(int(np.count_nonzero(quality.inverted & own)))
    least = ranks.least(float(q.min(initial=np.inf)))
    squares = ranks.sum(float(np.sum(1 / np.square(q[q > 0]))))
    lowest = least_jacobian(points, np.ascontiguousarray(hexes[own])) if own.any() else 1.0
    total = ranks.sum(float(np.square(quality.eta[own]).sum())) if not inverted else np.inf
    of_hexes = {
        "count": m,
        "inverted": inverted,
        "invalid": ranks.sum(int(np.count_nonzero(quality.invalid & own))),
        "q_min": least,
        "q_mean": mean,
        "scaled_jacobian_min": ranks.least(float(quality.scaled_jacobian[own].min(initial=np.inf))),
    }
    return Summary(
        hexes=m,
        nodes=ranks.sum(int(np.count_nonzero(part.owned))),
        free_nodes=ranks.sum(int(np.count_nonzero(part.mesh.free & part.owned))),
        inverted=inverted,
        invalid=int(of_hexes["invalid"]),
        min_jacobian=ranks.least(lowest),
        locked_inverted=ranks.sum(int(np.count_nonzero(locked & own))),
        q_min=least,
        q_mean=mean,
        q_max=ranks.greatest(float(q.max(initial=-np.inf))),
        q_std=float(np.sqrt(ranks.sum(float(np.square(q - mean).sum())) / m)),
        q_norm=float(np.sqrt(m / squares)) if least > 0 else 0.0,
        scaled_jacobian_min=of_hexes["scaled_jacobian_min"],
        objective=total if np.isfinite(total) else None,
        cells={"hexahedron": of_hexes},
    )


def check_divided_orientation(mesh: DividedMesh) -> None:
    """Check that no hex is numbered left-handed; all ranks call it together.

    Raises
    ------
    MeshError
        On all ranks, where hexes are.
    """
    part = mesh.part
    which = left_handed_hexes(part.ranks, part.mesh.points, part.mesh.hexes, mesh.hex_ids, part.owned)
    count = part.ranks.sum(int(np.count_nonzero(which & part.counted)))
    if count:
        raise left_handed_error(count_phrase(count, "hex is", "hexes are"))


def left_handed_hexes(
    ranks: MPIRanks, points: np.ndarray, hexes: np.ndarray, ids: np.ndarray, owned: np.ndarray
) -> np.ndarray:
    """Find the hexes of a rank's part that are numbered left-handed in the whole mesh; all ranks call it together.

    Each rank solves the parity of its own hexes (`face_parity`); hexes that several ranks have connect their
    components.

    Parameters
    ----------
    ranks : MPIRanks
    points : (n, 3) float64
    hexes : (m, 8) int32
        All hexes at the nodes that the rank owns.
    ids : (m,) int
        Their numbers in the whole mesh.
    owned : (n,) bool

    Returns
    -------
    (m,) bool
    """
    volume = signed_volumes(points, hexes)
    if not ranks.any(volume < 0):
        return np.zeros(len(hexes), dtype=bool)
    of_own = owned[hexes[:, FACES]].any(axis=2)  # all hexes at such a face are here
    component, sign = face_parity(hexes, np.where(of_own, Topology(hexes, len(points)).neighbours_in_any_order, -1))
    component, sign = _in_whole_mesh(ranks, component, sign, ids, ~owned[hexes].all(axis=1))
    group, of_hex = np.unique(3 * component + sign + 1, return_inverse=True)  # alike in the whole mesh
    counted = owned[hexes[:, 0]]
    values = volume, np.sign(volume), all_corners_negative(points, hexes, volume)
    sums = [np.bincount(of_hex[counted], one[counted], len(group)) for one in values]
    rows = ranks.gather(np.stack([group, *sums], axis=1))
    components, signs = np.divmod(rows[:, 0].astype(np.int64), 3)
    return np.isin(group, rows[are_left_handed(components, signs - 1, *rows[:, 1:].T), 0])[of_hex]


def _in_whole_mesh(
    ranks: MPIRanks, component: np.ndarray, sign: np.ndarray, ids: np.ndarray, shared: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Convert components and signs of hexes from a rank's part to the whole mesh; `shared` has the other parts'."""
    first, component = np.unique(component, return_inverse=True)
    counts = ranks.gather(np.array([first.size]))
    component = component + counts[: ranks.number].sum()
    rows = ranks.gather(np.stack([ids, component, sign], axis=1)[shared | (sign == 0)])
    rows = rows[np.argsort(rows[:, 0], kind="stable")]
    same = rows[1:, 0] == rows[:-1, 0]
    none = rows[rows[:, 2] == 0, 1]
    pairs = np.concatenate([np.stack([rows[:-1, 1], rows[1:, 1]], axis=1)[same], np.stack([none, none], axis=1)])
    unlike = np.concatenate([(rows[:-1, 2] != rows[1:, 2])[same], np.ones(none.size, dtype=bool)])
    whole, sign_of = signed_components(int(counts.sum()), pairs, unlike)
    return whole[component], sign * sign_of[component]


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
