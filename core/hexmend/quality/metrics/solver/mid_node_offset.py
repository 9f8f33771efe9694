"""Offset of the mid-nodes of edges from the middle; 0 for hexes of eight nodes."""

import math

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.mesh.second_order import MID_EDGES
from hexmend.mesh.validation import as_hexes, as_points
from hexmend.quality.finite_volume.geometry import divide
from hexmend.quality.measure import ElementQuality
from hexmend.quality.metric import Metric

#: Number of hexes computed at a time.
_CHUNK_HEXES = 1 << 15


def _none(points: np.ndarray, hexes: np.ndarray, quality: ElementQuality) -> np.ndarray:
    return np.zeros(len(as_hexes(hexes, len(as_points(points)))))


def _of_mesh(mesh: Mesh, quality: ElementQuality) -> np.ndarray:
    offsets = np.zeros(mesh.n_hexes)
    if mesh.mid_nodes is None:
        return offsets
    for first in range(0, mesh.n_hexes, _CHUNK_HEXES):
        part = slice(first, first + _CHUNK_HEXES)
        middles = mesh.mid_nodes[part, : len(MID_EDGES)]
        ends = mesh.points[mesh.hexes[part][:, MID_EDGES]]
        away = np.linalg.norm(mesh.points[middles] - ends.mean(axis=2), axis=2)
        lengths = np.linalg.norm(ends[:, :, 1] - ends[:, :, 0], axis=2)
        offsets[part] = np.where(middles >= 0, divide(away, lengths, math.inf), 0.0).max(axis=1)
    return offsets


MID_NODE_OFFSET = Metric(
    name="mid-node-offset",
    title="Mid-node offset",
    formula="greatest over the twelve edges of |m − (a + b)/2| / |b − a|, m the mid-node of a, b; 0 without mid-nodes",
    source="Hexmend; a quarter is the position at which the map along a straight edge becomes singular",
    full_range=(0.0, math.inf),
    acceptable=(0.0, 0.25),
    better=-1,
    meaning=(
        "A mid-node at a quarter of a straight edge makes the strain singular at its end, as at a crack tip; beyond, "
        "the map folds."
    ),
    of=_none,
    of_mesh=_of_mesh,
).register()
