"""Dialogs that ask for a file, or about unsaved work."""

from __future__ import annotations

import re
from collections.abc import Collection
from enum import Enum
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFileDialog, QInputDialog, QLineEdit, QMessageBox, QWidget

from hexmend.io import readable_suffixes, writable_suffixes
from hexmend.io.formats.session import SUFFIX
from hexmend_app.state.settings.settings import FOLDER


class Answer(Enum):
    """The answer to a question about unsaved work."""

    SAVE = "save"
    DISCARD = "discard"
    CANCEL = "cancel"


def ask_mesh(parent: QWidget) -> str:
    """Ask for the mesh or session to open; "" if cancelled."""
    kinds = " ".join(f"*{suffix}" for suffix in readable_suffixes())
    filters = f"Hexahedral meshes and sessions ({kinds});;Hexmend sessions (*{SUFFIX});;All files (*)"
    return _ask_to_open(parent, "Open a mesh or a session", filters)


def ask_target(parent: QWidget, stem: str) -> str:
    """Ask for the file to save the mesh to; "" if cancelled."""
    kinds = ";;".join(f"{suffix[1:].upper()} mesh (*{suffix})" for suffix in writable_suffixes())
    return _ask_to_save(parent, "Save the mesh as", f"{stem}-smoothed.vtu", kinds, "VTU mesh (*.vtu)")


def ask_session(parent: QWidget, stem: str) -> str:
    """Ask for the file to save the session to; "" if cancelled."""
    return _ask_to_save(parent, "Save the session as", f"{stem}{SUFFIX}", f"Hexmend session (*{SUFFIX})")


def ask_list(parent: QWidget, stem: str) -> str:
    """Ask for the file to save the list of the worst elements to; "" if cancelled."""
    return _ask_to_save(parent, "Save the list as", f"{stem}-worst.csv", "Table (*.csv)")


def ask_recipe(parent: QWidget) -> str:
    """Ask for the recipe to load; "" if cancelled."""
    return _ask_to_open(parent, "Load a recipe", "Recipes (*.toml);;All files (*)")


def ask_recipe_target(parent: QWidget) -> str:
    """Ask for the file to save the recipe to; "" if cancelled."""
    return _ask_to_save(parent, "Save the recipe as", "recipe.toml", "Recipe (*.toml)")


def ask_scene(parent: QWidget) -> str:
    """Ask for the scene to load; "" if cancelled."""
    return _ask_to_open(parent, "Load a scene", "Scenes (*.toml);;All files (*)")


def ask_scene_target(parent: QWidget) -> str:
    """Ask for the file to save the scene to; "" if cancelled."""
    return _ask_to_save(parent, "Save the scene as", "scene.toml", "Scene (*.toml)")


def ask_script(parent: QWidget, stem: str) -> str:
    """Ask for the file to save the script to; "" if cancelled."""
    return _ask_to_save(parent, "Save the script as", f"{stem}.py", "Python script (*.py)")


def ask_film(parent: QWidget, stem: str) -> str:
    """Ask for the file to save a film of a run to; "" if cancelled."""
    kinds = (
        "GIF animation (*.gif);;MP4 film, for slides (*.mp4);;WebP animation, smaller and finer (*.webp);;"
        "PNG animation, exact (*.png)"
    )
    return _ask_to_save(parent, "Save the film as", f"{stem}.gif", kinds)


def ask_figures(parent: QWidget, stem: str) -> str:
    """Ask for a new folder for figures; "" if cancelled."""
    asked = QFileDialog.getExistingDirectory(parent, "Make the folder of figures in", str(folder()))
    if not asked:
        return ""
    remember_folder(Path(asked) / stem)
    names = (f"{stem}-figures{f'-{count}' if count else ''}" for count in [0, *range(2, 10_000)])
    return next((str(path) for name in names if not (path := Path(asked) / name).exists()), "")


def remember_folder(path: Path) -> None:
    """Let the next dialog start in the folder of this file."""
    FOLDER.set(path.resolve().parent)


def folder() -> Path:
    """The folder in which dialogs start: that of the last opened or saved file, if it exists."""
    kept = FOLDER.get()
    return kept if kept.is_dir() else Path.home()


def named(path: str, kinds: str) -> str:
    """A path with the suffix of the first of several kinds of file, if it has no suffix.

    >>> named("dir/bridge", "Table (*.csv);;Markdown (*.md)"), named("bridge.pdf", "Table (*.csv)"), named("", "(*.md)")
    ('dir/bridge.csv', 'bridge.pdf', '')
    """
    return path + re.search(r"\.\w+", kinds)[0] if path and not Path(path).suffix else path


def ask_replacing(parent: QWidget, path: str) -> bool:
    """Ask before an existing file is replaced; return True if it may be written."""
    try:
        there = Path(path).exists()
    except OSError:  # whoever writes says that there can be none
        there = False
    return not there or _ask_yes(parent, f"{Path(path).name} already exists.", "Replace it?")


def ask_camera_name(parent: QWidget, names: Collection[str]) -> str:
    """Ask for the name of a saved camera, "" if cancelled; before one of `names` is replaced, ask."""
    free = next(name for k in range(1, len(names) + 2) if (name := f"camera {k}") not in names)
    asked, given = QInputDialog.getText(
        parent, "Keep the camera", "Name, for pictures and hexmend render --camera:", QLineEdit.EchoMode.Normal, free
    )
    name = asked.strip() if given else ""
    return name if name not in names or _ask_yes(parent, f"There is a camera “{name}” already.", "Replace it?") else ""


def ask_unsaved(parent: QWidget, name: str, of_mesh: bool = True) -> Answer:
    """Ask about an unsaved mesh or, without `of_mesh`, about cameras not saved in a session."""
    buttons = QMessageBox.StandardButton
    box = QMessageBox(parent)
    box.setTextFormat(Qt.TextFormat.PlainText)
    box.setIcon(QMessageBox.Icon.Question)
    smoothed, others = f"{name} has been smoothed and not saved.", f"The cameras of {name} are others than were saved."
    box.setText(smoothed if of_mesh else others)
    box.setInformativeText(f"Save the {'smoothed mesh' if of_mesh else 'session'} before it is closed?")
    box.setStandardButtons(buttons.Save | buttons.Discard | buttons.Cancel)
    box.setDefaultButton(buttons.Save)
    return {buttons.Save: Answer.SAVE, buttons.Discard: Answer.DISCARD}.get(box.exec(), Answer.CANCEL)


def ask_short_of_memory(parent: QWidget, problem: str, remedy: str) -> bool:
    """Ask before a run that may exceed the memory; return True to start it."""
    buttons = QMessageBox.StandardButton
    box = QMessageBox(parent)
    box.setTextFormat(Qt.TextFormat.PlainText)
    box.setIcon(QMessageBox.Icon.Warning)
    whole = re.compile(r"(?<=\d) (?=[GM]B)")  # a number stays beside its unit
    box.setText(whole.sub("\u00a0", problem))
    remedy = whole.sub("\u00a0", remedy)
    box.setInformativeText(f"{remedy} If memory runs out, the system may end the program. Run it all the same?")
    box.setStandardButtons(buttons.Yes | buttons.No)
    box.setDefaultButton(buttons.No)
    return box.exec() == buttons.Yes


def show_about(parent: QWidget, version: str) -> None:
    """Version, licence and sources."""
    QMessageBox.about(
        parent,
        "About Hexmend",
        f"<b>Hexmend {version}</b><p>See a hexahedral mesh, and mend it while you watch.</p>"
        "<p>Its mathematics is T. J. Wilson's thesis <i>Simultaneous Untangling and Smoothing of Hexahedral "
        "Meshes</i>. BSD 3-clause licence.</p>",
    )


def _ask_yes(parent: QWidget, text: str, question: str) -> bool:
    """Ask before something is deleted; return True to go on."""
    buttons = QMessageBox.StandardButton
    box = QMessageBox(parent)
    box.setTextFormat(Qt.TextFormat.PlainText)
    box.setIcon(QMessageBox.Icon.Question)
    box.setText(text)
    box.setInformativeText(question)
    box.setStandardButtons(buttons.Yes | buttons.No)
    box.setDefaultButton(buttons.No)
    return box.exec() == buttons.Yes


def _ask_to_save(parent: QWidget, title: str, name: str, kinds: str, chosen: str = "") -> str:
    """Ask for a file of one of several kinds, with the default `name`; "" if cancelled."""
    asked, kind = QFileDialog.getSaveFileName(parent, title, str(folder() / name), kinds, chosen)
    path = named(asked, kind or kinds)
    if not path or (path != asked and not ask_replacing(parent, path)):  # the dialog has asked about its own name
        return ""
    remember_folder(Path(path))
    return path


def _ask_to_open(parent: QWidget, title: str, filters: str) -> str:
    path = QFileDialog.getOpenFileName(parent, title, str(folder()), filters)[0]
    if path:
        remember_folder(Path(path))
    return path
