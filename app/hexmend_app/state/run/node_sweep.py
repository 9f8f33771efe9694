"""Sweep of a local method that the user runs node by node, as one change of the document."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal

from hexmend.smoothers.local.single_node import LocalDescent
from hexmend_app.state.mesh.document import Document, MeasuredMesh
from hexmend_app.state.node_step import NodeStep, Sweep


class NodeSweep(QObject):
    """Steps through the nodes of a sweep.

    The document previews the node positions, which are recorded as one change when the sweep ends. Everything else that
    changes the mesh has to call `leave` first.

    Signals
    -------
    changed
        A node was visited, or the sweep has ended.

    Attributes
    ----------
    sweep : Sweep or None
        The active sweep.
    last : NodeStep or None
        The last step.
    """

    changed = Signal()

    def __init__(self, document: Document, parent: QObject | None = None):
        super().__init__(parent)
        self._document = document
        self.sweep: Sweep | None = None
        self.last: NodeStep | None = None
        self._smoother: LocalDescent | None = None
        self._state: MeasuredMesh | None = None  # after the last step
        document.mesh_replaced.connect(self._clear)
        document.points_moved.connect(self._on_moved)

    def last_step_of(self, smoother: object) -> NodeStep | None:
        """Return the last step if it was made by this method and led to the current mesh; otherwise None."""
        if self._state is None or self._document.now is not self._state or smoother != self._smoother:
            return None
        return self.last

    @property
    def title(self) -> str | None:
        """Title of the change for undo; None while no sweep is active."""
        return None if self.sweep is None else self.sweep.title

    def advance(self, smoother: LocalDescent, count: int = 1) -> None:
        """Visit the next nodes of the active sweep, or of a new one."""
        sweep = self._active_sweep(smoother)
        for _, step in zip(range(count), sweep, strict=False):
            self.last = step
        self._show()

    def finish(self, smoother: LocalDescent) -> None:
        """Visit all remaining nodes; `last` is the step of the last one."""
        self.last = self._active_sweep(smoother).finish()
        self._show()

    def leave(self) -> None:
        """End the active sweep, if any, at its current node, and record it as one change."""
        self._record(show=True)

    def _active_sweep(self, smoother: LocalDescent) -> Sweep:
        """Return the active sweep of a method; start one if there is none."""
        if self.sweep is not None and self.sweep.smoother != smoother:
            self.leave()
        if self.sweep is None:
            self.sweep, self._smoother = Sweep(self._document.now.mesh, smoother), smoother
        return self.sweep

    def _show(self) -> None:
        self._state = MeasuredMesh.of(self._document.now.mesh.with_points(self.sweep.points))
        if self.sweep.finished:
            self.leave()
        else:
            self._document.preview(self._state)
            self.changed.emit()

    def _on_moved(self) -> None:
        """End the sweep if the document shows another state, which stays in view."""
        if self._document.now is not self._state:
            self._record(show=False)

    def _record(self, show: bool) -> None:
        title, self.sweep = self.title, None
        if title is not None:
            self._document.commit(title, self._state, show=show)
            self.changed.emit()

    def _clear(self) -> None:
        self.sweep = self.last = self._state = None
