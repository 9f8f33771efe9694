"""Lengths of edges: their mean, the unit of steps and tolerances; the shortest at each node; those of each hex."""

from __future__ import annotations

import numpy as np

from hexmend.kernels import elements
from hexmend.mesh.solid_cells import edges_of, rows_by_kind
from hexmend.mesh.validation import as_points_and_hexes

#: The longest edges are outliers if the mean of all exceeds this multiple of the trimmed mean.
OUTLIER_FACTOR = 4.0
#: Approximate number of hexes in the sample for the trimmed mean.
_SAMPLE_HEXES = 10_000


def mean_edge_length(points: np.ndarray, hexes: np.ndarray) -> float:
    """Compute the mean edge length of hexes; an edge counts once for each hex that has it.

    Where the mean exceeds `OUTLIER_FACTOR` times the mean of all but the longest tenth, the latter is returned: one
    node far away makes edges so long that all others would be negligible in the unit that the mean defines.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32

    Returns
    -------
    float
        In the unit of the points; 0 if there are no hexes.

    Raises
    ------
    MeshError
        For arrays of another shape or type, and for a node that does not exist.

    Examples
    --------
    >>> from hexmend.mesh.hexahedron import UNIT_CUBE
    >>> mean_edge_length(2 * UNIT_CUBE, np.arange(8, dtype=np.int32)[None])
    2.0
    """
    points, hexes = as_points_and_hexes(points, hexes)
    if not len(hexes):
        return 0.0
    sample = edge_lengths(points, hexes[:: sample_stride(len(hexes))])
    return robust_mean(elements.mean_edge_length(points, hexes), sample)


def sample_stride(m: int) -> int:
    """Return the distance between the hexes, of m, that are the sample of `robust_mean`."""
    return m // _SAMPLE_HEXES + 1


def edge_lengths(points: np.ndarray, hexes: np.ndarray) -> np.ndarray:
    """Compute the lengths of the edges of cells (k, 8), (e,) float64; an edge counts for each of its cells."""
    ends = points[edges_of(hexes)]
    with np.errstate(over="ignore"):
        return np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)


def robust_mean(mean: float, sample: np.ndarray) -> float:
    """Return the mean of lengths, or that of all but the longest tenth of a sample where outliers raise it much."""
    kept = sample.size - sample.size // 10
    trimmed = float(np.partition(sample, kept - 1)[:kept].mean())
    return trimmed if mean > OUTLIER_FACTOR * trimmed > 0 else mean


def shortest_edges(points: np.ndarray, hexes: np.ndarray) -> np.ndarray:
    """Find the length of the shortest edge of hexes (k, 8) at each node, (n,); +inf at nodes of none of them."""
    size = np.full(len(points), np.inf)
    elements.lower_to_edges(points, hexes, size)
    return size


def hex_lengths(points: np.ndarray, hexes: np.ndarray) -> np.ndarray:
    """Compute the lengths of cells along the edges of their corners.

    Those of a hex along x, y and z of its numbering are means of four parallel edges. A wedge has the mean edge of its
    triangles twice, then that between them; a pyramid and a tetrahedron have their mean edge three times.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (k, 8) int

    Returns
    -------
    (k, 3) float64
        In the unit of the points; 0 in a direction without extent, positive for inverted cells too.

    Examples
    --------
    >>> from hexmend.mesh.hexahedron import UNIT_CUBE
    >>> hex_lengths(UNIT_CUBE * [1, 2, 3], np.arange(8)[None])
    array([[1., 2., 3.]])
    """
    lengths = np.zeros((len(hexes), 3))
    for kind, rows in rows_by_kind(hexes):
        own, found = hexes[rows], np.zeros((len(lengths[rows]), 3))
        for (a, b), of in zip(kind.edges, kind.edge_class, strict=True):
            along = points[own[:, a]]
            along -= points[own[:, b]]
            found[:, of] += np.sqrt(np.einsum("ij,ij->i", along, along))
        found[:, : kind.edge_class.max() + 1] /= np.bincount(kind.edge_class)
        lengths[rows] = found[:, kind.columns]
    return lengths
