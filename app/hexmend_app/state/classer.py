"""What the nodes of a boundary may do where it slides, found beside the window."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QObject, Signal

from hexmend.boundary import NodeClass, boundary_of, freed_by_sliding, sliding_boundary
from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality, locked
from hexmend_app.state.newest import Newest
from hexmend_app.state.task import Task

#: Kinds beside `NodeClass`: nodes of sharp edges that are no curve, of a chain that ends amid a patch; and pinned ones.
WHISKER, PIN = 4, 5


@dataclass(frozen=True, eq=False)
class Classes:
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


def node_kinds(mesh: Mesh, degrees: float) -> np.ndarray:
    """What each node is to the boundary, (n,) uint8: one of `hexmend.boundary.Kind`, `WHISKER` or `PIN`.

    Parameters
    ----------
    mesh : Mesh
    degrees : float
        Angle between two faces beyond which their edge is a feature.
    """
    boundary = sliding_boundary(mesh, degrees)
    sharp = np.zeros(mesh.n_nodes, dtype=bool)
    sharp[boundary_of(mesh.with_points(mesh.surface_points), degrees, whisker=0).segments] = True
    kinds = np.where(sharp & (boundary.node_class == NodeClass.PATCH), WHISKER, boundary.node_class).astype(np.uint8)
    if mesh.pinned is not None:
        kinds[mesh.pinned & (kinds != NodeClass.INSIDE)] = PIN
    return kinds


def classed(mesh: Mesh, figures: ElementQuality, degrees: float) -> Classes:
    """Class a boundary.

    Parameters
    ----------
    mesh : Mesh
    figures : ElementQuality
        Of the mesh.
    degrees : float
        See `node_kinds`.
    """
    held = locked(mesh.points, mesh.hexes, mesh.fixed, figures.inverted)
    freed = freed_by_sliding(mesh, held, degrees)
    return Classes(mesh, node_kinds(mesh, degrees), int(np.count_nonzero(held)), int(np.count_nonzero(freed)))


class Classer(Newest):
    """Classes the boundary of a mesh; of several that it was asked for, the newest.

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

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self.classes: Classes | None = None
        self.error: BaseException | None = None

    def of(self, mesh: Mesh) -> Classes | None:
        """What was found last, if it was of this mesh, its nodes elsewhere or not."""
        return self.classes if self.classes is not None and self.classes.mesh.hexes is mesh.hexes else None

    @property
    def busy(self) -> bool:
        """Whether something is being found."""
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
        return Task(f"reading {question[0].name}: its boundary", lambda _: classed(*question))

    def _take(self, task: Task) -> None:
        self.classes, self.error = task.result, task.error
        self.found.emit()
