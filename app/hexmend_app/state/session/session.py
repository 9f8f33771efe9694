"""The state of a window: its parts, and how they are saved, restored and closed together."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import numpy as np
from PySide6.QtCore import QObject, Signal

from hexmend.doctor import examine
from hexmend.mesh.rules.named_sets import set_names
from hexmend_app.formats.session import SUFFIX
from hexmend_app.picture.colours import MATERIAL
from hexmend_app.state.mesh.document import Document
from hexmend_app.state.mesh.history import ComparisonBases, History
from hexmend_app.state.mesh.selection import Selection
from hexmend_app.state.node_step import explain
from hexmend_app.state.run.breakpoints import Breakpoints
from hexmend_app.state.run.comparison import Comparison
from hexmend_app.state.run.node_sweep import NodeSweep
from hexmend_app.state.run.run_controller import Phase, RunController
from hexmend_app.state.run.run_setup import RecipeDraft, RunSetup
from hexmend_app.state.run.timeline import Timeline
from hexmend_app.state.session.commands import Commands
from hexmend_app.state.session.restored_picture import RestoredPicture
from hexmend_app.state.session.session_data import SessionData
from hexmend_app.state.session.state_part import FeatureStates
from hexmend_app.state.tasks.boundary_classifier import BoundaryClassifier
from hexmend_app.state.tasks.latest_task import LatestTask
from hexmend_app.state.tasks.mesh_change import MeshChanger
from hexmend_app.state.tasks.mesh_opener import MeshOpener
from hexmend_app.state.tasks.mesh_saver import MeshSaver
from hexmend_app.state.tasks.structure_finder import StructureFinder
from hexmend_app.state.tasks.time_reader import TimeReader
from hexmend_app.state.view.saved_cameras import SavedCameras
from hexmend_app.state.view.side_views import SideViews, Snapshots
from hexmend_app.state.view.view_model import ViewModel


class Session(QObject):
    """The open mesh, its view, the selection, the runs, the tasks in the background, and the commands that change them.

    Signals
    -------
    changed
        Anything that the window shows has changed.
    about_to_save
        The data for a session file are about to be collected: views store data that only they know.
    data_changed
        Data to autosave have changed: anything except selection and camera.

    Attributes
    ----------
    document : Document
    history : History
    run : RunController
    timeline : Timeline
    view : ViewModel
    selection : Selection
    snapshots : Snapshots
    side_views : SideViews
    comparison : Comparison
    run_setup : RunSetup
    recipe_draft : RecipeDraft
    saved_cameras : SavedCameras
    feature_states : FeatureStates
    comparison_bases : ComparisonBases
    opener : MeshOpener
    time_reader : TimeReader
    structure_finder : StructureFinder
    boundary_classifier : BoundaryClassifier
    node_step_task : LatestTask
        Computes `explain` of a mesh, a method and a node.
    mesh_checker : LatestTask
        Computes `examine` of a mesh.
    node_sweep : NodeSweep
    saver : MeshSaver
    repairer, padder : MeshChanger
    commands : Commands
    """

    changed = Signal()
    about_to_save = Signal()
    data_changed = Signal()

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        document = self.document = Document(self)
        self.history = History()
        self.run = RunController(document, self.history, self)
        self.timeline = Timeline(document, self.run, self.history, self)
        self.view = ViewModel(document, self)
        self.selection = Selection(document, self)
        self.snapshots = Snapshots(document, self)
        self.side_views = SideViews(document, self.snapshots, self)
        self.comparison = Comparison(document, self)
        self.run_setup = RunSetup(self)
        self.recipe_draft = RecipeDraft(self.run_setup, self)
        self.saved_cameras = SavedCameras(self)
        self.feature_states = FeatureStates(self)
        self.comparison_bases = ComparisonBases(document, self.history)
        self.opener = MeshOpener(document, self)
        self.time_reader = TimeReader(document, self.timeline, self)
        self.structure_finder = StructureFinder(document, self)
        self.boundary_classifier = BoundaryClassifier(document, self)
        self.node_step_task = LatestTask("computing the step of a node", explain, self)
        self.mesh_checker = LatestTask("checking the mesh", examine, self)
        self.node_sweep = NodeSweep(document, self)
        self.saver = MeshSaver(document, self.saved_cameras, self)
        self.repairer, self.padder = MeshChanger(document, self), MeshChanger(document, self)
        self.commands = Commands(self)
        # The parts that session files store, in the order in which they are restored.
        self._saved: dict[str, Any] = {field.name: getattr(self, field.name) for field in fields(SessionData)}
        self._hex_sets: Mapping[str, np.ndarray] = {}  # of the mesh before the last change
        document.mesh_replaced.connect(self._drop_unknown_rules)
        document.mesh_replaced.connect(self.feature_states.forget_undeclared)
        document.changes_changed.connect(self._follow_renamed_sets)
        self.opener.mesh_read.connect(self._reset_settings)
        self.opener.mesh_read.connect(self.time_reader.read)
        self.opener.loaded.connect(self.restore)
        self.opener.restored.connect(self._show_as_picture)
        self._connect_changes()

    def _connect_changes(self) -> None:
        """Connect the signals of the parts with `data_changed` and `changed`."""
        data = (
            self.document.changes_changed, self.timeline.runs_changed, self.view.changed, self.snapshots.changed,
            self.side_views.changed, self.comparison.changed, self.run_setup.changed, self.recipe_draft.changed,
            self.saved_cameras.changed, self.feature_states.changed,
        )  # fmt: skip
        run, timeline, opener, saver = self.run, self.timeline, self.opener, self.saver
        others = (
            self.document.mesh_replaced, self.document.points_moved,
            run.phase_changed, run.iterated, run.hit, run.ended, run.failed,
            timeline.changed, timeline.moved,
            self.selection.changed, self.side_views.wiped, self.comparison.progressed, self.run_setup.chosen,
            self.node_sweep.changed,
            opener.began, opener.progressed, opener.ended, opener.cancelled, opener.failed, opener.mesh_missing,
            self.time_reader.progressed, self.time_reader.ended,
            saver.began, saver.progressed, saver.ended, saver.failed,
            *(task.found for task in (self.structure_finder, self.boundary_classifier, self.node_step_task,
                                      self.mesh_checker)),
            *(signal for one in (self.repairer, self.padder)
              for signal in (one.began, one.ended, one.failed, one.cancelled)),
        )  # fmt: skip
        for signal in data:
            signal.connect(self.data_changed)
        for signal in (*data, *others):
            signal.connect(self.changed)

    @property
    def editable(self) -> bool:
        """True if the mesh can be edited: no task that changes it is active, and no file is being read."""
        changing = (self.run, self.opener, self.repairer, self.padder)
        return self.document.is_open and not any(part.busy for part in changing)

    @property
    def savable(self) -> bool:
        """True if the session can be saved: nothing is being read, and no run is active, unless it is paused."""
        reading = self.opener.busy or self.time_reader.busy
        return not reading and (not self.run.busy or self.run.phase is Phase.PAUSED)

    @property
    def modified(self) -> bool:
        """True if there are unsaved changes of the mesh or, if a session is open, of the cameras."""
        path = self.document.path
        is_session = path is not None and path.suffix.lower() == SUFFIX
        return self.document.modified or (is_session and self.saved_cameras.modified)

    def end_previews(self) -> None:
        """End a sweep node by node, with the preview of its intermediate state, and the look at an earlier state."""
        self.node_sweep.leave()
        self.document.end_before()

    def to_data(self) -> SessionData:
        """Return the data for a session file; a mesh is open, and no run and no sweep is active."""
        self.about_to_save.emit()
        history = self.history.to_data([self.document.now, *self.document.states])
        parts = {name: part.to_data() for name, part in self._saved.items() if part is not self.history}
        return SessionData(history=history, **parts)

    def restore(self, data: SessionData, path: Path | None = None) -> None:
        """Restore the state of a session file.

        Parameters
        ----------
        data : SessionData
        path : Path, optional
            The session file; None for a session that was recovered, which has no file.
        """
        for name, part in self._saved.items():
            part.restore(getattr(data, name))
        if path is not None:
            self.document.mark_saved(path, self.document.recorded)
            self.saved_cameras.mark_saved()

    def close(self) -> None:
        """Cancel the tasks of all parts; `wait_for_dropped` waits for their threads."""
        for part in (
            self.run, self.comparison, self.opener, self.time_reader, self.structure_finder,
            self.boundary_classifier, self.node_step_task, self.mesh_checker, self.saver, self.repairer, self.padder,
        ):  # fmt: skip
            part.close()

    def _reset_settings(self) -> None:
        """Set the next run, breakpoints and materials in the view, set for the mesh before, back to their defaults."""
        self.run_setup.reset()
        self.run.set_breakpoints(Breakpoints())
        look = self.view.look
        metric = "q" if look.colours.metric == MATERIAL.name else look.colours.metric
        self.view.change(colours={"metric": metric}, structure=look.structure.without("interfaces"))

    def _drop_unknown_rules(self) -> None:
        if self.document.is_open:
            self.run_setup.set_rules(self.run_setup.rules.limited_to(set_names(self.document.now.mesh)))

    def _follow_renamed_sets(self) -> None:
        if self.document.is_open:
            mesh, before = self.document.now.mesh, self._hex_sets
            self._hex_sets = mesh.hex_sets
            self.run_setup.follow_renamed_sets(before, mesh)

    def _show_as_picture(self, restored: RestoredPicture) -> None:
        """Show the mesh as in a picture: appearance, other states next to it, selected hex, camera and recipe."""
        metadata, show = restored.metadata, restored.look.show
        self.view.show_as(replace(restored.look, show=replace(show, marked=frozenset())))
        self.selection.choose(min(show.marked, default=None))
        for other in restored.others:
            if other.state is not None:
                self.side_views.show(other.name, other.state)
        if restored.wipe_position is not None:
            self.side_views.set_wiping(True)
            self.side_views.move_wipe(restored.wipe_position)
        self.view.request_camera(metadata.scene.camera_of(metadata.panels[0]))
        self.saved_cameras.add_all(metadata.scene.cameras)
        if metadata.recipe is not None:
            self.recipe_draft.load(metadata.recipe)
