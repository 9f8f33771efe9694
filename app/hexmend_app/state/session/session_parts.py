"""The parts of a window's state, and how they are saved and restored together."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from PySide6.QtCore import QObject, Signal

from hexmend.doctor import examine
from hexmend.mesh.rules.named_sets import set_names
from hexmend_app.formats.session import SUFFIX
from hexmend_app.state.mesh.comparison_base import ComparisonBases
from hexmend_app.state.mesh.document import Document
from hexmend_app.state.mesh.history import History
from hexmend_app.state.mesh.selection import Selection
from hexmend_app.state.mesh.snapshots import Snapshots
from hexmend_app.state.node_step import explain
from hexmend_app.state.run.comparison import Comparison
from hexmend_app.state.run.node_sweep import NodeSweep
from hexmend_app.state.run.recipe_draft import RecipeDraft
from hexmend_app.state.run.run_controller import RunController
from hexmend_app.state.run.run_setup import RunSetup
from hexmend_app.state.run.timeline import Timeline
from hexmend_app.state.session.state_part import FeatureStates, StatePart
from hexmend_app.state.tasks.boundary_classifier import BoundaryClassifier
from hexmend_app.state.tasks.latest_task import LatestTask
from hexmend_app.state.tasks.mesh_opener import MeshOpener
from hexmend_app.state.tasks.structure_finder import StructureFinder
from hexmend_app.state.tasks.time_reader import TimeReader
from hexmend_app.state.view.camera_request import CameraRequest
from hexmend_app.state.view.saved_cameras import SavedCameras
from hexmend_app.state.view.side_views import SideViews
from hexmend_app.state.view.view_model import ViewModel

if TYPE_CHECKING:
    import numpy as np

    from hexmend_app.state.session.session_data import SessionData

Part = TypeVar("Part", bound=Any)


class SessionParts(QObject):
    """The open mesh, its view, the selection, the runs, and the tasks in the background.

    Signals
    -------
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
    camera_request : CameraRequest
    opener : MeshOpener
    time_reader : TimeReader
    structure_finder : StructureFinder
    boundary_classifier : BoundaryClassifier
    node_step_task : LatestTask
        Computes `explain` of a mesh, a method and a node.
    mesh_checker : LatestTask
        Computes `examine` of a mesh.
    node_sweep : NodeSweep
    """

    about_to_save = Signal()
    data_changed = Signal()

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self._parts: list[StatePart] = []  # in the order in which they are restored
        self._changing: list[Any] = []  # parts that replace the mesh while they are `busy`
        document = self.document = self._add_part("document", Document(self), "changes_changed")
        self.history = History()
        self._parts.append(StatePart(name="history", to_data=self._history_data, restore=self.history.restore))
        self.run = RunController(document, self.history, self)
        self.timeline = self._add_part("timeline", Timeline(document, self.run, self.history, self), "runs_changed")
        self.view = self._add_part("view", ViewModel(document, self), "changed")
        self.selection = self._add_part("selection", Selection(document, self))
        self.snapshots = self._add_part("snapshots", Snapshots(document, self), "changed")
        self.side_views = self._add_part("side_views", SideViews(document, self.snapshots, self), "changed")
        self.comparison = self._add_part("comparison", Comparison(document, self), "changed")
        self.run_setup = self._add_part("run_setup", RunSetup(self), "changed")
        self.recipe_draft = self._add_part("recipe_draft", RecipeDraft(self.run_setup, self), "changed")
        document.mesh_replaced.connect(self._drop_unknown_rules)
        self._hex_sets: Mapping[str, np.ndarray] = {}  # of the mesh before the last change
        document.changes_changed.connect(self._follow_renamed_sets)
        self._parts.append(
            StatePart(name="breakpoints", to_data=lambda: self.run.breakpoints, restore=self.run.break_at)
        )
        self.saved_cameras = self._add_part("cameras", SavedCameras(self), "changed")
        self.feature_states = self._add_part("features", FeatureStates(self), "changed")
        document.mesh_replaced.connect(self.feature_states.forget_undeclared)
        self.comparison_bases = ComparisonBases(document, self.history)
        self.camera_request = CameraRequest(self)
        self.opener = MeshOpener(document, self)
        self.time_reader = TimeReader(document, self.timeline, self)
        self.opener.mesh_read.connect(self.time_reader.read)
        self.structure_finder = StructureFinder(document, self)
        self.boundary_classifier = BoundaryClassifier(document, self)
        self.node_step_task = LatestTask("computing the step of a node", explain, self, yields=True)
        self.mesh_checker = LatestTask("checking the mesh", examine, self)
        self.node_sweep = NodeSweep(document, self)
        self._changing += [self.run, self.opener]

    def _add_part(self, name: str, part: Part, change: str = "") -> Part:
        """Register a part by its name in session files, with the name of its change signal, and return it."""
        self._parts.append(StatePart(name=name, to_data=part.to_data, restore=part.restore))
        if change:
            getattr(part, change).connect(self.data_changed)
        return part

    @property
    def editable(self) -> bool:
        """True if the mesh can be edited: no task that changes it is active, and no file is being read."""
        return self.document.is_open and not any(part.busy for part in self._changing)

    @property
    def modified(self) -> bool:
        """True if there are unsaved changes of the mesh or, if a session is open, of the cameras."""
        path = self.document.path
        is_session = path is not None and path.suffix.lower() == SUFFIX
        return self.document.modified or (is_session and self.saved_cameras.modified)

    def end_previews(self) -> None:
        """End a sweep node by node, and with it the preview of its intermediate state."""
        self.node_sweep.leave()

    def to_data(self) -> SessionData:
        """Return the data for a session file; a mesh is open, and no run and no sweep is active."""
        from hexmend_app.state.session.session_data import SessionData

        self.about_to_save.emit()
        return SessionData(**{part.name: part.to_data() for part in self._parts})

    def restore(self, data: SessionData, path: Path | None = None) -> None:
        """Restore the state of a session file.

        Parameters
        ----------
        data : SessionData
        path : Path, optional
            The session file; None for a session that was recovered, which has no file.
        """
        for part in self._parts:
            part.restore(getattr(data, part.name))
        if path is not None:
            self.document.mark_saved(path, self.document.recorded)
            self.saved_cameras.mark_saved()

    def close(self) -> None:
        """Cancel the tasks of all parts; `wait_for_dropped` waits for their threads."""
        for part in self.children():
            if hasattr(part, "close"):
                part.close()

    def _drop_unknown_rules(self) -> None:
        if self.document.is_open:
            self.run_setup.set_rules(self.run_setup.rules.limited_to(set_names(self.document.now.mesh)))

    def _follow_renamed_sets(self) -> None:
        if self.document.is_open:
            mesh, before = self.document.now.mesh, self._hex_sets
            self._hex_sets = mesh.hex_sets
            self.run_setup.follow_renamed_sets(before, mesh)

    def _history_data(self) -> object:
        """Return the data of the runs, with the iterations that the states of the document show."""
        document = self.document.to_data()
        return self.history.to_data([document.now, *(change.state for change in document.changes)])
