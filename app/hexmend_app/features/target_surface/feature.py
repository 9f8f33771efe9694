"""Surface of a file on which the boundary slides."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from hexmend.errors import HexmendError
from hexmend.io.surfaces.read import sliding_on_file
from hexmend.parameters import declared
from hexmend.run.recipe import Stage
from hexmend_app.feature import Action, Feature
from hexmend_app.state.tasks.task import Task
from hexmend_app.translation import tr
from hexmend_app.widgets.dialogs.questions import ask_to_open


class FeatureTargetSurface(Feature):
    """Lets the boundary slide on the surface of a file, and on itself again."""

    def actions(self) -> Iterable[Action]:
        """Yield the actions that choose a surface and remove it."""
        yield Action(
            id="slide_on_surface",
            text=tr("Slide on surface o&f file…"),
            menu="Smooth",
            section=3,
            help=tr("Let the boundary slide on a surface from a file, such as an STL file; undo reverts this."),
            handle=self.ask,
            enabled=lambda: self.session.editable,
        )
        yield Action(
            id="slide_on_boundary",
            text=tr("Slide on own &boundary"),
            menu="Smooth",
            section=3,
            help=tr("Remove the surface of the file, so that the boundary slides on itself; undo reverts this."),
            handle=self._remove,
            enabled=lambda: self.session.editable and self.session.document.now.mesh.target is not None,
        )

    def ask(self) -> None:
        """Ask for the file of a surface, and let the boundary slide on it."""
        kinds = tr("Surfaces (*.stl *.obj *.ply *.vtp *.vtk);;All files (*)")
        path = ask_to_open(self.host.dialog_parent, tr("Slide on surface of file"), kinds)
        if path:
            self.choose(path)

    def choose(self, path: str | Path) -> bool:
        """Let the boundary slide on the surface of a file; return False if it cannot be read or does not fit."""
        commands, path = self.session.commands, Path(path)
        now = self.session.document.now
        task = Task(f"reading {path.name}", lambda _: sliding_on_file(now.mesh, path).target)
        task.start()
        completed = self.host.wait_until(tr("Reading {name}…", name=path.name), lambda: task.over)
        if not completed or self.session.document.now is not now:
            task.drop()
            return False
        task.wait()
        if isinstance(task.error, HexmendError):
            self.host.messages.show_error(tr("Surface not used"), str(task.error))
            return False
        if task.error is not None:
            raise task.error
        commands.slide_on(task.result, path)
        self._show(True)
        self._let_slide()
        self.host.messages.show_info(tr("The boundary slides on {name}.", name=path.name))
        return True

    def _remove(self) -> None:
        self.session.commands.slide_on_boundary()
        self._show(False)

    def _show(self, on: bool) -> None:
        view = self.session.view
        view.change(structure=view.look.structure.switched("target", on))

    def _let_slide(self) -> None:
        """Set the boundary of the selected method to slide."""
        setup = self.session.run_setup
        stage = setup.checked_stage()
        if stage is None or stage.smoother.slides or "boundary" not in {one.name for one in declared(stage.smoother)}:
            return
        stage = Stage(replace(stage.smoother, boundary="slide"), stage.stop)  # type: ignore[call-arg]
        setup.choose(stage, tr("The boundary is now set to slide."))
