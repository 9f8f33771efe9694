"""The window: state below, widgets around, and the lines between them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QPoint, QSettings, Qt, QTimer
from PySide6.QtGui import QCloseEvent, QDragEnterEvent, QDropEvent
from PySide6.QtWidgets import (
    QDockWidget,
    QLabel,
    QMainWindow,
    QProgressBar,
    QScrollArea,
    QStyle,
    QVBoxLayout,
    QWidget,
)

from hexmend.errors import FileError, HexmendError
from hexmend.parameters import declared
from hexmend.quality import element, node
from hexmend.report.documents import write_text
from hexmend.run import Stop
from hexmend.smoothers import DEFAULT_METHOD
from hexmend_app.actions import ACTIONS
from hexmend_app.commands import Commands, methods_offered
from hexmend_app.menus import build_menus
from hexmend_app.resources import demo_mesh
from hexmend_app.state.document import Document
from hexmend_app.state.opener import Opener
from hexmend_app.state.run import Frame, Phase, Smoothing
from hexmend_app.state.selection import Selection
from hexmend_app.state.view import View
from hexmend_app.widgets.clip_panel import ClipPanel
from hexmend_app.widgets.colour_panel import ColourPanel
from hexmend_app.widgets.command_palette import CommandPalette
from hexmend_app.widgets.element_panel import ElementPanel
from hexmend_app.widgets.histogram import QualityHistogram, write_histogram
from hexmend_app.widgets.inside_panel import InsidePanel
from hexmend_app.widgets.message_bar import MessageBar
from hexmend_app.widgets.picture_dialog import PictureDialog
from hexmend_app.widgets.questions import (
    Answer,
    ask_histogram,
    ask_list,
    ask_mesh,
    ask_target,
    ask_unsaved,
    remember_folder,
    show_about,
)
from hexmend_app.widgets.smoothing_panel import SmoothingPanel
from hexmend_app.widgets.statistics import StatisticsTable
from hexmend_app.widgets.welcome import Welcome
from hexmend_app.widgets.wording import counted
from hexmend_app.widgets.worst_list import WorstList

if TYPE_CHECKING:
    from hexmend.optimise import Result
    from hexmend_app.widgets.canvas import Canvas


#: Number of the layout: one that was saved with other docks is not restored.
_LAYOUT = 2


class Window(QMainWindow):
    """Hexmend's one window.

    It is shown before what is slow to load: `build_canvas` adds the 3D view afterwards.
    """

    def __init__(self) -> None:
        super().__init__()
        self.setWindowTitle("Hexmend")
        self.setAcceptDrops(True)
        self.document = Document(self)
        self.view = View(self)
        self.selection = Selection(self)
        self.smoothing = Smoothing(self.document, self)
        self.opener = Opener(self.document, self)
        self.commands = Commands(self.document, self.view, self.smoothing, self.opener)
        self.canvas: Canvas | None = None

        self.messages = MessageBar()
        self.welcome = Welcome()
        self.histogram = QualityHistogram()
        self.statistics = StatisticsTable()
        self.worst_list = WorstList()
        self.element_panel = ElementPanel()
        self.smoothing_panel = SmoothingPanel(declared(Stop))
        self.smoothing_panel.set_methods(methods_offered())
        self.smoothing_panel.set_method(DEFAULT_METHOD)
        self.clip_panel = ClipPanel()
        self.inside_panel = InsidePanel()
        self.colour_panel = ColourPanel()
        self.progress = QProgressBar()
        self.progress.setRange(0, 0)
        self.progress.setFixedSize(140, 10)  # no higher than text, or the view jumps as it comes and goes
        self.progress.setTextVisible(False)
        self.counts = QLabel()

        self._lay_out()
        self.actions_by_id = build_menus(self, lambda id: getattr(self, f"_on_{id}"))
        self.actions_by_id["edges"].setChecked(self.view.look.edges)
        self.smoothing_panel.set_shortcuts(
            {id: self.actions_by_id[id].shortcut().toString() for id in ("run", "step", "stop", "reset")}
        )
        self._connect()
        self._restore()
        self._enable()

    # Layout

    def _lay_out(self) -> None:
        self._centre = QVBoxLayout()
        self._centre.setContentsMargins(0, 0, 0, 0)
        self._centre.setSpacing(0)
        self._centre.addWidget(self.messages)
        self._centre.addWidget(self.welcome, 1)
        centre = QWidget()
        centre.setLayout(self._centre)
        self.setCentralWidget(centre)
        self.setDockNestingEnabled(True)
        self.setCorner(Qt.Corner.BottomRightCorner, Qt.DockWidgetArea.RightDockWidgetArea)

        tools = QWidget()
        column = QVBoxLayout(tools)
        column.setContentsMargins(8, 6, 8, 6)
        column.setSpacing(8)
        for part in (self.smoothing_panel, self.colour_panel, self.clip_panel, self.inside_panel):
            column.addWidget(part)
        column.addStretch()
        scroll = QScrollArea()
        scroll.setWidget(tools)
        scroll.setWidgetResizable(True)
        scroll.setFrameShape(QScrollArea.Shape.NoFrame)
        scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        bar = self.style().pixelMetric(QStyle.PixelMetric.PM_ScrollBarExtent)
        scroll.setMinimumWidth(tools.minimumSizeHint().width() + bar)
        areas = Qt.DockWidgetArea
        self._dock("tools", "Smooth, cut and colour", scroll, areas.RightDockWidgetArea)
        histogram = self._dock("histogram", "Distribution of quality", self.histogram, areas.BottomDockWidgetArea)
        quality = self._dock("quality", "Quality", self.statistics, areas.BottomDockWidgetArea)
        self.splitDockWidget(histogram, quality, Qt.Orientation.Horizontal)
        self.worst_dock = self._dock("worst", "Worst elements", self.worst_list, areas.BottomDockWidgetArea)
        self.element_dock = self._dock("element", "Element", self.element_panel, areas.BottomDockWidgetArea)
        self.tabifyDockWidget(quality, self.worst_dock)
        self.tabifyDockWidget(self.worst_dock, self.element_dock)
        quality.raise_()
        self.resizeDocks([histogram, quality], [620, 360], Qt.Orientation.Horizontal)
        self.resizeDocks([histogram], [270], Qt.Orientation.Vertical)

        self.statusBar().addWidget(self.counts, 1)
        self.statusBar().addPermanentWidget(self.progress)
        self.progress.hide()

    def _dock(self, name: str, title: str, widget: QWidget, area: Qt.DockWidgetArea) -> QDockWidget:
        dock = QDockWidget(title)
        dock.setObjectName(name)
        dock.setWidget(widget)
        dock.setFeatures(
            QDockWidget.DockWidgetFeature.DockWidgetMovable | QDockWidget.DockWidgetFeature.DockWidgetFloatable
        )
        self.addDockWidget(area, dock)
        return dock

    def build_canvas(self) -> None:
        """Load what draws in 3D and put it where the welcome is; slow the first time."""
        from hexmend_app.widgets.canvas import Canvas

        self.canvas = Canvas()
        self._centre.addWidget(self.canvas, 1)
        self.canvas.clip_dragged.connect(self.view.set_clip)
        self.canvas.clicked.connect(self._on_clicked)
        self.canvas.dug.connect(self._on_dug)
        self.canvas.setVisible(self.document.is_open)
        self.canvas.set_look(self.view.look, self.view.plane_shown)
        if self.document.is_open:
            self._on_mesh_replaced()

    # Connections

    def _connect(self) -> None:
        self.document.mesh_replaced.connect(self._on_mesh_replaced)
        self.document.points_moved.connect(self._on_points_moved)
        self.document.changes_changed.connect(self._enable)
        self.view.look_changed.connect(self._on_look_changed)
        self.view.look_changed.connect(self._enable)
        self.opener.began.connect(self._on_opening)
        self.opener.ended.connect(self._on_opened)
        self.opener.failed.connect(self._on_open_failed)
        self.smoothing.phase_changed.connect(self._on_phase)
        self.smoothing.iterated.connect(self._on_iterated)
        self.smoothing.ended.connect(self._on_ended)
        self.smoothing.failed.connect(self._on_failed)
        self.histogram.save_requested.connect(self._on_save_histogram)
        self.histogram.range_changed.connect(lambda chosen: self.view.change(quality_range=chosen))
        self.clip_panel.clip_changed.connect(self.view.set_clip)
        self.colour_panel.scale_changed.connect(lambda scale: self.view.change(scale=scale))
        self.clip_panel.plane_shown_changed.connect(self.view.set_plane_shown)
        self.inside_panel.peel_changed.connect(lambda layers: self.view.change(peel=layers))
        self.inside_panel.shrink_changed.connect(lambda share: self.view.change(shrink=share))
        self.inside_panel.outline_changed.connect(lambda on: self.view.change(outline=on))
        self.inside_panel.rings_changed.connect(self.view.set_rings)
        self.inside_panel.all_requested.connect(self.view.end_isolation)
        self.inside_panel.undo_requested.connect(self.view.undig_last)
        self.inside_panel.put_back_requested.connect(self.view.undig_all)
        self.smoothing_panel.run_requested.connect(self.commands.run)
        self.smoothing_panel.step_requested.connect(self.commands.step)
        self.smoothing_panel.pause_requested.connect(self.smoothing.pause)
        self.smoothing_panel.resume_requested.connect(self.smoothing.resume)
        self.smoothing_panel.stop_requested.connect(self.smoothing.stop)
        self.smoothing_panel.reset_requested.connect(self.commands.reset)
        self.selection.changed.connect(self._show_selected)
        self.selection.changed.connect(self._enable)
        self.messages.filled.connect(self._enable)
        self.messages.emptied.connect(self._enable)
        self.worst_list.chosen.connect(self._go_to_worst)
        self.worst_list.save_requested.connect(self._on_save_worst)
        self.element_panel.chosen.connect(self._go_to)
        self.element_panel.fly_requested.connect(lambda: self._go_to(self.selection.hex))
        self.element_panel.corners_toggled.connect(self._show_selected)
        self.element_panel.node_chosen.connect(lambda node: self.selection.choose(self.selection.hex, node))
        self.element_panel.pin_toggled.connect(self.commands.pin)
        self.welcome.open_requested.connect(self._on_open)
        self.welcome.demo_requested.connect(self._on_open_demo)

    # What the state tells

    def _on_mesh_replaced(self) -> None:
        start, now = self.document.start, self.document.now
        self.welcome.setVisible(self.canvas is None)
        self.view.show_another()
        self.inside_panel.set_layers(int(now.mesh.topology.layers.max()))
        self.selection.choose(None)
        low, high = now.mesh.points.min(axis=0), now.mesh.points.max(axis=0)
        self.clip_panel.set_bounds(tuple(float(c) for pair in zip(low, high, strict=True) for c in pair))
        self.histogram.set_initial(start.figures.q, start.figures.inverted)
        self.smoothing_panel.set_state("idle")
        self.smoothing_panel.set_status()
        if self.canvas is not None:
            self.canvas.show()
            self.canvas.set_mesh(now.mesh, now.figures)
        self._show_range()
        self._show_figures()

    def _on_points_moved(self) -> None:
        if self.canvas is not None:
            now, live = self.document.now, self.smoothing.phase is Phase.RUNNING
            self.canvas.set_points(now.mesh.points, now.figures, live)
        self._show_range()
        self._show_figures()

    def _show_figures(self) -> None:
        start, now = self.document.start, self.document.now
        self.histogram.set_current(now.figures.q, now.figures.inverted)
        self.statistics.set_summaries(start.summary, now.summary)
        self.worst_list.set_figures(now.mesh, now.figures)
        self._show_element()
        inverted = f"{now.summary.inverted:,} inverted" if now.summary.inverted else "none inverted"
        self.counts.setText(f"{now.summary.hexes:,} hexes, {inverted}")
        self._show_shown()

    def _show_shown(self) -> None:
        if self.canvas is not None and self.document.is_open:
            self.inside_panel.set_shown(self.canvas.viewport.shown, self.document.now.mesh.n_hexes)

    def _show_selected(self) -> None:
        self.worst_list.set_selected(self.selection.hex)
        self._show_element()

    def _show_element(self) -> None:
        """Show what is looked at as it is now."""
        chosen, mesh = self.selection, self.document.now.mesh
        self.element_panel.show_element(None if chosen.hex is None else element(mesh, chosen.hex))
        at = None if chosen.node is None else node(mesh, chosen.node)
        self.element_panel.show_node(at, self.smoothing.busy)
        if self.canvas is not None:
            self.canvas.select(chosen.hex, self.element_panel.corners_in_view, at)

    def _show_range(self) -> None:
        if self.canvas is not None and self.canvas.colouring is not None:
            self.colour_panel.set_ends(self.canvas.colouring.low, self.canvas.colouring.high)

    def _on_look_changed(self) -> None:
        look = self.view.look
        self.colour_panel.set_scale(look.scale)
        self.clip_panel.set_clip(look.clip)
        self.clip_panel.set_plane_shown(self.view.plane_shown)
        self.inside_panel.set_look(look, self.view.rings)
        self.histogram.set_range(look.quality_range)
        for id, on in (("edges", look.edges), ("clip", look.clip is not None)):
            self.actions_by_id[id].setChecked(on)
        if self.canvas is not None:
            self.canvas.set_look(look, self.view.plane_shown)
            self._show_range()
        self._show_shown()

    def _on_opening(self, path: Path) -> None:
        self.progress.show()
        self.statusBar().showMessage(f"Reading {path.name}…")

    def _on_opened(self, path: Path) -> None:
        self.progress.hide()
        self.statusBar().clearMessage()
        self.messages.clear()
        if path.resolve() != demo_mesh().resolve():
            remember_folder(path)

    def _on_open_failed(self, path: Path, error: Exception) -> None:
        self.progress.hide()
        self.statusBar().clearMessage()
        detail = f"{error.problem}. {error.remedy}" if isinstance(error, FileError) else str(error)
        stays = f" {self.document.name} stays open." if self.document.is_open else ""
        self.messages.show_error(f"{path.name} cannot be opened", f"{detail.strip()}{stays}")

    def _on_phase(self) -> None:
        phase = self.smoothing.phase
        self.smoothing_panel.set_state(phase.value)
        self.progress.setVisible(phase is Phase.PREPARING)  # its animation would slow a run that shows itself anyway
        if phase is Phase.PAUSED and self.canvas is not None:
            self.canvas.rest()
        if phase is Phase.PREPARING:
            self.smoothing_panel.set_status(
                sentence="Preparing the method. Its kernels are compiled the first time, which takes about a minute."
            )
        self._enable()

    def _on_iterated(self, frame: Frame) -> None:
        self.smoothing_panel.set_status(frame.iteration.number, frame.iteration.seconds)

    def _on_ended(self, result: Result) -> None:
        self.smoothing_panel.set_status(result.iterations, result.seconds, result.message)

    def _on_failed(self, error: Exception) -> None:
        self.smoothing_panel.set_status()
        self.messages.show_error("The method failed", f"{error}. The mesh is as it was before the run.")

    def _enable(self) -> None:
        busy, phase = self.smoothing.busy, self.smoothing.phase
        for spec in ACTIONS:
            self.actions_by_id[spec.id].setEnabled(self.document.is_open or not spec.needs_mesh)
        undo, redo = (self.document.undo_title, self.document.redo_title) if self.document.is_open else (None, None)
        for id, title, word in (("undo", undo, "&Undo"), ("redo", redo, "&Redo")):
            self.actions_by_id[id].setEnabled(title is not None and not busy)
            self.actions_by_id[id].setText(f"{word} {title}" if title else word)
            self.actions_by_id[id].setIconText(word.replace("&", ""))
        self.actions_by_id["stop"].setEnabled(busy)
        chosen, look = self.selection.hex is not None, self.view.look
        self.actions_by_id["isolate"].setEnabled(chosen)
        self.actions_by_id["dig"].setEnabled(chosen)
        self.actions_by_id["undig"].setEnabled(bool(look.dug))
        # Esc dismisses a message first.
        self.actions_by_id["back"].setEnabled((chosen or look.isolation is not None) and self.messages.isHidden())
        self.actions_by_id["save"].setEnabled(self.document.is_open and phase is not Phase.RUNNING)
        self.smoothing_panel.setEnabled(self.document.is_open)
        self.clip_panel.setEnabled(self.document.is_open)
        self.inside_panel.setEnabled(self.document.is_open)
        self.colour_panel.setEnabled(self.document.is_open)
        self.histogram.setEnabled(self.document.is_open)
        self.setWindowTitle(f"{self.document.name}[*] – Hexmend" if self.document.is_open else "Hexmend")
        self.setWindowModified(self.document.modified)

    # What the user asks for

    def open(self, path: str | Path) -> None:
        """Open a mesh, after what is unsaved was kept or given up."""
        if self._may_leave():
            self.smoothing.end_now()
            self.commands.open(path)

    def _on_open(self) -> None:
        path = ask_mesh(self)
        if path:
            self.open(path)

    def _on_open_demo(self) -> None:
        self.open(demo_mesh())

    def _on_save(self) -> bool:
        path = ask_target(self, self.document.path.stem if self.document.path else "mesh")
        return bool(path) and self.save(path)

    def save(self, path: str | Path) -> bool:
        """Write the mesh; say so, or say why not."""
        try:
            self.commands.save(path)
        except HexmendError as error:
            self.messages.show_error("The mesh was not saved", str(error))
            return False
        self.messages.show_info(f"Saved to {path}")
        return True

    def _on_screenshot(self) -> None:
        dialog = PictureDialog(self.canvas.size() * self.devicePixelRatioF(), f"{self.document.path.stem}.png", self)
        if dialog.exec():
            self.save_picture(dialog.path(), dialog.picture_size(), dialog.transparent())

    def save_picture(self, path: str | Path, size: tuple[int, int], transparent: bool = False) -> bool:
        """Write the view as PNG of `size` pixels; say so, or say why not."""
        try:
            self.canvas.save_picture(Path(path), size, transparent)
        except HexmendError as error:
            self.messages.show_error("The picture was not saved", str(error))
            return False
        self.messages.show_info(f"Picture of {size[0]} × {size[1]} pixels saved to {path}")
        return True

    def _on_clicked(self, hit: tuple[int, int] | None) -> None:
        self.selection.choose(*(hit or (None, None)))
        if hit is not None:
            self.element_dock.raise_()

    def _go_to(self, h: int) -> None:
        """Choose an element and bring it before the camera."""
        self.selection.choose(h)
        if self.canvas is not None:
            self.canvas.fly_to(h)

    def _go_to_worst(self, h: int) -> None:
        if self.worst_list.isolates:
            self.view.isolate((h,))
        self._go_to(h)

    def _on_dug(self, h: int) -> None:
        if h == self.selection.hex:
            self.selection.choose(None)
        self.view.dig(h)

    def _on_isolate(self) -> None:
        self.view.isolate((self.selection.hex,))

    def _on_dig(self) -> None:
        self._on_dug(self.selection.hex)

    def _on_undig(self) -> None:
        self.view.undig_last()

    def _on_next_worst(self) -> None:
        self.worst_list.next()

    def _on_previous_worst(self) -> None:
        self.worst_list.previous()

    def _on_back(self) -> None:
        """First show the rest again, then look at none."""
        if self.view.look.isolation is not None:
            self.view.end_isolation()
        else:
            self.selection.choose(None)

    def _on_save_worst(self) -> None:
        path = ask_list(self, self.document.path.stem if self.document.path else "mesh")
        if path:
            self.save_worst(path)

    def save_worst(self, path: str | Path) -> bool:
        """Write the list of the worst elements as CSV; say so, or say why not."""
        saved = self._said("The list was not saved", lambda: write_text(Path(path), self.worst_list.text()))
        if saved:
            self.messages.show_info(f"{counted(len(self.worst_list.elements), 'element')} saved to {path}")
        return saved

    def _on_save_histogram(self) -> None:
        path = ask_histogram(self, self.document.path.stem if self.document.path else "mesh")
        if path:
            self.save_histogram(path)

    def save_histogram(self, path: str | Path) -> bool:
        """Write the histogram as figure, or its counts as CSV, by the suffix; say so, or say why not."""
        name = self.document.name
        saved = self._said("The histogram was not saved", lambda: write_histogram(Path(path), self.histogram, name))
        if saved:
            self.messages.show_info(f"Histogram saved to {path}")
        return saved

    def _said(self, title: str, act: Callable[[], object]) -> bool:
        """Do something; what goes wrong is said under this title."""
        try:
            act()
        except HexmendError as error:
            self.messages.show_error(title, str(error))
            return False
        return True

    def _on_quit(self) -> None:
        self.close()

    def _on_undo(self) -> None:
        self.commands.undo()

    def _on_redo(self) -> None:
        self.commands.redo()

    def _on_run(self) -> None:
        self.smoothing_panel.run_or_pause()

    def _on_step(self) -> None:
        self.smoothing_panel.step()

    def _on_stop(self) -> None:
        self.smoothing.stop()

    def _on_reset(self) -> None:
        self.commands.reset()

    def _on_fit(self) -> None:
        self.canvas.fit()

    def _look_along(self, direction: str) -> None:
        self.canvas.look_along(direction)

    def _on_view_iso(self) -> None:
        self._look_along("iso")

    def _on_view_x(self) -> None:
        self._look_along("+x")

    def _on_view_y(self) -> None:
        self._look_along("+y")

    def _on_view_z(self) -> None:
        self._look_along("+z")

    def _on_parallel(self, on: bool) -> None:
        self.canvas.set_parallel(on)

    def _on_edges(self, on: bool) -> None:
        self.view.change(edges=on)

    def _on_clip(self, on: bool) -> None:
        if on != (self.view.look.clip is not None):
            self.view.set_clip(self.clip_panel.plane() if on else None)

    def _on_commands(self) -> None:
        others = [action for id, action in self.actions_by_id.items() if id != "commands"]
        palette = CommandPalette(others, self)
        palette.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        palette.move(self.mapToGlobal(QPoint((self.width() - palette.width()) // 2, 90)))
        palette.open()

    def _on_about(self) -> None:
        from hexmend import __version__

        show_about(self, __version__)

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        """Take one file that is dragged in."""
        if _dropped(event):
            event.acceptProposedAction()

    def dropEvent(self, event: QDropEvent) -> None:
        """Open the file that is dropped."""
        path = _dropped(event)
        if path:
            event.acceptProposedAction()
            QTimer.singleShot(0, lambda: self.open(path))

    # Coming and going

    def _may_leave(self) -> bool:
        """Whether what is unsaved was saved or may be lost."""
        if not self.document.modified and not self.smoothing.busy:
            return True
        answer = ask_unsaved(self, self.document.name)
        if answer is Answer.SAVE:
            self.smoothing.end_now()
            return self._on_save()
        return answer is Answer.DISCARD

    def closeEvent(self, event: QCloseEvent) -> None:
        """End the threads and the 3D view before the window goes."""
        if not self._may_leave():
            event.ignore()
            return
        self.smoothing.shut_down()
        self.opener.shut_down()
        settings = QSettings()
        settings.setValue("geometry", self.saveGeometry())
        settings.setValue("layout", self.saveState(_LAYOUT))
        if self.canvas is not None:
            self.canvas.close()
        event.accept()

    def _restore(self) -> None:
        settings = QSettings()
        self.resize(1440, 900)
        if settings.contains("geometry"):
            self.restoreGeometry(settings.value("geometry"))
        if settings.contains("layout"):
            self.restoreState(settings.value("layout"), _LAYOUT)


def _dropped(event: QDropEvent) -> str:
    """The one local file of a drag, or ""."""
    urls = event.mimeData().urls()
    return urls[0].toLocalFile() if len(urls) == 1 else ""
