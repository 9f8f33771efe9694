"""Classification of the nodes of a sliding boundary, in the background."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QObject, Signal

from hexmend.boundary import NodeClass, boundary_of, boundary_with_kept_corners, freed_by_sliding
from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality, locked_hexes
from hexmend_app.state.mesh.document import Document
from hexmend_app.state.tasks.latest_task import LatestTask
from hexmend_app.state.tasks.task import Task

#: Kinds beside `NodeClass`: nodes of sharp edges that are no curve, of a chain that ends amid a patch; and pinned ones.
WHISKER, PIN = 4, 5


@dataclass(frozen=True, eq=False)
class BoundaryClasses:
    """A boundary, classed.

    Parameters
    ----------
    mesh : Mesh
        Whose it is.
    kinds : (n,) uint8
        Of each node one of `hexmend.boundary.Kind`, `WHISKER` or `PIN`.
    locked, freed : int
        Hexes that fixed nodes alone hold in inversion, and how many of them sliding can free.
    """

    mesh: Mesh
    kinds: np.ndarray
    locked: int
    freed: int

    def count(self, kind: int) -> int:
        """Number of nodes of a kind."""
        return int(np.count_nonzero(self.kinds == kind))


def node_classes(mesh: Mesh, degrees: float) -> np.ndarray:
    """Return the class of each node, (n,) uint8: of `hexmend.boundary.NodeClass`, `WHISKER` or `PIN`.

    Parameters
    ----------
    mesh : Mesh
    degrees : float
        Angle between two faces beyond which their edge is a feature.
    """
    boundary = boundary_with_kept_corners(mesh, degrees)
    sharp = np.zeros(mesh.n_nodes, dtype=bool)
    sharp[boundary_of(mesh.with_points(mesh.surface_points), degrees, whisker=0).segments] = True
    kinds = np.where(sharp & (boundary.node_class == NodeClass.PATCH), WHISKER, boundary.node_class).astype(np.uint8)
    if mesh.pinned is not None:
        kinds[mesh.pinned & (kinds != NodeClass.INSIDE)] = PIN
    return kinds


def classify_boundary(mesh: Mesh, figures: ElementQuality, degrees: float) -> BoundaryClasses:
    """Class a boundary.

    Parameters
    ----------
    mesh : Mesh
    figures : ElementQuality
        Of the mesh.
    degrees : float
        See `node_kinds`.
    """
    locked = locked_hexes(mesh.points, mesh.hexes, mesh.fixed, figures.inverted)
    freed = freed_by_sliding(mesh, locked, degrees)
    return BoundaryClasses(
        mesh, node_classes(mesh, degrees), int(np.count_nonzero(locked)), int(np.count_nonzero(freed))
    )


class BoundaryClassifier(LatestTask):
    """Classifies the boundary of a mesh; of several that it was asked for, the newest.

    Parameters
    ----------
    document : Document

    Signals
    -------
    found
        `classes` are others, or there is an `error`.

    Attributes
    ----------
    classes : Classes or None
        What was found last; None before that, and where that failed.
    error : BaseException or None
        Why what was asked for last could not be found; None before that is known.
    """

    found = Signal()

    def __init__(self, document: Document, parent: QObject | None = None):
        super().__init__(parent)
        document.mesh_replaced.connect(self.forget)
        self.classes: BoundaryClasses | None = None
        self.error: BaseException | None = None

    def of(self, mesh: Mesh) -> BoundaryClasses | None:
        """Return the last result if it is of this mesh, whatever its node positions."""
        return self.classes if self.classes is not None and self.classes.mesh.hexes is mesh.hexes else None

    @property
    def busy(self) -> bool:
        """True while a classification is in progress."""
        return self._task is not None

    def ask(self, mesh: Mesh, figures: ElementQuality, degrees: float) -> None:
        """Class a mesh's boundary, unless that is done or being done, or has failed.

        Parameters
        ----------
        mesh : Mesh
        figures : ElementQuality
            Of the mesh.
        degrees : float
            See `node_kinds`.
        """
        question = mesh, figures, degrees
        if question != self._wanted:
            self._want(question)

    def forget(self) -> None:
        """Another mesh is open: nothing is known of it."""
        self.classes = self.error = self._wanted = None

    def _work(self, question: tuple[Mesh, ElementQuality, float]) -> Task:
        self.error = None
        return Task(f"reading {question[0].name}: its boundary", lambda _: classify_boundary(*question))

    def _take(self, task: Task) -> None:
        self.classes, self.error = task.result, task.error
        self.found.emit()
