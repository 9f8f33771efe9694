"""The state of one window, put together."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal

from hexmend.io.formats.session import SUFFIX
from hexmend_app.state.mesh.comparison_base import ComparisonBases
from hexmend_app.state.mesh.document import Document, State
from hexmend_app.state.mesh.history import History
from hexmend_app.state.mesh.selection import Selection
from hexmend_app.state.mesh.snapshots import Snapshots
from hexmend_app.state.run.comparison import Comparison
from hexmend_app.state.run.node_sweep import NodeSweep
from hexmend_app.state.run.recipe_draft import RecipeDraft
from hexmend_app.state.run.run_controller import RunController
from hexmend_app.state.run.run_setup import RunSetup
from hexmend_app.state.run.timeline import Timeline
from hexmend_app.state.session.commands import Commands
from hexmend_app.state.tasks.boundary_classifier import BoundaryClassifier
from hexmend_app.state.tasks.mesh_checker import MeshChecker
from hexmend_app.state.tasks.mesh_opener import MeshOpener
from hexmend_app.state.tasks.mesh_repairer import MeshRepairer
from hexmend_app.state.tasks.mesh_saver import MeshSaver
from hexmend_app.state.tasks.node_step_task import NodeStepTask
from hexmend_app.state.tasks.structure_finder import StructureFinder
from hexmend_app.state.view.camera_request import CameraRequest
from hexmend_app.state.view.panel_settings import PanelSettings
from hexmend_app.state.view.saved_cameras import SavedCameras
from hexmend_app.state.view.side_views import SideViews
from hexmend_app.state.view.view_model import ViewModel

if TYPE_CHECKING:
    import numpy as np

    from hexmend_app.state.session.restored_picture import RestoredPicture
    from hexmend_app.state.session.session_data import SessionData


class Session(QObject):
    """The open mesh, how it is looked at, what is chosen in it, and what works on it beside the window.

    Signals
    -------
    changed
        Anything of it is another.

    Attributes
    ----------
    document : Document
    view : ViewModel
    selection : Selection
    run_setup : RunSetup
    recipe_draft : RecipeDraft
    history : History
    run : RunController
    timeline : Timeline
    comparison_bases : ComparisonBases
    opener : MeshOpener
    structure_finder : StructureFinder
    boundary_classifier : BoundaryClassifier
    node_step_task : NodeStepTask
    mesh_checker : MeshChecker
    node_sweep : NodeSweep
    comparison : Comparison
    snapshots : Snapshots
    side_views : SideViews
    camera_request : CameraRequest
    saved_cameras : SavedCameras
    panel_settings : PanelSettings
    commands : Commands
    saver : MeshSaver
    repairer : MeshRepairer
    """

    changed = Signal()

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self.document = Document(self)
        self.view = ViewModel(self.document, self)
        self.selection = Selection(self.document, self)
        self.run_setup = RunSetup(self)
        self.recipe_draft = RecipeDraft(self)
        self.history = History()
        self.run = RunController(self.document, self.history, self)
        self.timeline = Timeline(self.document, self.run, self.history, self)
        self.comparison_bases = ComparisonBases(self.document, self.history)
        self.opener = MeshOpener(self.document, self)
        self.structure_finder = StructureFinder(self.document, self)
        self.boundary_classifier = BoundaryClassifier(self)
        self.node_step_task = NodeStepTask(self)
        self.mesh_checker = MeshChecker(self)
        self.node_sweep = NodeSweep(self.document, self)
        self.comparison = Comparison(self.document, self)
        self.snapshots = Snapshots(self)
        self.side_views = SideViews(self.document, self.snapshots, self)
        self.camera_request = CameraRequest(self)
        self.saved_cameras = SavedCameras(self)
        self.panel_settings = PanelSettings()
        self.commands = Commands(self)
        self.saver = MeshSaver(self)
        self.repairer = MeshRepairer(self)
        self.opener.loaded.connect(self.restore)
        self.opener.restored.connect(self._look_as)
        self.document.mesh_replaced.connect(self._on_another)
        for part in self.children():
            for text in _signals(part):
                text.connect(self._on_change)

    @property
    def editable(self) -> bool:
        """True if the mesh may be edited: no run or repair is active, and no file is being read."""
        return self.document.is_open and not (self.run.busy or self.opener.busy or self.repairer.busy)

    @property
    def modified(self) -> bool:
        """True if there are unsaved changes of the mesh or, if a session is open, of the cameras."""
        path = self.document.path
        kept = path is not None and path.suffix.lower() == SUFFIX
        return self.document.modified or (kept and self.saved_cameras.modified)

    def state_at(self, points: np.ndarray | None) -> State | None:
        """A state whose nodes are there, of all that can be come back to or is seen; None where there is none."""
        document, history, comparison = self.document, self.history, self.comparison
        if not document.is_open:
            return None
        known = [document.now, *(one.state for one in document.to_data().changes)]
        known += [state for record in history.records for state in (record.start, record.end)]
        known += [comparison.initial, *(one.state for one in comparison.results)]
        known += [one.state for one in self.side_views.all]
        return next((one for one in known if one is not None and one.mesh.points is points), None)

    def to_data(self) -> SessionData:
        """All that a session's file keeps; a mesh is open, no run goes on, and no sweep is under way."""
        from hexmend_app.state.session.session_data import SessionData

        document = self.document.to_data()
        states = [document.now, *(change.state for change in document.changes)]
        return SessionData(
            document=document,
            history=self.history.to_data(states),
            timeline=self.timeline.to_data(),
            view=self.view.to_data(),
            selection=self.selection.to_data(),
            snapshots=self.snapshots.all,
            side_views=self.side_views.to_data(),
            comparison=self.comparison.to_data(),
            run_setup=self.run_setup.to_data(),
            recipe_draft=self.recipe_draft.to_data(),
            breakpoints=self.run.breakpoints,
            camera=self.camera_request.to_data(),
            pose_history=self.camera_request.travelled(),
            panel_settings=self.panel_settings.to_data(),
            cameras=self.saved_cameras.to_data(),
        )

    def restore(self, data: SessionData, path: Path | None = None) -> None:
        """Be as a session's file has it.

        Parameters
        ----------
        data : SessionData
        path : Path, optional
            The file's; None where it was written beside the open window, as a way back after its end.
        """
        self.document.restore(data.document, path)  # first: all forget what was of another mesh
        self.history.restore(data.history)
        self.timeline.restore(data.timeline)
        self.view.restore(data.view)
        self.selection.restore(data.selection)
        self.snapshots.restore(data.snapshots)  # before the views, which keep what is not kept yet
        self.side_views.restore(data.side_views)
        self.comparison.restore(data.comparison)
        self.run_setup.restore(data.run_setup)
        self.recipe_draft.restore(data.recipe_draft)
        self.run.break_at(data.breakpoints)
        self.panel_settings.restore(data.panel_settings)
        self.saved_cameras.restore(data.cameras, saved=path is not None)
        self.camera_request.restore(data.camera, data.pose_history)

    def shut_down(self) -> None:
        """Ask all threads to end; `wait_for_dropped` waits for them."""
        for part in (self.saver, self.repairer, self.run, self.opener, self.structure_finder, self.boundary_classifier,
                     self.node_step_task, self.mesh_checker, self.comparison):  # fmt: skip
            part.shut_down()

    def _on_another(self) -> None:
        """Nothing is chosen, hidden or kept of the mesh that is open now."""
        self.selection.choose(None)
        self.view.show_another()
        self.snapshots.clear()
        self.boundary_classifier.forget()

    def _look_as(self, restored: RestoredPicture) -> None:
        """Look at the mesh as a picture has it, the others beside it, with the recipe at hand that ran there."""
        picture_metadata = restored.metadata
        self.view.show_as(restored.look)
        for one in restored.others:
            if one.state is not None:
                self.side_views.show(one.name, one.state)
        if restored.wiped is not None:
            self.side_views.set_wiping(True)
            self.side_views.move_wipe(restored.wiped)
        self.camera_request.look_through(picture_metadata.scene.camera_of(picture_metadata.panels[0]))
        self.saved_cameras.take_in(picture_metadata.scene.cameras)
        if picture_metadata.recipe is not None:
            self.recipe_draft.take(picture_metadata.recipe)

    def _on_change(self, *_: object) -> None:
        self.changed.emit()


def _signals(part: QObject) -> list[Signal]:
    """List the signals of a part of the state."""
    own = {name for kind in type(part).mro() if kind is not QObject for name, one in vars(kind).items()
           if isinstance(one, Signal)} - {"destroyed", "objectNameChanged"}  # fmt: skip
    return [getattr(part, name) for name in sorted(own)]
