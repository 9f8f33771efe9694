"""Dialogs that ask for a file, or about unsaved work, or wait for a task in a thread."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Collection, Sequence
from enum import Enum
from pathlib import Path

from PySide6.QtCore import QEventLoop, Qt, QTimer
from PySide6.QtWidgets import QFileDialog, QInputDialog, QLineEdit, QMessageBox, QWidget

from hexmend.io import readable_suffixes, writable_suffixes
from hexmend_app.formats.session import SUFFIX
from hexmend_app.state.settings.settings import FOLDER
from hexmend_app.translation import tr

#: Milliseconds until the dialog is shown, and between two checks.
_DELAY, _PERIOD = 300, 20


class Answer(Enum):
    """Answer to a question about unsaved work."""

    SAVE = "save"
    DISCARD = "discard"
    CANCEL = "cancel"


def ask_mesh(parent: QWidget) -> str:
    """Ask for the mesh or session to open; "" if cancelled."""
    kinds = " ".join(f"*{suffix}" for suffix in readable_suffixes())
    filters = "Hexahedral meshes and sessions ({kinds});;Hexmend sessions (*{suffix});;All files (*)"
    return ask_to_open(parent, tr("Open mesh or session"), tr(filters, kinds=kinds, suffix=SUFFIX))


def ask_mesh_target(parent: QWidget, title: str, stem: str, suffix: str = ".vtu") -> str:
    """Ask for the file to save a mesh to; "" if cancelled. The suffix is proposed if it can be written."""
    suffix = suffix.lower() if suffix.lower() in writable_suffixes() else ".vtu"
    kinds = ";;".join(map(_mesh_kind, writable_suffixes()))
    return ask_to_save(parent, title, f"{stem}{suffix}", kinds, _mesh_kind(suffix))


def ask_session(parent: QWidget, stem: str) -> str:
    """Ask for the file to save the session to; "" if cancelled."""
    kinds = tr("Hexmend session (*{suffix})", suffix=SUFFIX)
    return ask_to_save(parent, tr("Save session as"), f"{stem}{SUFFIX}", kinds)


def ask_to_open(parent: QWidget, title: str, kinds: str) -> str:
    """Ask for a file to read; "" if cancelled. Kinds of file are in the notation of Qt."""
    path = QFileDialog.getOpenFileName(parent, title, str(folder()), kinds)[0]
    if path:
        remember_folder(Path(path))
    return path


def ask_folder(parent: QWidget, title: str) -> str:
    """Ask for a folder to read; "" if cancelled."""
    return QFileDialog.getExistingDirectory(parent, title, str(folder()))


def ask_to_save(parent: QWidget, title: str, name: str, kinds: str, kind: str = "") -> str:
    """Ask for a file to write, with the default `name` and `kind`; "" if cancelled. See `ask_to_open` for the kinds."""
    entered, kind = QFileDialog.getSaveFileName(parent, title, str(folder() / name), kinds, kind)
    path = named(entered, kind or kinds)
    if not path or (path != entered and not ask_replacing(parent, path)):  # the dialog has asked about `entered`
        return ""
    remember_folder(Path(path))
    return path


def remember_folder(path: Path) -> None:
    """Store the folder of a file as the folder in which the next dialog starts."""
    FOLDER.set(path.resolve().parent)


def folder() -> Path:
    """Return the folder in which dialogs start.

    It is that of the last opened or saved file, else the working directory of a program that was started in a terminal,
    else the home folder.
    """
    last = FOLDER.get()
    if last != FOLDER.default and last.is_dir():
        return last
    return Path.cwd() if sys.stdin is not None and sys.stdin.isatty() else Path.home()


def named(path: str, kinds: str) -> str:
    """Return a path with the suffix of the first kind of file if it has no suffix; no kind stands for a folder.

    >>> named("dir/bridge", "Table (*.csv);;Markdown (*.md)"), named("bridge.pdf", "Table (*.csv)"), named("", "(*.md)")
    ('dir/bridge.csv', 'bridge.pdf', '')
    """
    return path + re.search(r"\.\w+", kinds)[0] if path and kinds and not Path(path).suffix else path


def ask_replacing(parent: QWidget, path: str) -> bool:
    """Ask before an existing file is replaced; return True if it may be written."""
    try:
        exists = Path(path).exists()
    except OSError:  # the path is invalid, which is reported when it is written
        exists = False
    return not exists or _ask_yes(parent, tr("{file} already exists.", file=Path(path).name), tr("Replace it?"))


def ask_camera_name(parent: QWidget, names: Collection[str]) -> str:
    """Ask for the name under which to save a camera; "" if cancelled. Ask again before one of `names` is replaced."""
    default = next(name for k in range(1, len(names) + 2) if (name := f"camera {k}") not in names)
    label = tr("Name, for pictures and hexmend render --camera:")
    text, accepted = QInputDialog.getText(parent, tr("Save camera"), label, QLineEdit.EchoMode.Normal, default)
    name = text.strip() if accepted else ""
    problem = tr("The camera “{name}” already exists.", name=name)
    return name if name not in names or _ask_yes(parent, problem, tr("Replace it?")) else ""


def ask_new_name(parent: QWidget, title: str, name: str) -> str:
    """Ask for another name of something, with the title of the question; "" if cancelled."""
    text, accepted = QInputDialog.getText(parent, title, tr("New name:"), QLineEdit.EchoMode.Normal, name)
    return text.strip() if accepted else ""


def ask_unsaved(parent: QWidget, name: str, of_mesh: bool = True, in_session: bool = False) -> Answer:
    """Ask about an unsaved mesh or, without `of_mesh`, about cameras not saved in a session.

    Parameters
    ----------
    parent : QWidget
    name : str
        Name of the mesh.
    of_mesh : bool
        The mesh has changed.
    in_session : bool
        A session is open: it is saved with all that has changed.
    """
    buttons = QMessageBox.StandardButton
    text = tr("{name} has unsaved changes.", name=name) if of_mesh else tr("{name} has unsaved cameras.", name=name)
    mesh, session = tr("Save the mesh before closing it?"), tr("Save the session before closing it?")
    box = _question(parent, text, mesh if of_mesh and not in_session else session)
    box.setStandardButtons(buttons.Save | buttons.Discard | buttons.Cancel)
    box.setDefaultButton(buttons.Save)
    return {buttons.Save: Answer.SAVE, buttons.Discard: Answer.DISCARD}.get(buttons(box.exec()), Answer.CANCEL)


def ask_rewrite(parent: QWidget, path: Path, original: Path, lost: Sequence[str]) -> bool | None:
    """Ask whether to write a file anew instead of replacing coordinates in a copy of the original; None if cancelled.

    Parameters
    ----------
    parent : QWidget
    path, original : Path
    lost : sequence of str
        Data of the mesh that a new file cannot hold.
    """
    parts = [
        tr("Replacing keeps everything else in {original}, byte for byte where possible.", original=original.name),
        tr("A rewritten file has the mesh with its sets and data; comments and solver properties are lost."),
    ]
    if lost:
        parts.append(tr("Also lost: {count}.", count=", ".join(lost)))
    text = tr("Replace only the coordinates, or rewrite {name}?", name=path.name)
    box = _question(parent, text, " ".join(parts))
    box.setWindowTitle(tr("Save mesh as"))
    replace = box.addButton(tr("Replace coordinates"), QMessageBox.ButtonRole.AcceptRole)
    anew = box.addButton(tr("Rewrite file"), QMessageBox.ButtonRole.DestructiveRole)
    cancel = box.addButton(QMessageBox.StandardButton.Cancel)
    box.setDefaultButton(replace)
    box.exec()
    return None if box.clickedButton() is cancel else box.clickedButton() is anew


def ask_short_of_memory(parent: QWidget, problem: str, remedy: str) -> bool:
    """Ask before a run that may exceed the memory; return True to start it."""
    space = re.compile(r"(?<=\d) (?=[GM]B)")  # made unbreakable, to keep numbers and units together
    remedy = space.sub("\u00a0", remedy)
    question = tr("{remedy} If memory runs out, the system may end the program. Run anyway?", remedy=remedy)
    return _ask_yes(parent, space.sub("\u00a0", problem), question, QMessageBox.Icon.Warning)


def show_about(parent: QWidget, version: str) -> None:
    """Show version, licence and source of the mathematics."""
    QMessageBox.about(
        parent,
        tr("About Hexmend"),
        tr(
            "<b>Hexmend {version}</b><p>Viewer and smoother for hexahedral meshes.</p>"
            "<p>Its methods follow T. J. Wilson's thesis <i>Simultaneous Untangling and Smoothing of Hexahedral "
            "Meshes</i>. BSD 3-clause licence.</p>",
            version=version,
        ),
    )


def _mesh_kind(suffix: str) -> str:
    """Return the entry of a mesh format in a file dialog."""
    return tr("{format} mesh (*{suffix})", format=suffix[1:].upper(), suffix=suffix)


def _question(
    parent: QWidget, text: str, details: str, icon: QMessageBox.Icon = QMessageBox.Icon.Question
) -> QMessageBox:
    """Return a message box with plain texts, to which buttons are to be added."""
    box = QMessageBox(parent)
    box.setTextFormat(Qt.TextFormat.PlainText)
    box.setIcon(icon)
    box.setText(text)
    box.setInformativeText(details)
    return box


def _ask_yes(parent: QWidget, text: str, question: str, icon: QMessageBox.Icon = QMessageBox.Icon.Question) -> bool:
    """Ask before something is done that may lose data; return True to continue."""
    buttons = QMessageBox.StandardButton
    box = _question(parent, text, question, icon)
    box.setStandardButtons(buttons.Yes | buttons.No)
    box.setDefaultButton(buttons.No)
    return box.exec() == buttons.Yes


def waiting_dialog(parent: QWidget, text: str, over: Callable[[], bool], leave: str) -> QMessageBox:
    """Return a dialog that names a task, and closes when the task is done or Cancel is pressed.

    Parameters
    ----------
    parent : QWidget
    text : str
        Description of the task.
    over : callable
        Returns True once the task is done.
    leave : str
        Text of the button that continues without waiting; "" for no button.
    """
    box = QMessageBox(parent)
    box.setWindowTitle(tr("Please wait"))
    box.setTextFormat(Qt.TextFormat.PlainText)
    box.setText(text)
    box.setStandardButtons(QMessageBox.StandardButton.Cancel)
    box.setDefaultButton(QMessageBox.StandardButton.Cancel)  # so that Enter does not press `leave`
    if leave:
        box.addButton(leave, QMessageBox.ButtonRole.AcceptRole)
    timer = QTimer(box, interval=_PERIOD)
    timer.timeout.connect(lambda: box.accept() if over() else None)
    timer.start()
    return box


def wait_until(parent: QWidget, text: str, over: Callable[[], bool], leave: str = "") -> bool:
    """Wait until a task is done, and show a dialog if it takes more than a moment.

    Parameters
    ----------
    parent : QWidget
        The window, which takes no input meanwhile.
    text, over, leave
        See `waiting_dialog`.

    Returns
    -------
    bool
        True to continue; False if the user has cancelled.
    """
    if not over():
        _wait_a_moment(over)
    if over():
        return True
    dialog = waiting_dialog(parent, text, over, leave)
    answer = dialog.exec()
    dialog.deleteLater()
    return answer != QMessageBox.StandardButton.Cancel


def _wait_a_moment(over: Callable[[], bool]) -> None:
    """Wait for at most `_DELAY` without a dialog, which would only flash; user input is handled afterwards."""
    loop = QEventLoop()
    timer = QTimer(interval=_PERIOD)
    timer.timeout.connect(lambda: loop.quit() if over() else None)
    timer.start()
    QTimer.singleShot(_DELAY, loop.quit)
    loop.exec(QEventLoop.ProcessEventsFlag.ExcludeUserInputEvents)
