"""Details of one hex and of one node."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.kernels import local
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.solid_cells import PYRAMID, SOLID_KINDS, kinds_of, nouns
from hexmend.mesh.validation import as_index
from hexmend.quality.file_ids import hex_ids, node_ids
from hexmend.quality.measure import corner_qualities, locked_hexes, measure
from hexmend.quality.metric import METRICS
from hexmend.quality.validity import least_jacobian
from hexmend_app.state.node_step.descent import descent


@dataclass(frozen=True, eq=False)
class HexDetails:
    """Details of one hex.

    Parameters
    ----------
    number : int
    kind : str
        Name of its kind in `hexmend.mesh.solid_cells`.
    nodes : (k,) int32
        Numbers of its nodes.
    points : (k, 3) float64
        Positions of its nodes.
    fixed : (k,) bool
        True for fixed nodes.
    corners : (k,) float64
        q(T) at its nodes, see `node_qualities`.
    values : dict
        Value of every metric, by name.
    neighbours : (f,) int32
        Cells across its faces, of a hex x-, x+, y-, y+, z-, z+ of the reference hexahedron; -1 for none.
    inverted, invalid : bool
        As in `ElementQuality`; an inverted hex is invalid too.
    locked : bool
        True if fixed nodes alone keep the hex inverted.
    least_jacobian : float
        Certified lower bound of the least det J over the greatest, from -1 to 1; 0 or less if the hex is invalid.
    file_id : int, optional
        Number of the hex in the file; None if that counts from 0 too, or has none.
    """

    number: int
    kind: str
    nodes: np.ndarray
    points: np.ndarray
    fixed: np.ndarray
    corners: np.ndarray
    values: dict[str, float]
    neighbours: np.ndarray
    inverted: bool
    invalid: bool
    locked: bool
    least_jacobian: float
    file_id: int | None = None


def describe_hex(mesh: Mesh, number: int) -> HexDetails:
    """Collect the details of a hex.

    Parameters
    ----------
    mesh : Mesh
    number : int

    Returns
    -------
    HexDetails

    Raises
    ------
    MeshError
        For a hex that does not exist.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> one = describe_hex(make("cube", size=27), 0)
    >>> one.nodes.size, round(one.values["q"], 6), one.inverted
    (8, 1.0, False)
    """
    number = as_index(number, mesh.n_elements, "hex")
    neighbours, hexes = mesh.topology.face_neighbours[number], np.ascontiguousarray(mesh.elements[number][None])
    kind = SOLID_KINDS[kinds_of(hexes)[0]]
    nodes = hexes[0, : kind.nodes]
    mid_nodes = None if mesh.mid_nodes is None else all_mid_nodes(mesh)[number][None]
    quality = measure(mesh.points, hexes, mid_nodes)
    patch = _patch(mesh, np.concatenate([[number], np.unique(neighbours[(neighbours >= 0) & (neighbours != number)])]))
    of_patch = measure(patch.points, patch.hexes)
    return HexDetails(
        number=number,
        kind=kind.name,
        nodes=nodes,
        points=mesh.points[nodes],
        fixed=mesh.fixed[nodes],
        corners=node_qualities(mesh.points, hexes[0]),
        values={metric.name: float(metric.values(patch, of_patch)[0]) for metric in METRICS.values()},
        neighbours=neighbours[kind.faces[:, 0] >= 0],
        inverted=bool(quality.inverted[0]),
        invalid=bool(quality.invalid[0]),
        locked=bool(locked_hexes(mesh.points, hexes, mesh.fixed, quality.inverted)[0]),
        least_jacobian=least_jacobian(mesh.points, hexes, mid_nodes),
        file_id=_file_id(hex_ids(mesh), number),
    )


def kind_name(mesh: Mesh, number: int) -> str:
    """Return the name of the kind of a cell of a mesh."""
    return SOLID_KINDS[kinds_of(mesh.elements[number][None])[0]].name


def node_qualities(points: np.ndarray, cell: np.ndarray) -> np.ndarray:
    """Return q(T) of the corner tetrahedra at the nodes of a cell (8,), (k,) float64; 0 where sigma <= 0, (2.8).

    A tetrahedron has one at all its nodes, a pyramid none at its apex, which is NaN.
    """
    kind = SOLID_KINDS[kinds_of(cell[None])[0]]
    values = corner_qualities(points, cell[None])[0, : kind.nodes]
    if kind is PYRAMID:
        values[-1] = np.nan
    return values


def all_mid_nodes(mesh: Mesh) -> np.ndarray:
    """Return `Mesh.mid_nodes`, (m, 19) int32, with a row of -1 for each cell that is no hex."""
    others = np.full((mesh.n_elements - mesh.n_hexes, 19), -1, np.int32)
    return np.concatenate([mesh.mid_nodes, others]) if len(others) else mesh.mid_nodes


def _file_id(ids: np.ndarray | None, number: int) -> int | None:
    return None if ids is None else int(ids[number])


def _patch(mesh: Mesh, numbers: np.ndarray) -> Mesh:
    """Return a mesh of some hexes (k,) of a mesh alone, in this order, with what metrics need."""
    hexes, nodes = mesh.elements[numbers], mesh.elements[numbers].ravel()
    mid_nodes = None if mesh.mid_nodes is None else all_mid_nodes(mesh)[numbers]
    if mid_nodes is not None:
        nodes = np.concatenate([nodes, mid_nodes[mid_nodes >= 0]])
    nodes = np.unique(nodes)
    if mid_nodes is not None:
        mid_nodes = np.where(mid_nodes >= 0, np.searchsorted(nodes, mid_nodes), -1).astype(np.int32)
    return Mesh(mesh.points[nodes], np.searchsorted(nodes, hexes).astype(np.int32), mid_nodes=mid_nodes)


@dataclass(frozen=True, eq=False)
class NodeDetails:
    """Details of one node.

    Parameters
    ----------
    number : int
    point : (3,) float64
        Position.
    kind : {"free", "boundary", "interface", "pinned", "fixed", "unused"}
        Reason why smoothing moves the node or does not; fixed: by a rule of motion, or by a node of higher order.
    ring : (k,) int32
        Hexes that have the node as a corner.
    energy : float
        Sum of eta(H)^2 over these hexes, (3.3); +inf if one of them is inverted.
    downhill : (3,) float64
        Negative gradient of that energy with respect to the position, per mean edge length of these hexes; 0 if the
        energy is infinite or the gradient is within rounding, see `hexmend_app.state.node_step.descent.descent`.
    pinned : bool
        True for a pinned node, also on the boundary.
    file_id : int, optional
        Number of the node in the file; None if that counts from 0 too, or has none.
    noun : str
        Word for one of the cells of the ring.
    """

    number: int
    point: np.ndarray
    kind: str
    ring: np.ndarray
    energy: float
    downhill: np.ndarray
    pinned: bool = False
    file_id: int | None = None
    noun: str = "hex"


def describe_node(mesh: Mesh, number: int) -> NodeDetails:
    """Collect the details of a node.

    Parameters
    ----------
    mesh : Mesh
    number : int

    Returns
    -------
    NodeDetails

    Raises
    ------
    MeshError
        For a node that does not exist.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> one = describe_node(make("cube", size=8), 13)
    >>> one.kind, one.ring.size, round(one.energy, 9)
    ('free', 8, 0.0)
    """
    number = as_index(number, mesh.n_nodes, "node")
    star = mesh.topology.node_corners[number]
    ring = star // 8
    file_id = _file_id(node_ids(mesh), number)
    if not ring.size:
        return NodeDetails(number, mesh.points[number], "unused", ring, 0.0, np.zeros(3), file_id=file_id)
    noun, energy = nouns(mesh.elements[ring])[0], float(np.square(measure(mesh.points, mesh.elements[ring]).eta).sum())
    downhill = np.zeros(3)
    if np.isfinite(energy):
        at = local.patch_energy(mesh.points, mesh.elements, star, 0.0, 0.0, (2.0, 1.0))
        xx, xy, xz, yy, yz, zz = at.hessian
        hessian = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        downhill = descent(np.array(at.gradient), hessian, mesh.points[number] * at.factor)
    pinned = mesh.pinned is not None and bool(mesh.pinned[number])
    kind = "boundary" if mesh.topology.boundary[number] else "free"
    if mesh.fixed[number] and kind == "free":
        between = mesh.interfaces is not None and mesh.interfaces.interface_nodes[number]
        kind = "interface" if between and not mesh.immovable[number] else "pinned" if pinned else "fixed"
    return NodeDetails(number, mesh.points[number], kind, ring, energy, downhill, pinned, file_id, noun)
