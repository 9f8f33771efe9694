"""Classification of the nodes of a sliding boundary, in the background."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QObject

from hexmend.boundary import NodeClass, boundary_of, boundary_with_kept_corners, freed_by_sliding
from hexmend.boundary.comparison import Departures, departures
from hexmend.boundary.feature_edges.features import FeatureAngle
from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality, locked_hexes
from hexmend_app.state.mesh.document import Document
from hexmend_app.state.tasks.latest_task import LatestTask

#: Node classes in addition to `NodeClass`: nodes of a chain of sharp edges that ends inside a patch, pinned nodes, and
#: nodes that have left their corner, curve or patch within the tolerance.
WHISKER, PIN, LEFT = 4, 5, 6


@dataclass(frozen=True, eq=False)
class BoundaryClasses:
    """Classes of the nodes of a boundary.

    Parameters
    ----------
    mesh : Mesh
    kinds : (n,) uint8
        Class of each node: `hexmend.boundary.NodeClass`, `WHISKER`, `PIN` or `LEFT`.
    original_kinds : (n,) uint8
        Class of each node on the original boundary, whatever its position: none is `LEFT`.
    locked, freed : int
        Numbers of hexes that are inverted by fixed nodes alone, and of those that sliding can free.
    departures : Departures, optional
        Distances of nodes from the corner, curve or patch of the original boundary; None if the boundary has not moved.
    """

    mesh: Mesh
    kinds: np.ndarray
    original_kinds: np.ndarray
    locked: int
    freed: int
    departures: Departures | None = None

    def count(self, kind: int) -> int:
        """Return the number of nodes of a class."""
        return int(np.count_nonzero(self.kinds == kind))


def departures_from_surface(mesh: Mesh, degrees: FeatureAngle) -> Departures | None:
    """Find the nodes that have left the corner, curve or patch of the original boundary.

    Returns None if no node of the boundary has moved. Parameters as of `node_classes`.
    """
    boundary, original = mesh.topology.boundary, mesh.surface_points
    if np.array_equal(mesh.points[boundary], original[boundary]):
        return None
    return departures(mesh.with_points(original), mesh, degrees)


def node_classes(mesh: Mesh, degrees: FeatureAngle, left: Departures | None = None) -> np.ndarray:
    """Return the class of each node, (n,) uint8: `hexmend.boundary.NodeClass`, `WHISKER`, `PIN` or `LEFT`.

    Parameters
    ----------
    mesh : Mesh
    degrees : float or "auto"
        Angle between two faces beyond which their edge is a feature; see `hexmend.boundary.feature_edges.features`.
    left : Departures, optional
        Nodes that have left the original boundary.
    """
    boundary = boundary_with_kept_corners(mesh, degrees)
    sharp = np.zeros(mesh.n_nodes, dtype=bool)
    sharp[boundary_of(mesh.with_points(mesh.surface_points), degrees, whisker=0).segments] = True
    kinds = np.where(sharp & (boundary.node_class == NodeClass.PATCH), WHISKER, boundary.node_class).astype(np.uint8)
    if mesh.pinned is not None:
        kinds[mesh.pinned & (kinds != NodeClass.INSIDE)] = PIN
    return kinds if left is None else _with_left(kinds, left)


def _with_left(kinds: np.ndarray, left: Departures) -> np.ndarray:
    """Return classes, (n,) uint8, in which nodes that have left the original boundary are `LEFT` unless pinned."""
    kinds = kinds.copy()
    kinds[left.nodes] = np.where(kinds[left.nodes] == PIN, PIN, LEFT)
    return kinds


def classify_boundary(mesh: Mesh, quality: ElementQuality, degrees: FeatureAngle) -> BoundaryClasses:
    """Classify the nodes of a boundary, and count its locked hexes.

    Parameters
    ----------
    mesh : Mesh
    quality : ElementQuality
        Quality of the mesh.
    degrees : float or "auto"
        See `node_classes`.
    """
    locked = locked_hexes(mesh.points, mesh.elements, mesh.fixed, quality.inverted)
    freed = freed_by_sliding(mesh, locked, degrees)
    left = departures_from_surface(mesh, degrees)
    counts = int(np.count_nonzero(locked)), int(np.count_nonzero(freed))
    original = node_classes(mesh, degrees)
    kinds = original if left is None else _with_left(original, left)
    return BoundaryClasses(mesh, kinds, original, *counts, left)


class BoundaryClassifier(LatestTask):
    """Classifies the boundary of a mesh in the background: `ask` takes the arguments of `classify_boundary`."""

    def __init__(self, document: Document, parent: QObject | None = None):
        super().__init__("classifying the boundary", classify_boundary, parent)
        document.mesh_replaced.connect(self.forget)

    def of(self, mesh: Mesh) -> BoundaryClasses | None:  # type: ignore[override]
        """Return the last result if it is of this mesh, whatever its node positions."""
        return self.result if self.result is not None and self.result.mesh.elements is mesh.elements else None
