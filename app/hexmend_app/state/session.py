"""The state of one window, put together."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal

from hexmend.io.formats.session import SUFFIX
from hexmend_app.state.cameras import Cameras
from hexmend_app.state.chain import Chain
from hexmend_app.state.choices import Choices
from hexmend_app.state.classer import Classer
from hexmend_app.state.commands import Commands
from hexmend_app.state.comparison import Comparison
from hexmend_app.state.document import Document, State
from hexmend_app.state.examiner import Examiner
from hexmend_app.state.explainer import Explainer
from hexmend_app.state.eye import Eye
from hexmend_app.state.finder import Finder
from hexmend_app.state.history import History
from hexmend_app.state.kept import KeptMoments
from hexmend_app.state.mesh_repairer import MeshRepairer
from hexmend_app.state.mesh_saver import MeshSaver
from hexmend_app.state.opener import Opener
from hexmend_app.state.order import Order
from hexmend_app.state.reference import References
from hexmend_app.state.run import Smoothing
from hexmend_app.state.selection import Selection
from hexmend_app.state.stepping import Stepping
from hexmend_app.state.timeline import Timeline
from hexmend_app.state.view import View
from hexmend_app.state.views import Views

if TYPE_CHECKING:
    import numpy as np

    from hexmend_app.state.restoring import Restored
    from hexmend_app.state.session_data import SessionData


class Session(QObject):
    """The open mesh, how it is looked at, what is chosen in it, and what works on it beside the window.

    Signals
    -------
    changed
        Anything of it is another.

    Attributes
    ----------
    document : Document
    view : View
    selection : Selection
    order : Order
    chain : Chain
    history : History
    smoothing : Smoothing
    timeline : Timeline
    references : References
    opener : Opener
    finder : Finder
    classer : Classer
    explainer : Explainer
    stepping : Stepping
    comparison : Comparison
    views : Views
    kept : KeptMoments
    eye : Eye
    cameras : Cameras
    choices : Choices
    commands : Commands
    saver : MeshSaver
    repairer : MeshRepairer
    """

    changed = Signal()

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self.document = Document(self)
        self.view = View(self.document, self)
        self.selection = Selection(self.document, self)
        self.order = Order(self)
        self.chain = Chain(self)
        self.history = History()
        self.smoothing = Smoothing(self.document, self.history, self)
        self.timeline = Timeline(self.document, self.smoothing, self.history, self)
        self.references = References(self.document, self.history)
        self.opener = Opener(self.document, self)
        self.finder = Finder(self.document, self)
        self.classer = Classer(self)
        self.explainer = Explainer(self)
        self.examiner = Examiner(self)
        self.stepping = Stepping(self.document, self)
        self.comparison = Comparison(self.document, self)
        self.kept = KeptMoments(self)
        self.views = Views(self.document, self.kept, self)
        self.eye = Eye(self)
        self.cameras = Cameras(self)
        self.choices = Choices()
        self.commands = Commands(self)
        self.saver = MeshSaver(self)
        self.repairer = MeshRepairer(self)
        self.opener.loaded.connect(self.take)
        self.opener.restored.connect(self._look_as)
        self.document.mesh_replaced.connect(self._on_another)
        for part in self.children():
            for told in _signals(part):
                told.connect(self._on_change)

    @property
    def editable(self) -> bool:
        """Whether the mesh may be changed by hand: no run or repair is under way, and no file is being read."""
        return self.document.is_open and not (self.smoothing.busy or self.opener.busy or self.repairer.busy)

    @property
    def modified(self) -> bool:
        """Whether there is something that was not saved: of the mesh or, where a session is open, of the cameras."""
        path = self.document.path
        kept = path is not None and path.suffix.lower() == SUFFIX
        return self.document.modified or (kept and self.cameras.modified)

    def state_at(self, points: np.ndarray | None) -> State | None:
        """A state whose nodes are there, of all that can be come back to or is seen; None where there is none."""
        document, history, comparison = self.document, self.history, self.comparison
        if not document.is_open:
            return None
        known = [document.now, *(one.state for one in document.given().changes)]
        known += [state for record in history.records for state in (record.start, record.end)]
        known += [comparison.initial, *(one.state for one in comparison.results)]
        known += [one.state for one in self.views.all]
        return next((one for one in known if one is not None and one.mesh.points is points), None)

    def given(self) -> SessionData:
        """All that a session's file keeps; a mesh is open, no run goes on, and no sweep is under way."""
        from hexmend_app.state.session_data import SessionData

        document = self.document.given()
        states = [document.now, *(change.state for change in document.changes)]
        return SessionData(
            document=document,
            history=self.history.given(states),
            timeline=self.timeline.given(),
            view=self.view.given(),
            selection=self.selection.given(),
            kept=self.kept.all,
            views=self.views.given(),
            comparison=self.comparison.given(),
            order=self.order.given(),
            chain=self.chain.given(),
            breakpoints=self.smoothing.breakpoints,
            eye=self.eye.given(),
            journey=self.eye.travelled(),
            choices=self.choices.given(),
            cameras=self.cameras.given(),
        )

    def take(self, data: SessionData, path: Path | None = None) -> None:
        """Be as a session's file has it.

        Parameters
        ----------
        data : SessionData
        path : Path, optional
            The file's; None where it was written beside the open window, as a way back after its end.
        """
        self.document.take(data.document, path)  # first: all forget what was of another mesh
        self.history.take(data.history)
        self.timeline.take(data.timeline)
        self.view.take(data.view)
        self.selection.take(data.selection)
        self.kept.take(data.kept)  # before the views, which keep what is not kept yet
        self.views.take(data.views)
        self.comparison.take(data.comparison)
        self.order.take(data.order)
        self.chain.restore(data.chain)
        self.smoothing.break_at(data.breakpoints)
        self.choices.take(data.choices)
        self.cameras.take(data.cameras, saved=path is not None)
        self.eye.take(data.eye, data.journey)

    def shut_down(self) -> None:
        """Ask all threads to end; `wait_for_dropped` waits for them."""
        for part in (self.saver, self.repairer, self.smoothing, self.opener, self.finder, self.classer,
                     self.explainer, self.examiner, self.comparison):  # fmt: skip
            part.shut_down()

    def _on_another(self) -> None:
        """Nothing is chosen, hidden or kept of the mesh that is open now."""
        self.selection.choose(None)
        self.view.show_another()
        self.kept.clear()
        self.classer.forget()

    def _look_as(self, restored: Restored) -> None:
        """Look at the mesh as a picture has it, the others beside it, with the recipe at hand that ran there."""
        carried = restored.carried
        self.view.show_as(restored.look)
        for one in restored.others:
            if one.state is not None:
                self.views.show(one.name, one.state)
        if restored.wiped is not None:
            self.views.set_wiping(True)
            self.views.move_wipe(restored.wiped)
        self.eye.look_through(carried.scene.camera_of(carried.panels[0]))
        self.cameras.take_in(carried.scene.cameras)
        if carried.recipe is not None:
            self.chain.take(carried.recipe)

    def _on_change(self, *_: object) -> None:
        self.changed.emit()


def _signals(part: QObject) -> list[Signal]:
    """What a part of the state tells."""
    own = {name for kind in type(part).mro() if kind is not QObject for name, one in vars(kind).items()
           if isinstance(one, Signal)} - {"destroyed", "objectNameChanged"}  # fmt: skip
    return [getattr(part, name) for name in sorted(own)]
