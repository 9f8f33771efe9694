"""Main window: builds the features, and refreshes them once per turn of the event loop."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QEvent, QPoint, Qt, QTimer, Signal
from PySide6.QtGui import QAction, QCloseEvent, QKeyEvent, QKeySequence, QShortcut
from PySide6.QtWidgets import QAbstractSpinBox, QApplication, QLineEdit, QMainWindow, QWidget

from hexmend_app.feature import Panel, PanelPlace
from hexmend_app.shell.features import FIRST, build_remaining, call_each, declared, feature_class
from hexmend_app.shell.panels.docks import Docks
from hexmend_app.shell.panels.hex_counts import HexCounts
from hexmend_app.state.settings import settings
from hexmend_app.state.tasks.task import wait_for_dropped
from hexmend_app.translation import tr
from hexmend_app.widgets.busy import Busy
from hexmend_app.widgets.message_bar import MessageBar
from hexmend_app.widgets.opengl import reserve_opengl

if TYPE_CHECKING:
    from hexmend_app.canvas.canvas import Canvas
    from hexmend_app.feature import Feature
    from hexmend_app.shell.menus import Menus
    from hexmend_app.state.session.session import Session

#: Milliseconds within which the panels show an iteration.
_DELAY = 200


class Window(QMainWindow):
    """Main window and host of all features.

    It is shown before the slow imports. Then `begin` builds the features that open and draw a mesh, `build_canvas` the
    3D view, and `build_features` the other features with all panels and menus.

    Signals
    -------
    ready
        All features are built.

    Attributes
    ----------
    session : Session
        None until `begin`.
    features : dict of Feature
        By name.
    docks : Docks
        Panels around the view.
    canvas : Canvas or None
    messages : MessageBar
    busy : Busy
    """

    ready = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.setWindowTitle(tr("Hexmend"))
        self.messages, self.busy = MessageBar(), Busy()
        self.docks = Docks(self)
        self.docks.view.addWidget(self.messages)
        reserve_opengl(self)
        self._counts = HexCounts()
        self.statusBar().setSizeGripEnabled(False)
        self.statusBar().addPermanentWidget(self.docks.buttons, 1)  # messages do not hide permanent widgets
        self.statusBar().addPermanentWidget(self.busy)
        self.statusBar().addPermanentWidget(self._counts)
        self.session: Session | None = None
        self.canvas: Canvas | None = None
        self.features: dict[str, Feature] = {}
        self.menus: Menus | None = None
        self._timer = QTimer(self, singleShot=True)  # combines changes
        self._timer.timeout.connect(self.refresh)
        screen = self.screen().availableGeometry()
        self.resize(min(1600, round(screen.width() * 0.94)), min(1000, round(screen.height() * 0.92)))
        self.restoreGeometry(settings.GEOMETRY.get())  # no effect without a saved geometry
        QApplication.instance().focusChanged.connect(self._on_focus_changed)  # type: ignore[attr-defined]

    # Building

    def begin(self) -> None:
        """Build the session and the features that open and draw a mesh."""
        from hexmend_app.state.session.session import Session

        self.session = Session(self)
        self.features = {name: feature_class(name)(self) for name in FIRST}
        self._add_states(self.features.values())
        self.docks.add([panel for panel in self._panels() if panel.place is PanelPlace.EMPTY])
        for signal in (self.docks.changed, self.messages.changed):
            signal.connect(self.refresh_soon)
        self.session.changed.connect(self._on_changed)
        self.docks.reserve(settings.PANELS.get())
        self.refresh()

    def build_steps(self) -> Iterator[None]:
        """Build the other features step by step; in the last step, add all panels and menus."""
        from hexmend_app.shell.menus import Menus
        from hexmend_app.shell.window_actions import declare_actions
        from hexmend_app.widgets.action_button import ActionButton

        first = self.features
        self.features = yield from build_remaining(self, first)
        added = [feature for name, feature in self.features.items() if name not in first]
        self._add_states(added)
        panels = self._panels()
        self.docks.add([panel for panel in panels if panel.place is not PanelPlace.EMPTY])
        actions = declared(self.features.values(), lambda feature: feature.actions())
        self.menus = Menus(self, [*actions, *declare_actions(self, panels)])
        for action in self.menus.actions.values():
            action.triggered.connect(self.messages.leave_card)
        for button in self.findChildren(ActionButton):
            button.show_action(self.menus.actions[button.action_id])
        if self.canvas is not None:
            for feature in added:
                feature.canvas_ready()
        self.docks.restore(settings.PANELS.get())
        self.refresh()
        self.ready.emit()

    def build_features(self) -> None:
        """Build all features."""
        if self.session is None:
            self.begin()
        for _ in self.build_steps():
            pass

    def _add_states(self, features: Iterable[Feature]) -> None:
        for part in declared(features, lambda feature: feature.states()):
            self.session.feature_states.add(part)

    def _panels(self) -> list[Panel]:
        return declared(self.features.values(), lambda feature: feature.panels())

    def build_canvas(self) -> None:
        """Build the 3D view."""
        from hexmend_app.canvas.canvas import Canvas

        self.canvas = Canvas()
        self.canvas.hide()
        self.docks.view.insertWidget(self.docks.view.indexOf(self.messages) + 1, self.canvas, 1)
        self.canvas.menu_requested.connect(self._open_menu)
        self.canvas.clicked.connect(self.messages.leave_card)
        panels = QShortcut(QKeySequence(Qt.Key.Key_Tab), self.canvas.interactor, self.toggle_panels)
        panels.setContext(Qt.ShortcutContext.WidgetShortcut)
        for feature in self.features.values():
            feature.canvas_ready()
        self.refresh()

    # Host of features

    @property
    def dialog_parent(self) -> QWidget:
        """Parent of dialogs: this window."""
        return self

    @property
    def window_actions(self) -> dict[str, QAction]:
        """All actions by id."""
        return self.menus.actions

    def action(self, id: str) -> QAction:
        """Return the action of any feature; available once all features are built."""
        return self.menus.actions[id]

    def show_panel(self, id: str) -> None:
        """Open a panel in front of its tabs."""
        self.docks.show_panel(id)

    def raise_if_open(self, id: str) -> None:
        """Put an open panel in front of its tabs; closed and hidden panels stay closed."""
        self.docks.raise_if_open(id)

    def is_visible(self, id: str) -> bool:
        """Return True if a panel is visible."""
        return self.docks.is_visible(id)

    def toggle_panels(self) -> None:
        """Hide all panels, or show them again."""
        self.docks.set_hidden(not self.docks.hidden)

    def confirm_close(self) -> bool:
        """Return True if no feature objects to closing the mesh."""
        return all(feature.confirm_close() for feature in self.features.values())

    @property
    def default_file_stem(self) -> str:
        """Default name of files to save, without suffix."""
        document = self.session.document
        return Path(document.name).stem if document.path else "mesh"

    def wait_until(self, text: str, over: Callable[[], bool], leave: str = "") -> bool:
        """Wait until `over()` is true.

        Return True when it is over or the user pressed `leave`; False if the user cancelled.
        """
        from hexmend_app.widgets.dialogs.questions import wait_until

        return wait_until(self, text, over, leave)

    def refresh_soon(self) -> None:
        """Request a refresh of everything, once, in the next turn of the event loop."""
        self._timer.start(0)

    def _on_changed(self) -> None:
        """Request a refresh: after an iteration, which is drawn already, a little later than after other changes."""
        if not self.session.run.iterating:
            self.refresh_soon()
        elif not self._timer.isActive():
            self._timer.start(_DELAY)

    def refresh(self) -> None:
        """Show the current state of the session."""
        self._timer.stop()
        if self.session is None:
            return
        call_each(self.features.values(), lambda feature: feature.refresh())
        if self.menus is not None:
            self.menus.refresh(self.session.document.is_open)
        # Esc dismisses messages first, then cancels opening.
        self.busy.take_escape("open" if self.session.opener.busy and not self.messages.takes_escape else "")
        document = self.session.document
        if document.is_open:
            self._counts.refresh(self.session)
        self.setWindowTitle(tr("{name}[*] – Hexmend", name=document.name) if document.is_open else tr("Hexmend"))
        self.setWindowModified(self.session.modified)
        # Four layouts are around a label, each of which asks the next one: all is painted once, afterwards.
        for _ in range(4):
            QApplication.sendPostedEvents(None, QEvent.Type.LayoutRequest.value)

    def _open_menu(self, hit: tuple[int, int] | None, at: QPoint) -> None:
        """Open the context menu of the view."""
        if hit is not None:
            self.session.selection.choose(*hit)
        self.refresh()
        if self.menus is not None:
            self.menus.context_menu().popup(at)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Move the focus to the view after Return in a field, which has acted on it and passed it on."""
        fields = (QLineEdit, QAbstractSpinBox)
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter) and isinstance(QApplication.focusWidget(), fields):
            if self.canvas is not None:
                self.canvas.interactor.setFocus(Qt.FocusReason.OtherFocusReason)
        else:
            super().keyPressEvent(event)

    def _on_focus_changed(self, before: QWidget | None, now: QWidget | None) -> None:
        """Scroll a panel to a widget that receives the focus by a key."""
        if now is not None and self.menus is not None and not QApplication.mouseButtons():
            from hexmend_app.shell.panels.stacked_panels import scroll_to

            scroll_to(now)

    # Closing

    def closeEvent(self, event: QCloseEvent) -> None:
        """Save the layout, close the features and the 3D view, and wait for all threads."""
        if not self.confirm_close():
            event.ignore()
            return
        QApplication.instance().focusChanged.disconnect(self._on_focus_changed)  # type: ignore[attr-defined]
        settings.GEOMETRY.set(self.saveGeometry())
        if self.menus is not None:  # otherwise the panels have not been added yet
            settings.PANELS.set(self.docks.state())
        self.docks.set_hidden(True)  # floating panels are windows of their own
        self.hide()  # threads may take a while to end
        for feature in self.features.values():
            feature.close()
        if self.session is not None:
            self.session.close()
        if self.canvas is not None:
            self.canvas.close()
        wait_for_dropped()
        self._timer.stop()
        event.accept()

    def changeEvent(self, event: QEvent) -> None:
        """Request a refresh after a change of theme."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            self.refresh_soon()
