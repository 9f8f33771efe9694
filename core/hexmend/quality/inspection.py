"""One element and one node looked at closely, and which elements are the worst."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.errors import MeshError
from hexmend.kernels.objective import gradient
from hexmend.mesh.hexahedron import EDGES
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.validation import as_index, as_reals
from hexmend.quality.measure import ElementQuality, corner_qualities, locked, measure
from hexmend.quality.metric import METRICS


@dataclass(frozen=True, eq=False)
class HexDetails:
    """What there is to know of one hex.

    Parameters
    ----------
    number : int
    nodes : (8,) int32
    points : (8, 3) float64
    fixed : (8,) bool
        Which of its nodes smoothing leaves where they are.
    corners : (8,) float64
        q(T) of the corner tetrahedra, (2.8); 0 where sigma <= 0.
    values : dict
        Of every metric, by name.
    neighbours : (6,) int32
        Across the faces x-, x+, y-, y+, z-, z+ of the reference hexahedron; -1 for none.
    inverted : bool
    locked : bool
        Whether fixed nodes keep it inverted.
    """

    number: int
    nodes: np.ndarray
    points: np.ndarray
    fixed: np.ndarray
    corners: np.ndarray
    values: dict[str, float]
    neighbours: np.ndarray
    inverted: bool
    locked: bool


def describe_hex(mesh: Mesh, number: int) -> HexDetails:
    """Look at a hex of a mesh.

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
    number = as_index(number, mesh.n_hexes, "hex")
    nodes = mesh.hexes[number]
    hexes = np.ascontiguousarray(nodes[None])
    figures = measure(mesh.points, hexes)
    return HexDetails(
        number=number,
        nodes=nodes,
        points=mesh.points[nodes],
        fixed=mesh.fixed[nodes],
        corners=corner_qualities(mesh.points, hexes)[0],
        values={metric.name: float(metric.of(mesh.points, hexes, figures)[0]) for metric in METRICS.values()},
        neighbours=mesh.topology.face_neighbours[number],
        inverted=bool(figures.inverted[0]),
        locked=bool(locked(mesh.points, hexes, mesh.fixed, figures.inverted)[0]),
    )


@dataclass(frozen=True, eq=False)
class NodeDetails:
    """What there is to know of one node.

    Parameters
    ----------
    number : int
    point : (3,) float64
    kind : {"free", "boundary", "pinned", "unused"}
        Why smoothing moves it, or does not.
    ring : (k,) int32
        The hexes that it is a corner of.
    energy : float
        Sum of eta(H)^2 over them, (3.3); +inf while one of them is inverted.
    downhill : (3,) float64
        Minus the gradient of that energy by the node's place, in mean edge lengths of those hexes; 0 where the energy
        is infinite.
    pinned : bool
        Whether it is, be it on the boundary or not.
    """

    number: int
    point: np.ndarray
    kind: str
    ring: np.ndarray
    energy: float
    downhill: np.ndarray
    pinned: bool = False


def describe_node(mesh: Mesh, number: int) -> NodeDetails:
    """Look at a node of a mesh.

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
    corners = mesh.topology.node_corners
    places = corners.items[corners.start[number] : corners.start[number + 1]]
    ring = places // 8
    if not ring.size:
        return NodeDetails(number, mesh.points[number], "unused", ring, 0.0, np.zeros(3))
    nodes, corners_in_ring = np.unique(mesh.hexes[ring], return_inverse=True)
    hexes = corners_in_ring.reshape(-1, 8).astype(np.int32)
    x = mesh.points[nodes]
    x = x / (np.linalg.norm(x[hexes[:, EDGES[:, 0]]] - x[hexes[:, EDGES[:, 1]]], axis=-1).mean() or 1.0)
    energy, downhill = float(np.square(measure(x, hexes).eta).sum()), np.zeros(3)
    if np.isfinite(energy):
        shares = np.empty((ring.size, 8, 3))
        gradient(x, hexes, 0.0, (2.0, 1.0), np.zeros(ring.size, np.uint8), shares)
        downhill = -shares[np.arange(ring.size), places % 8].sum(axis=0)
    kind = "boundary" if mesh.topology.boundary[number] else "pinned" if mesh.fixed[number] else "free"
    pinned = mesh.pinned is not None and bool(mesh.pinned[number])
    return NodeDetails(number, mesh.points[number], kind, ring, energy, downhill, pinned)


def rank_worst(values: np.ndarray, figures: ElementQuality, count: int, better: int = 1) -> np.ndarray:
    """The worst hexes by a metric, (at most count,) int64, the worst first.

    Of equal ones, such as those whose q is 0, that of the lower scaled Jacobian comes first, then that of the lower
    number. What has no value (nan) is the worst.

    Parameters
    ----------
    values : (m,) float64
        Of a metric.
    figures : ElementQuality
        Of the same hexes.
    count : int
    better : int
        +1 where a higher value is better, -1 where a lower one is.
    """
    keys = better * as_reals(values, "values")
    if keys.shape != figures.q.shape:
        raise MeshError(f"values have shape {keys.shape}: expected {figures.q.shape}, one for each hex")
    keys[np.isnan(keys)] = -np.inf
    numbers = _least(keys, np.arange(keys.size), count, figures.scaled_jacobian)
    return numbers[np.lexsort((numbers, figures.scaled_jacobian[numbers], keys[numbers]))]


def _least(keys: np.ndarray, numbers: np.ndarray, count: int, *others: np.ndarray) -> np.ndarray:
    """The `count` of some hexes whose keys are least, in no order; of equal ones, those whose other keys are."""
    if count >= numbers.size:
        return numbers
    mine = keys[numbers]
    bound = np.partition(mine, count - 1)[count - 1] if count else -np.inf
    below, equal = numbers[mine < bound], numbers[mine == bound]
    missing = count - below.size
    return np.concatenate([below, _least(others[0], equal, missing, *others[1:]) if others else equal[:missing]])
