"""Welcome page, shown while no mesh is open, and menu of recent files."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from pathlib import Path

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QMenu, QPushButton, QVBoxLayout, QWidget

from hexmend.doctor import Finding
from hexmend_app.state.mesh.document import MeasuredMesh
from hexmend_app.state.settings.settings import RecentFiles
from hexmend_app.theme.palette import MUTED
from hexmend_app.theme.spacing import clear, fill
from hexmend_app.theme.style import icon, set_help, set_variant, tint
from hexmend_app.translation import tr
from hexmend_app.widgets.wording import counted, counted_cells, figure, noun_of_cells, plural, short_folder

#: Minimum scaled Jacobian above which a mesh without invalid hexes is called sound.
_SOUND = 0.2
#: Maximum width of a file's name and folder, in average letters.
_MAX_LETTERS = 60


def entry_text(path: Path, widget: QWidget) -> str:
    """Return the name and folder of a file, elided in the middle if they are long, in the font of a widget."""
    metrics, text = widget.fontMetrics(), f"{path.name}  ({short_folder(path)})"
    width = _MAX_LETTERS * metrics.averageCharWidth()
    return metrics.elidedText(text, Qt.TextElideMode.ElideMiddle, width).replace("&", "&&")


class RecentMenu(QMenu):
    """Lists the recent files; missing files are disabled.

    Parameters
    ----------
    recent : RecentFiles

    Signals
    -------
    chosen(Path)
        The user selected this file.
    """

    chosen = Signal(object)

    def __init__(self, recent: RecentFiles, parent: QWidget | None = None):
        super().__init__(tr("Open &recent"), parent)
        self._recent = recent
        self.setToolTipsVisible(True)
        self.aboutToShow.connect(self._fill)
        # Filled only when it is shown: a change may come from one of its own actions, which must not be deleted then.
        recent.changed.connect(self._update_enabled)
        self._update_enabled()

    def _update_enabled(self) -> None:
        self.menuAction().setEnabled(bool(self._recent.files()))

    def _fill(self) -> None:
        self.clear()
        files = self._recent.files()
        for number, path in enumerate(files, start=1):
            exists = path.exists()
            name = f"&{number % 10}  {entry_text(path, self)}"
            action = self.addAction(name if exists else name + tr(": not found"))
            action.setEnabled(exists)
            action.setToolTip(str(path) if exists else tr("{path} was moved, renamed or deleted.", path=path))
            action.setStatusTip(tr("Open {path}.", path=path))
            action.triggered.connect(lambda _=False, path=path: self.chosen.emit(path))
        self.addSeparator()
        clear = self.addAction(tr("&Clear list"))
        clear.setStatusTip(tr("Clear the list of recent files."))
        clear.triggered.connect(self._recent.clear)


class Welcome(QWidget):
    """Welcome page with buttons to open a mesh and links to recent files.

    Parameters
    ----------
    recent : RecentFiles

    Signals
    -------
    recent_requested(Path)
        The user selected this file.
    """

    recent_requested = Signal(object)

    def __init__(self, recent: RecentFiles, parent: QWidget | None = None):
        super().__init__(parent)
        self._recent = recent
        self._title = QLabel(tr("Open a hexahedral mesh"))
        font = self._title.font()
        font.setPointSizeF(font.pointSizeF() * 1.8)
        self._title.setFont(font)
        self._hint = QLabel(
            tr("Drop a file here or open one: VTK, Exodus, CGNS, MED, Gmsh, Abaqus, Nastran, Medit and more.")
        )
        tint(self._hint, MUTED)
        self.open_button = QPushButton(icon("folder-open-outline"), tr("Open…"))
        self.demo_button = QPushButton(tr("Demo mesh"))
        buttons = fill(QHBoxLayout(), None, self.open_button, self.demo_button, None, spacing=None)
        self._links = fill(QVBoxLayout(), spacing=4)
        for label in (self._title, self._hint):
            label.setAlignment(Qt.AlignmentFlag.AlignCenter)
        fill(QVBoxLayout(self), None, self._title, self._hint, buttons, self._links, None, spacing=16)
        recent.changed.connect(self._show_recent)
        self._show_recent()

    def _show_recent(self) -> None:
        clear(self._links)
        for path in self._recent.files():
            if path.exists():
                link = QPushButton(entry_text(path, self))
                link.setFlat(True)
                link.setCursor(Qt.CursorShape.PointingHandCursor)
                set_help(link, tr("Open {name}", name=path.name), escape(str(path)))
                set_variant(link, "link")
                link.clicked.connect(lambda _=False, path=path: self.recent_requested.emit(path))
                self._links.addWidget(link, 0, Qt.AlignmentFlag.AlignHCenter)


def card(name: str, state: MeasuredMesh, findings: Sequence[Finding]) -> tuple[str, str]:
    """Return title and text of the card.

    Parameters
    ----------
    name : str
        Name of the file.
    state : MeasuredMesh
        The mesh as opened.
    findings : sequence of Finding
        Of the doctor, as far as they are known.
    """
    mesh, summary = state.mesh, state.summary
    hexes = counted_cells(summary)
    counts = {"inverted": figure(summary.inverted), "invalid": figure(summary.invalid)}
    title = tr("{name}: {hexes}, {inverted} inverted, {invalid} invalid", name=name, hexes=hexes, **counts)
    least = figure(summary.scaled_jacobian_min)
    sentences = [tr("{verdict} Minimum scaled Jacobian {least}.", verdict=_verdict(state), least=least)]
    if mesh.mid_nodes is not None:
        sentences.append(tr("The hexes are of second order."))
    if mesh.materials is not None:
        sentences.append(f"{counted(len(mesh.materials.names), 'material')}.")
    sentences += mesh.notes
    if findings:
        sentences.append(tr("The doctor found: {findings}", findings=" ".join(one.message for one in findings)))
    return title, " ".join(sentences)


def _verdict(state: MeasuredMesh) -> str:
    summary, noun = state.summary, noun_of_cells(state.mesh)
    if summary.inverted:
        locked = summary.locked_inverted
        if locked == summary.inverted:
            return tr(
                "Solvers reject this mesh. Fixed nodes keep all inverted hexes inverted: let the boundary slide, or "
                "unpin nodes."
            )
        locked_part = tr(" Fixed nodes lock {count} of them.", count=figure(locked)) if locked else ""
        return tr("Solvers reject inverted {cells}. Run Mend to untangle them.", cells=plural(noun)) + locked_part
    if summary.invalid:
        hexes = counted(summary.invalid, noun)
        return tr("Solvers may reject {hexes} invalid inside, between valid corners. Run Mend.", hexes=hexes)
    if summary.scaled_jacobian_min < _SOUND:
        return tr("No {cell} is invalid, but some have a low quality. Run Mend to improve them.", cell=tr(noun))
    return tr("No {cell} is invalid.", cell=tr(noun))
