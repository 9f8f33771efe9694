"""Set of the panels around the view: docks in tabs at the right and below, and lines under the view."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

from PySide6.QtCore import QByteArray, QEvent, QObject, Qt, Signal
from PySide6.QtWidgets import QMainWindow, QTabWidget, QVBoxLayout, QWidget

from hexmend_app.feature import Panel, PanelPlace
from hexmend_app.shell.panels import default_layout
from hexmend_app.shell.panels.dock import Dock
from hexmend_app.shell.panels.drawer_row import DrawerRow
from hexmend_app.shell.panels.saved_layout import SavedLayout
from hexmend_app.shell.panels.tab_bars import TabBars

#: Panels are added, and reached by Tab, in the order of these places.
_READ = (PanelPlace.EMPTY, PanelPlace.BELOW, PanelPlace.DRAWER, PanelPlace.TOOLS, PanelPlace.FACTS)

#: Minimum size of the view in pixels.
_MINIMUM_VIEW = (320, 240)

#: Default height of the drawer in pixels.
_DRAWER = 260


class DockSet(QObject):
    """The panels of a main window, and which of them are open.

    Signals
    -------
    changed
        Another set of panels is visible.

    Parameters
    ----------
    main : QMainWindow
        Its central widget and its docks are set here.

    Attributes
    ----------
    centre : QWidget
        The central widget.
    view : QVBoxLayout
        The layout of `centre`; the 3D view is inserted at its top.
    row : DrawerRow
        Tabs of the drawer while it is closed; for the status bar.
    folded : bool
        The drawer, which is all docks below the view, is closed.
    hidden : bool
        All panels are hidden.
    """

    changed = Signal()

    _tab_bars: TabBars

    def __init__(self, main: QMainWindow):
        super().__init__(main)
        self._main = main
        self._docks: dict[str, Dock] = {}  # by the id of each panel
        self._panels: dict[str, QWidget] = {}
        self._lines: dict[str, QWidget] = {}
        self._space: Dock | None = None
        self.folded, self.hidden = True, False
        self._height = _DRAWER
        self._placed = self._restoring = False
        self._saved, self._shown_lines = QByteArray(), []  # the arrangement before all panels were hidden
        self._offered: list[Dock] = []  # brought to the front once they are visible
        self.centre = QWidget()
        self.centre.setMinimumSize(*_MINIMUM_VIEW)
        self.view = QVBoxLayout(self.centre)
        self.view.setContentsMargins(0, 0, 0, 0)
        self.view.setSpacing(0)
        self.row = DrawerRow("Open a panel below the view")
        main.setCentralWidget(self.centre)
        main.setDocumentMode(True)
        main.setDockOptions(QMainWindow.DockOption.AllowTabbedDocks | QMainWindow.DockOption.AllowNestedDocks)
        for corner in (Qt.Corner.TopRightCorner, Qt.Corner.BottomRightCorner):
            main.setCorner(corner, default_layout.RIGHT)
        main.setTabPosition(Qt.DockWidgetArea.AllDockWidgetAreas, QTabWidget.TabPosition.North)
        main.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Size the docks by the window when it is first shown, and set up rows of tabs as Qt makes them."""
        if event.type() in (QEvent.Type.Resize, QEvent.Type.Show) and not self._placed and self._docks:
            self.place()
        elif event.type() == QEvent.Type.LayoutRequest:
            self._tab_bars.set_up(self._all())
        return super().eventFilter(watched, event)

    # Adding

    def reserve(self, state: dict[str, object]) -> None:
        """Keep the right column free for panels that are added later, as wide as in a saved state."""
        saved = SavedLayout.read(state)
        if saved is None or not saved.hidden:
            self._space = default_layout.reserve_column(self._main, saved.column if saved is not None else 0)

    def add(self, panels: Sequence[Panel]) -> None:
        """Add panels; those with the same tab share a dock."""
        panels = sorted(panels, key=lambda one: (_READ.index(one.place), one.order))
        for place, group in groupby(panels, key=lambda one: one.place):
            if place is PanelPlace.BELOW:
                for panel in group:
                    self._lines[panel.id] = line = _around(panel.widget)
                    self.view.addWidget(line)
            elif place is PanelPlace.EMPTY:
                for panel in group:
                    self.view.insertWidget(0, panel.widget, 1)
            else:
                for title, within in groupby(group, key=lambda one: one.tab or one.title):
                    self._add_dock(title, list(within))
        if self._docks:
            if self._space is not None:
                self._main.removeDockWidget(self._space)
                self._space.deleteLater()
                self._space = None
            self.reset()

    def _add_dock(self, title: str, panels: list[Panel]) -> None:
        from hexmend_app.shell.panels.stacked_panels import column

        first = panels[0]
        alone = len(panels) == 1 and not first.scrolls and first.place is not PanelPlace.TOOLS
        dock = Dock(first.id, title, first.help, self._main)
        dock.place = first.place
        dock.set_page(first.widget if alone else column(panels))
        dock.closed.connect(self._on_closed)
        dock.visibilityChanged.connect(self._on_visibility)
        for panel in panels:
            self._docks[panel.id] = dock
            self._panels[panel.id] = panel.widget

    # Arrangement

    def _all(self) -> list[Dock]:
        return list(dict.fromkeys(self._docks.values()))

    def _drawer(self) -> list[Dock]:
        return [one for one in self._all() if self._in_drawer(one)]

    def _in_drawer(self, dock: Dock) -> bool:
        return not dock.isFloating() and self._main.dockWidgetArea(dock) == default_layout.BOTTOM

    def reset(self) -> None:
        """Put every panel where it is by default: all open, the drawer closed."""
        self._restoring = True
        self.hidden, self.folded, self._height = False, True, _DRAWER
        self._offered.clear()
        for line in self._lines.values():
            line.show()
        default_layout.arrange(self._main, self._all())
        self._placed = self._main.isVisible()
        self._restoring = False
        self._refresh_row()

    def place(self) -> None:
        """Give the right column its default size."""
        default_layout.size(self._main, self._all())
        self._placed = self._main.isVisible()

    # Which panels there are, and which are visible

    def ids(self) -> list[str]:
        """Panels that can be shown and closed: tools, figures, drawer, lines."""
        docks = [id for place in default_layout.PLACES for id, dock in self._docks.items() if dock.place is place]
        return [*docks, *self._lines]

    def is_open(self, id: str) -> bool:
        """Return True unless the user has closed a panel."""
        return not self._lines[id].isHidden() if id in self._lines else self._docks[id].is_open

    def in_front(self, id: str) -> bool:
        """Return True if a panel is visible."""
        return self._lines[id].isVisible() if id in self._lines else self._docks[id].in_front

    def _on_closed(self) -> None:
        self._refresh_row()
        self.changed.emit()

    def _on_visibility(self) -> None:
        if not self._restoring:
            self.changed.emit()

    def _refresh_row(self) -> None:
        listed = [dock for dock in self._drawer() if dock.is_open] if self.folded or self.hidden else []
        self.row.set_panels([(dock.objectName(), dock.windowTitle(), dock.toolTip()) for dock in listed])


def _around(widget: QWidget) -> QWidget:
    """A widget around another: the feature shows and hides the inner one, the user the outer one."""
    around = QWidget()
    layout = QVBoxLayout(around)
    layout.setContentsMargins(0, 0, 0, 0)
    layout.addWidget(widget)
    return around
