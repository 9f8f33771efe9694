"""Commands that open meshes: by dialog, drag and drop, recent files or the demo mesh."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial
from pathlib import Path
from typing import Any

from PySide6.QtCore import QEvent, QObject, QTimer
from PySide6.QtGui import QDropEvent

from hexmend.errors import FileError
from hexmend.mesh.mesh import Mesh
from hexmend_app.feature import Action, Feature, Host, Panel, PanelPlace
from hexmend_app.features.open.welcome import RecentMenu, Welcome, card
from hexmend_app.formats.session import SUFFIX
from hexmend_app.resources import demo_mesh
from hexmend_app.state.mesh.mesh_place import mesh_place
from hexmend_app.state.session.restored_picture import MissingMesh, RestoredMesh, RestoredPicture
from hexmend_app.state.settings.settings import RecentFiles
from hexmend_app.state.tasks.mesh_opener import LoadProgress, LoadStage
from hexmend_app.translation import tr
from hexmend_app.widgets.dialogs.questions import ask_folder, ask_mesh, remember_folder

#: Milliseconds for which the card of a mesh without findings is shown.
_CARD_MS = 10_000
#: Most hexes of a mesh that the doctor checks unasked.
_CHECKED = 300_000


class FeatureOpen(Feature):
    """Opens meshes, shows the progress and remembers the recent files."""

    def __init__(self, host: Host):
        super().__init__(host)
        self._document, self._opener = host.session.document, host.session.opener
        self._restored: RestoredPicture | None = None
        self.recent = RecentFiles(self)
        self._menu = RecentMenu(self.recent, host.dialog_parent)
        self._menu.chosen.connect(self.open)
        self.welcome = Welcome(self.recent)
        self.welcome.open_button.clicked.connect(self.ask)
        self.welcome.demo_button.clicked.connect(self.open_demo)
        self.welcome.recent_requested.connect(self.open)
        opener = self._opener
        opener.began.connect(lambda path: self._show_progress(LoadProgress(LoadStage.READING, path)))
        opener.progressed.connect(self._show_progress)
        opener.restored.connect(self._on_restored)
        opener.mesh_missing.connect(self._on_mesh_missing)
        opener.ended.connect(self._on_ended)
        self.session.saver.ended.connect(lambda saving: self.recent.add(mesh_place(saving.path)))
        self._carded: tuple[Mesh | None, str] = (None, "")  # mesh and title of the card that may be extended
        self.session.mesh_checker.found.connect(self._on_found)
        opener.cancelled.connect(self._on_cancelled)
        opener.failed.connect(self._on_failed)
        host.dialog_parent.setAcceptDrops(True)
        host.dialog_parent.installEventFilter(self)

    def actions(self) -> Iterable[Action]:
        """Yield the actions that open a mesh or the demo."""
        yield Action(
            id="open",
            text=tr("&Open…"),
            menu="File",
            keys="Ctrl+O",
            icon="folder-open-outline",
            help=tr("Open a mesh file."),
            tool=tr("Open"),
            needs_mesh=False,
            handle=self.ask,
            submenu=self._menu,
        )
        yield Action(
            id="open_case",
            text=tr("Open &case folder…"),
            menu="File",
            help=tr("Open an OpenFOAM case by its folder."),
            needs_mesh=False,
            handle=self.ask_case,
        )
        yield Action(
            id="open_demo",
            text=tr("Open &demo mesh"),
            menu="File",
            help=tr("Open the demo mesh included with Hexmend."),
            needs_mesh=False,
            handle=self.open_demo,
        )

    def panels(self) -> Iterable[Panel]:
        """Yield the welcome page, shown while no mesh is open."""
        yield Panel(id="welcome", title=tr("Welcome"), widget=self.welcome, place=PanelPlace.EMPTY)

    def refresh(self) -> None:
        """Show the welcome page only while no mesh is open or opening."""
        self.welcome.setVisible(not (self._document.is_open or self._opener.busy))

    def open(self, path: str | Path) -> None:
        """Open a mesh, after asking about unsaved changes."""
        if self.host.confirm_close():
            self.session.commands.open(path)

    def ask(self) -> None:
        """Show the dialog for a mesh file and open the file."""
        if path := ask_mesh(self.host.dialog_parent):
            self.open(path)

    def ask_case(self) -> None:
        """Show the dialog for the folder of an OpenFOAM case and open it."""
        if path := ask_folder(self.host.dialog_parent, tr("Open OpenFOAM case")):
            self.open(path)

    def open_demo(self) -> None:
        """Open the demo mesh included with Hexmend."""
        self.open(demo_mesh())

    def eventFilter(self, watched: QObject, event: Any) -> bool:
        """Open a single file that is dropped on the window."""
        kind = event.type()
        if kind == QEvent.Type.DragEnter and _dragged_file(event):
            event.acceptProposedAction()
            return True
        if kind == QEvent.Type.Drop and (path := _dragged_file(event)):
            event.acceptProposedAction()
            QTimer.singleShot(0, self, lambda: self.open(path))
            return True
        return super().eventFilter(watched, event)

    def _show_progress(self, progress: LoadProgress) -> None:
        if self._opener.busy:
            share = progress.file.share if progress.file is not None else None
            self.host.busy.show_work(
                "open", stage_text(progress), tr("Cancel"), tr("Cancel opening (Esc)."), self._opener.cancel, share
            )

    def _on_ended(self, path: Path) -> None:
        self.host.busy.done("open")
        self.host.messages.clear()
        if restored := self._restored:
            self._restored = None
            show = self.host.messages.show_info if restored.matches else self.host.messages.show_warning
            show(*restored_message(restored))  # type: ignore[arg-type]  # one text for `show_info`
        else:
            self._show_card()
        if path.resolve() != demo_mesh().resolve():
            remember_folder(mesh_place(path))
            self.recent.add(mesh_place(path))

    def _show_card(self) -> None:
        """Show what was opened, until the first action if something was changed or is wrong with it."""
        state, host = self._document.now, self.host
        findings = self.session.mesh_checker.of(state.mesh) or ()
        title, text = card(self._document.name, state, findings)
        choices = [(tr("Show worst"), lambda: host.action("next_worst").trigger())]
        choices += [(tr("Doctor"), partial(host.show_panel, "doctor"))] if findings else []
        stays = bool(state.mesh.notes or findings)
        host.messages.show_card(title, text, choices, 0 if stays else _CARD_MS)
        self._carded = state.mesh, title
        if state.mesh.n_elements <= _CHECKED:
            self.session.mesh_checker.ask(state.mesh)

    def _on_found(self) -> None:
        """Show the findings of the doctor on the card, as long as that is there and the mesh as it was opened."""
        mesh, title = self._carded
        self._carded = None, ""
        there = any(title == one for _, one, _ in self.host.messages.messages())
        if there and self._document.is_open and self._document.now.mesh is mesh and self.session.mesh_checker.of(mesh):
            self._show_card()

    def _on_restored(self, restored: RestoredPicture) -> None:
        self._restored = restored

    def _on_mesh_missing(self, missing: MissingMesh) -> None:
        self.host.busy.done("open")
        self.host.messages.show_warning(
            *missing_mesh_message(missing),
            ((tr("Locate mesh…"), lambda: self._locate(missing)), (tr("Dismiss"), lambda: None)),
        )
        self.host.refresh_soon()

    def _locate(self, missing: MissingMesh) -> None:
        """Ask for the mesh file of a picture and open it with the picture's camera and appearance."""
        path = ask_mesh(self.host.dialog_parent)
        if path and self.host.confirm_close():
            self._opener.open(path, picture=missing)

    def _on_cancelled(self, path: Path) -> None:
        self.host.busy.done("open")
        name, note = mesh_place(path).name, self._open_mesh_note()
        self.host.messages.show_info(
            tr("Opening {name} was cancelled.{open_mesh_note}", name=name, open_mesh_note=note)
        )

    def _on_failed(self, path: Path, error: BaseException) -> None:
        self.host.busy.done("open")
        detail = f"{error.problem}. {error.remedy}" if isinstance(error, FileError) else str(error)
        detail = detail[:1].upper() + detail[1:].rstrip()
        title = tr("{name} cannot be opened", name=mesh_place(path).name)
        self.host.messages.show_error(title, detail + self._open_mesh_note())

    def _open_mesh_note(self) -> str:
        return tr(" {name} stays open.", name=self._document.name) if self._document.is_open else ""


def _dragged_file(event: QDropEvent) -> str:
    """Return the path of a single local file that is dragged; "" for anything else."""
    urls = event.mimeData().urls()
    return urls[0].toLocalFile() if len(urls) == 1 else ""


def stage_text(progress: LoadProgress) -> str:
    """Describe the stage of loading.

    >>> from pathlib import Path
    >>> stage_text(LoadProgress(LoadStage.MEASURING, Path("a/five.vtu"), "12,345 hexes"))
    'Measuring five.vtu, 12,345 hexes…'
    >>> from hexmend.io.storage.file_progress import FileAction, FileProgress
    >>> file = FileProgress(Path("a/five.vtu"), FileAction.READING, 0.4, 2.0)
    >>> stage_text(LoadProgress(LoadStage.READING, file.path, file=file))
    'Reading five.vtu: 40%, 3 s left…'
    """
    name = mesh_place(progress.path).name
    if progress.file is not None and progress.file.share:
        return tr("Reading {name}: {done}…", name=name, done=progress.file.phrase)
    return {
        LoadStage.READING: tr("Reading {name}…", name=name),
        LoadStage.MEASURING: tr("Measuring {name}, {cells}…", name=name, cells=progress.cells),
        LoadStage.PREPARING: tr("Preparing the view of {name}…", name=name),
    }[progress.stage]


def restored_message(restored: RestoredPicture) -> tuple[str, ...]:
    """Return the message for meshes opened from a picture, with a title first if they differ from the picture."""
    name, picture, metadata = restored.path.name, restored.picture.name, restored.metadata
    others = _other_meshes(restored)
    if restored.digest not in (metadata.first.opened, metadata.first.shown):
        text = tr("{name} has other hexes or node positions than the mesh in {picture}.", name=name, picture=picture)
        return tr("The mesh differs from {picture}", picture=picture), text + others
    text = tr("{name} is shown with the camera and appearance of {picture}", name=name, picture=picture)
    if restored.digest == metadata.first.shown:
        text += "."
    elif metadata.recipe is not None:
        text += tr(", in which it was smoothed by “{title}”; see the Recipe panel.", title=metadata.recipe.title)
    else:
        text += tr(", in which it was changed.")
    if restored.path.suffix.lower() == SUFFIX:
        text += tr(" To restore its runs, open {name}.", name=name)
    return (
        (text + others,)
        if restored.matches
        else (tr("Part of {picture} was not restored", picture=picture), text + others)
    )


def _other_meshes(restored: RestoredPicture) -> str:
    """Describe the other meshes of a picture, as sentences with a leading space."""
    shown = [f"“{mesh.name}”" for mesh in restored.others if mesh.state is not None]
    names = " and ".join(filter(None, (", ".join(shown[:-1]), *shown[-1:])))
    if restored.wipe_position is not None:
        layout = tr("is shown with a wipe")
    else:
        layout = tr("are shown next to it") if len(shown) > 1 else tr("is shown next to it")
    sentences = [f"{names} {layout}."] if shown else []
    sentences += [_problem(mesh) for mesh in restored.others if mesh.problem]
    return "".join(f" {sentence}" for sentence in sentences)


def _problem(mesh: RestoredMesh) -> str:
    """Explain why another mesh of a picture is not shown, or how it differs."""
    if mesh.state is not None:
        return tr("“{name}” differs from the picture: {reason}.", name=mesh.name, reason=mesh.problem)
    return tr("“{name}” is not shown: {reason}.", name=mesh.name, reason=mesh.problem)


def missing_mesh_message(missing: MissingMesh) -> tuple[str, str]:
    """Return title and text for a picture whose mesh file is missing."""
    file = missing.metadata.first.file
    reason = (
        tr("{file} is neither at its path nor next to the picture.", file=file)
        if file
        else tr("The picture does not contain the name of a mesh file.")
    )
    return tr("The mesh of {name} was not found", name=missing.picture.name), reason
