"""A sweep of a local method that the user makes node by node, as one change of the document."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QObject, Signal

from hexmend.node_step import NodeStep, Sweep
from hexmend.smoothers.local.single_node import LocalDescent
from hexmend_app.state.mesh.document import Document, State


@dataclass(frozen=True, eq=False)
class SweepResult:
    """A sweep that is recorded.

    Parameters
    ----------
    before, after : State
    smoother : LocalDescent
    steps : int
        Nodes that were visited one by one.
    finished : bool
        Whether all others were, at once.
    """

    before: State
    after: State
    smoother: LocalDescent
    steps: int
    finished: bool


class NodeSweep(QObject):
    """Steps through the nodes of a sweep.

    The document shows where the nodes are on the way; that is recorded when the sweep is over or left, which whatever
    else changes the mesh has to see to first.

    Signals
    -------
    changed
        A node was visited, or the sweep was left.

    recorded(Swept)
        A sweep is over or left, and the document holds what it came to as one change.

    Attributes
    ----------
    sweep : Sweep or None
        The one under way.
    last : NodeStep or None
        The step that was made last.
    """

    changed = Signal()
    recorded = Signal(object)

    def __init__(self, document: Document, parent: QObject | None = None):
        super().__init__(parent)
        self._document = document
        self.sweep: Sweep | None = None
        self.last: NodeStep | None = None
        self._smoother: LocalDescent | None = None
        self._state: State | None = None  # that the last step led to
        self._before: State | None = None  # that the sweep began with
        self._steps = 0  # made one by one
        document.mesh_replaced.connect(self._forget)
        document.points_moved.connect(self._on_moved)

    def made_by(self, smoother: LocalDescent) -> NodeStep | None:
        """The step of this method that led to the mesh as it is now; None where something else did."""
        if self._state is None or self._document.now is not self._state or smoother != self._smoother:
            return None
        return self.last

    @property
    def title(self) -> str | None:
        """Title of the change for undo; None while no sweep is active."""
        return self.sweep and self.sweep.title

    def advance(self, smoother: LocalDescent, count: int = 1) -> None:
        """Visit that many more nodes of the sweep under way, or of a new one."""
        sweep = self._begun(smoother)
        for _, step in zip(range(count), sweep, strict=False):
            self.last = step
        self._steps = sweep.done
        self._show()

    def finish(self, smoother: LocalDescent) -> None:
        """Visit all remaining nodes; the step of the last is reported."""
        self.last = self._begun(smoother).finish()
        self._show()

    def leave(self) -> None:
        """End the sweep where it is, as one change that undo takes back; nothing happens where none is under way."""
        self._record(show=True)

    def _begun(self, smoother: LocalDescent) -> Sweep:
        if self.sweep is not None and self.sweep.smoother != smoother:
            self.leave()
        if self.sweep is None:
            self.sweep, self._smoother = Sweep(self._document.now.mesh, smoother), smoother
            self._before, self._steps = self._document.now, 0
        return self.sweep

    def _show(self) -> None:
        self._state = State.of(self._document.now.mesh.with_points(self.sweep.points))
        if self.sweep.finished:
            self.leave()
        else:
            self._document.preview(self._state)
            self.changed.emit()

    def _on_moved(self) -> None:
        """Leave the sweep where something else is shown, which stays in view."""
        if self._document.now is not self._state:
            self._record(show=False)

    def _record(self, show: bool) -> None:
        title, sweep, self.sweep = self.title, self.sweep, None
        if title is not None:
            self._document.commit(title, self._state, show=show)
            self.recorded.emit(
                SweepResult(self._before, self._state, self._smoother, self._steps, sweep.done > self._steps)
            )
            self._before = None
            self.changed.emit()

    def _forget(self) -> None:
        self.sweep = self.last = self._state = self._before = None
