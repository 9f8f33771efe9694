"""Lengths that a noisy or tangled mesh was meant to have, recovered along its dual sheets.

The edges that are parallel to each other in a hex, those parallel to them in its neighbours, and so on, belong to one
dual sheet. Lengths change little from one edge of a sheet to the next, while they may change fast across sheets, as in
a boundary layer. Where edges are noisy, their lengths are therefore filled in from sound edges of the same sheet:
edges of the boundary and of interfaces between materials, and edges away from distorted hexes and noise.

Lengths of hexes along their own three directions, and the numbers of their twelve edges.
"""

from __future__ import annotations

from weakref import WeakKeyDictionary

import numpy as np

from hexmend.arrays import as_immutable, mask
from hexmend.kernels import incidence, structure
from hexmend.mesh.edge_length import hex_lengths
from hexmend.mesh.hexahedron import EDGES
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.solid_cells import kinds_of
from hexmend.mesh.topology import CSR, Topology
from hexmend.quality import ElementQuality, measure

#: Shortest length, as a share of the mean edge length: a direction without any extent gets it.
_LEAST = 1e-12


def given_lengths(mesh: Mesh, which: np.ndarray | None = None) -> np.ndarray:
    """Compute the lengths of cells along the edges of their corners: see `hexmend.mesh.edge_length.hex_lengths`.

    Lengths of edges are positive, however a hex is distorted or inverted.

    Parameters
    ----------
    mesh : Mesh
    which : (k,) int, optional
        Numbers of hexes; all by default.

    Returns
    -------
    (k, 3) float64
        In the mesh's unit of length, positive.

    Examples
    --------
    >>> from hexmend.mesh.hexahedron import UNIT_CUBE
    >>> given_lengths(Mesh(UNIT_CUBE * [1, 2, 3], [range(8)]))
    array([[1., 2., 3.]])
    """
    lengths = hex_lengths(mesh.points, mesh.elements if which is None else mesh.elements[which])
    return np.maximum(lengths, _LEAST * (mesh.mean_edge_length or 1.0), out=lengths)


def edge_numbers(topology: Topology) -> np.ndarray:
    """Find the number, in `Topology.edges`, of each edge of each hex.

    Parameters
    ----------
    topology : Topology

    Returns
    -------
    (m, 12) int32
        Columns as of `hexmend.mesh.hexahedron.EDGES`; -1 for an edge whose two nodes are one, and in the rows of other
        cells.
    """
    edges, hexes = topology.edges, topology.elements
    start = np.concatenate([[0], np.cumsum(np.bincount(edges[:, 0], minlength=topology.n))])
    most = int(np.diff(start).max(initial=0))
    upper = np.concatenate([edges[:, 1], np.full(most, -1, np.int32)])  # the upper ends at a node ascend
    numbers = np.empty((len(hexes), len(EDGES)), np.int32)
    for column, (a, b) in enumerate(EDGES):
        low, high = np.minimum(hexes[:, a], hexes[:, b]), np.maximum(hexes[:, a], hexes[:, b])
        at = start[low]
        for _ in range(1, most):
            at += upper[at] < high
        numbers[:, column] = np.where(low == high, -1, at)
    numbers[kinds_of(hexes) > 0] = -1
    return numbers


#: Scaled Jacobian below which a hex is distorted: elsewhere lengths are sound.
DISTORTED = 0.2
#: Scaled Jacobian below which the edges of a hex near a distorted one are no measure: its heights are less than they.
_SKEWED = 0.5
#: Share of skewed hexes near distorted ones beyond which all edges there are no measure.
_SCRAMBLED = 0.3
#: Mean difference of the logarithm of an edge's length from its neighbours' in the sheet beyond which it is noisy.
NOISE = 0.1
#: Passes by which that difference is averaged over the neighbours.
_NOISE_PASSES = 3
#: Rings of hexes around distorted ones in which edges may be noisy.
_RINGS = 2
#: Passes of averaging over the edges that were filled in.
_PASSES = 8
#: Lengths of distorted meshes in use: the detection of layers, targets and reports all need them.
_RECOVERED: WeakKeyDictionary[Mesh, np.ndarray] = WeakKeyDictionary()


class Sheets:
    """Averaging over the edges of dual sheets: a hex has three groups of four parallel edges.

    Parameters
    ----------
    mesh : Mesh
    hexes : (k,) int
        Hexes whose edges are concerned.

    Attributes
    ----------
    groups : (3 k, 4) int32
        Numbers of the parallel edges of each hex and direction; `count` stands for no edge.
    count : int
        Number of edges of the mesh.
    """

    def __init__(self, mesh: Mesh, hexes: np.ndarray):
        self.count = len(mesh.topology.edges)
        numbers = edge_numbers(mesh.topology)[hexes]
        self.groups = np.where(numbers < 0, np.int32(self.count), numbers).reshape(-1, 4)

    def averages(self, values: np.ndarray, groups: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Average values over the edges in the groups around each edge.

        Parameters
        ----------
        values : (count + 1,) float64
            Of the edges; the last stands for none.
        groups : (g, 4) int32
            Rows of `groups` that count.

        Returns
        -------
        (count + 1,) float64, (count + 1,) bool
            The averages, and True for the edges that have one.
        """
        average, number = np.empty(self.count + 1), np.empty(self.count + 1, dtype=np.int32)
        structure.average_along_sheets(groups, values, average, number)
        return average, number > 0

    def fill(self, values: np.ndarray, known: np.ndarray, groups: np.ndarray) -> None:
        """Fill in the values of edges that are not known, front by front; changes both, (count + 1,).

        Each front is reached by groups (g, 4) with a known edge: its values are the means of the means of their known
        edges. Edges that no front reaches stay as they are, as does the last, which stands for none.
        """
        around = CSR(*incidence.grouped(groups.ravel(), self.count + 1))
        front = np.flatnonzero(known[groups].any(axis=1))
        while front.size:
            edges = groups[front]
            sound, open_ = known[edges], ~known[edges] & (edges < self.count)
            a, b, c, d = np.where(sound, values[edges], 0.0).T
            means = (a + b + c + d) / sound.sum(axis=1)
            reached, place = np.unique(edges[open_], return_inverse=True)
            totals = np.bincount(place, np.broadcast_to(means[:, None], edges.shape)[open_])
            values[reached] = totals / np.bincount(place)
            known[reached] = True
            front = np.unique(around.of(reached) // 4)


def recovered_lengths(mesh: Mesh, quality: ElementQuality | None = None) -> np.ndarray:
    """Compute the lengths of hexes along their own directions, with those of noisy edges recovered along dual sheets.

    Parameters
    ----------
    mesh : Mesh
    quality : ElementQuality, optional
        Of the mesh's hexes, if it is measured already.

    Returns
    -------
    (m, 3) float64
        In the mesh's unit of length, positive; those of `given_lengths` where the mesh is sound.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> lengths = recovered_lengths(make("cube", size=512, scramble=0.7))
    >>> bool(abs(lengths * 8 - 1).max() < 0.02)
    True
    """
    lengths = given_lengths(mesh)
    quality = quality or measure(mesh.points, mesh.elements)
    distorted = np.flatnonzero(quality.scaled_jacobian < DISTORTED)
    if distorted.size and mesh not in _RECOVERED:
        _RECOVERED[mesh] = as_immutable(_recovered(mesh, lengths, quality, distorted))
    return _RECOVERED[mesh].copy() if distorted.size else lengths


def _recovered(mesh: Mesh, lengths: np.ndarray, quality: ElementQuality, distorted: np.ndarray) -> np.ndarray:
    """Return the lengths (m, 3) with those near distorted hexes (k,) recovered; `lengths` is changed."""
    region = np.flatnonzero(mesh.topology.hexes_around(distorted, _RINGS))
    sheets = Sheets(mesh, region)
    logs = _log_edge_lengths(mesh)
    noisy = _noisy_edges(mesh, sheets, logs, quality, region)
    affected = noisy[sheets.groups].any(axis=1)
    if affected.any():
        groups = sheets.groups[affected]
        filled = _filled(sheets, logs, noisy, groups)
        there = groups < sheets.count
        means = np.einsum("ij,ij->i", filled[groups], there) / there.sum(axis=1)
        local = lengths[region].ravel()
        local[affected] = np.exp(means)
        lengths[region] = local.reshape(-1, 3)
    return lengths


def _log_edge_lengths(mesh: Mesh) -> np.ndarray:
    """Logarithms of the lengths of all edges, (e + 1,); the last, 0, stands for no edge."""
    low, high = mesh.topology.edges.T
    along = mesh.points[high] - mesh.points[low]
    lengths = np.sqrt(np.einsum("ij,ij->i", along, along))
    return np.append(np.log(np.maximum(lengths, 1e-12 * (mesh.mean_edge_length or 1.0))), 0.0)


def _noisy_edges(
    mesh: Mesh, sheets: Sheets, logs: np.ndarray, quality: ElementQuality, region: np.ndarray
) -> np.ndarray:
    """Mark edges whose ends are not both `_as_given`, at skewed hexes or unlike their neighbours, (e + 1,) bool."""
    average, _ = sheets.averages(logs, sheets.groups)
    noise = np.abs(logs - average)
    for _ in range(_NOISE_PASSES):
        noise, found = sheets.averages(noise, sheets.groups)
    noisy = found & (noise > NOISE)
    skewed = region[quality.scaled_jacobian[region] < _SKEWED]
    if len(skewed) > _SCRAMBLED * len(region):
        skewed = region
    near = mask(mesh.elements[skewed], mesh.n_nodes)[mesh.elements[region]].any(axis=1)
    noisy[sheets.groups.reshape(-1, 12)[near]] = True
    low, high = mesh.topology.edges.T
    sound = _as_given(mesh)
    noisy[:-1] &= ~(sound[low] & sound[high])
    noisy[-1] = False
    return noisy


def _as_given(mesh: Mesh) -> np.ndarray:
    """Mark the nodes that are where they were made, (n,) bool: of the boundary, and of interfaces that are kept.

    Pinned nodes are not among them: a mesh has the same lengths whatever is pinned for a run.
    """
    motion, materials = mesh.linear_motion, mesh.interfaces
    given = mesh.topology.boundary.copy()
    if motion is not None:
        given &= ~motion.marks(mesh.n_nodes)
    return given if materials is None else given | materials.interface_nodes


def _filled(sheets: Sheets, logs: np.ndarray, noisy: np.ndarray, groups: np.ndarray) -> np.ndarray:
    """Fill in the values of noisy edges from the others of their sheet, front by front, and average them."""
    values, known = logs.copy(), ~noisy
    known[-1] = False
    sheets.fill(values, known, groups)
    for _ in range(_PASSES):
        average, _ = sheets.averages(values, groups)
        values[noisy] = average[noisy]
    return values
