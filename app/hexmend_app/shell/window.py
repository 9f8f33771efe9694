"""The window: it gives features their places, and has everything refreshed once whatever has changed."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from PySide6.QtCore import QEvent, QPoint, Qt, QTimer, Signal
from PySide6.QtGui import QAction, QCloseEvent, QKeySequence, QShortcut
from PySide6.QtWidgets import QHBoxLayout, QMainWindow, QWidget

from hexmend_app.feature import Panel, Place
from hexmend_app.shell.counts import Counts
from hexmend_app.shell.docks import Docks
from hexmend_app.shell.type_to_find import TypeToFind
from hexmend_app.state import settings
from hexmend_app.state.task import wait_for_dropped
from hexmend_app.widgets.busy import Busy
from hexmend_app.widgets.message_bar import MessageBar
from hexmend_app.widgets.opengl import make_room
from hexmend_app.widgets.overlay import Overlay

if TYPE_CHECKING:
    from hexmend_app.canvas.canvas import Canvas
    from hexmend_app.feature import Feature
    from hexmend_app.shell.menus import Menus
    from hexmend_app.state.session import Session


class Window(QMainWindow):
    """Hexmend's one window, which is every feature's host.

    It is shown before what is slow to load: `begin` builds what opens and draws a mesh, `build_canvas` the 3D view,
    `furnish` the other features with all panels and menus.

    Signals
    -------
    furnished
        All is in its place.

    Attributes
    ----------
    session : Session
    features : dict of Feature
        By the names of their folders.
    docks : Docks
        Where panels stand.
    canvas : Canvas or None
    messages : MessageBar
    busy : Busy
    """

    furnished = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.setWindowTitle("Hexmend")
        self.messages, self.busy = MessageBar(), Busy()
        self.docks = Docks()
        Overlay(self.messages, self.docks.centre, (0.5, 0.0), width=560)
        self.setCentralWidget(self.docks)
        make_room(self)
        TypeToFind(self)
        self._counts = Counts()
        corner = QWidget()
        line = QHBoxLayout(corner)
        line.setContentsMargins(4, 0, 8, 3)  # on a line with the tabs
        for part in (self.busy, self._counts):
            line.addWidget(part)
        self.docks.drawer.setCornerWidget(corner, Qt.Corner.TopRightCorner)
        self.session: Session | None = None
        self.canvas: Canvas | None = None
        self.features: dict[str, Feature] = {}
        self._menus: Menus | None = None
        self._soon = QTimer(self, singleShot=True, interval=0)
        self._soon.timeout.connect(self.refresh)
        self._first_size()

    # Building

    def begin(self) -> None:
        """Build the session, and the features that open and draw a mesh."""
        from hexmend_app.shell.features import FIRST, kind_of
        from hexmend_app.state.session import Session

        self.session = Session(self)
        self.features = {name: kind_of(name)(self) for name in FIRST}
        self.docks.add([panel for panel in self._panels() if panel.place is Place.EMPTY])
        for told in (self.session.changed, self.docks.changed, self.messages.filled, self.messages.emptied):
            told.connect(self.refresh_soon)
        self.docks.restore(settings.PANELS.get(), panels=False)
        self.refresh()

    def furnishing(self) -> Iterator[None]:
        """Build the other features step by step, and give what all offer its places in the last."""
        from hexmend_app.shell.features import found, kind_of, name_of, names
        from hexmend_app.shell.menus import Menus
        from hexmend_app.shell.own import own_actions

        for name in names():
            kind_of(name)  # what it imports takes longer than building it
            yield
        first, kinds = self.features, found()
        built = dict(first)
        for kind in kinds:
            if name_of(kind) not in built:
                try:
                    built[name_of(kind)] = kind(self)
                except Exception:  # whatever it is, the others are there
                    sys.excepthook(*sys.exc_info())
                yield
        self.features = {name_of(kind): built[name_of(kind)] for kind in kinds if name_of(kind) in built}
        panels = self._panels()
        self.docks.add([panel for panel in panels if panel.place is not Place.EMPTY])
        actions = [action for feature in self.features.values() for action in feature.actions()]
        self._menus = Menus(self, [*actions, *own_actions(self, panels)])
        if self.canvas is not None:
            for name in self.features.keys() - first.keys():
                self.features[name].canvas_ready(self.canvas)
        self.docks.restore(settings.PANELS.get(), room=False)
        self.refresh()
        self.furnished.emit()

    def furnish(self) -> None:
        """Build all features."""
        if self.session is None:
            self.begin()
        for _ in self.furnishing():
            pass

    def _panels(self) -> list[Panel]:
        return [panel for feature in self.features.values() for panel in feature.panels()]

    def build_canvas(self) -> None:
        """Load what draws in 3D, and put it in the view's place."""
        from hexmend_app.canvas.canvas import Canvas

        self.canvas = Canvas()
        self.canvas.hide()
        self.docks.view.insertWidget(0, self.canvas, 1)
        self.canvas.menu_requested.connect(self._open_menu)
        panels = QShortcut(QKeySequence(Qt.Key.Key_Tab), self.canvas.interactor, self.toggle_panels)
        panels.setContext(Qt.ShortcutContext.WidgetShortcut)
        for feature in self.features.values():
            feature.canvas_ready(self.canvas)
        self.refresh()

    # What features have of it

    @property
    def dialog_parent(self) -> QWidget:
        """The window, before which dialogs stand."""
        return self

    @property
    def window_actions(self) -> dict[str, QAction]:
        """Every action by its id."""
        return self._menus.actions

    @property
    def menus(self) -> Menus:
        """The menus with what they were made from."""
        return self._menus

    def action(self, id: str) -> QAction:
        """The action of some feature, once all are there."""
        return self._menus.actions[id]

    def show_panel(self, id: str) -> None:
        """Bring a panel to the front, and unfold what it stands in."""
        self.docks.show_panel(id)

    def offer_panel(self, id: str) -> None:
        """Bring a panel to the front of what it stands in, unfolded or not: the view keeps its room."""
        self.docks.offer_panel(id)

    def in_front(self, id: str) -> bool:
        """Whether a panel can be seen."""
        return self.docks.in_front(id)

    def toggle_panels(self) -> None:
        """Leave the window to the view, or bring all panels back."""
        self.docks.set_hidden(not self.docks.hidden)

    def may_leave(self) -> bool:
        """Whether every feature lets the open mesh go."""
        return all(feature.may_leave() for feature in self.features.values())

    @property
    def stem(self) -> str:
        """What a file that is saved is proposed to be called, without what tells its kind."""
        document = self.session.document
        return document.path.stem if document.path else "mesh"

    def said(self, failure: str, act: Callable[[], object], success: str = "") -> bool:
        """Do something and say `success`, or, under the title `failure`, why it was not done; whether it was."""
        from hexmend.errors import HexmendError

        try:
            act()
        except HexmendError as error:
            self.messages.show_error(failure, str(error))
            return False
        if success:
            self.messages.show_info(success)
        return True

    def wait_until(self, text: str, over: Callable[[], bool], leave: str = "") -> bool:
        """Wait until something is over, with `leave` on a button that does not wait; whether to go on then."""
        from hexmend_app.widgets.waiting import wait_until

        return wait_until(self, text, over, leave)

    def refresh_soon(self) -> None:
        """Have everything refreshed once, after all that happens at this moment has happened."""
        if not self._soon.isActive():
            self._soon.start()

    def refresh(self) -> None:
        """Show the session as it is now."""
        self._soon.stop()
        if self.session is None:
            return
        document = self.session.document
        for feature in self.features.values():
            try:
                feature.refresh()
            except Exception:  # whatever it is, the others are shown as they are now
                sys.excepthook(*sys.exc_info())
        if self._menus is not None:
            self._menus.refresh(document.is_open)
        # Esc is for a message first, then for what is being opened.
        self.busy.take_escape("open" if self.session.opener.busy and self.messages.isHidden() else "")
        if document.is_open:
            self._counts.refresh(self.session)
        self.setWindowTitle(f"{document.name}[*] – Hexmend" if document.is_open else "Hexmend")
        self.setWindowModified(self.session.modified)

    def _open_menu(self, hit: tuple[int, int] | None, at: QPoint) -> None:
        """Offer what can be done with what was clicked in the view."""
        if hit is not None:
            self.session.selection.choose(*hit)
        self.refresh()
        if self._menus is not None:
            self._menus.in_view().popup(at)

    # Coming and going

    def closeEvent(self, event: QCloseEvent) -> None:
        """End the threads and the 3D view before the window goes; all threads are waited for together."""
        if not self.may_leave():
            event.ignore()
            return
        settings.GEOMETRY.set(self.saveGeometry())
        if self._menus is not None:  # or there are panels that have no place yet
            settings.PANELS.set(self.docks.state())
        self.hide()  # threads may take a while to end
        for feature in self.features.values():
            feature.close()
        if self.session is not None:
            self.session.shut_down()
        if self.canvas is not None:
            self.canvas.close()
        wait_for_dropped()
        self._soon.stop()
        event.accept()

    def changeEvent(self, event: QEvent) -> None:
        """Show everything in the theme that is worn now."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            self.refresh_soon()

    def _first_size(self) -> None:
        """As large as it was, or as the screen has room for and serves."""
        room = self.screen().availableGeometry()
        self.resize(min(1600, round(room.width() * 0.94)), min(1000, round(room.height() * 0.92)))
        self.restoreGeometry(settings.GEOMETRY.get())  # nothing happens where nothing was kept
