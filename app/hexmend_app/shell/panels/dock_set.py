"""Set of the panels around the view: tabbed docks on the right and below, and bars in the bottom row."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import groupby

from PySide6.QtCore import QByteArray, QEvent, QObject, Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QMainWindow, QTabWidget, QVBoxLayout, QWidget

from hexmend_app.feature import Panel, PanelGroup, PanelPlace
from hexmend_app.shell.panels import default_layout
from hexmend_app.shell.panels.dock import Dock
from hexmend_app.shell.panels.group_row import GroupRow
from hexmend_app.shell.panels.tab_bars import TabBars
from hexmend_app.theme.spacing import fill
from hexmend_app.translation import tr

#: Order of places in which panels are added and reached by Tab.
_TAB_ORDER = (PanelPlace.EMPTY, PanelPlace.BELOW, PanelPlace.DRAWER, PanelPlace.TOOLS, PanelPlace.FACTS)

#: Minimum size of the view in pixels.
_MINIMUM_VIEW = (320, 240)

#: Default height of the drawer in pixels.
_DRAWER = 260


class DockSet(QObject):
    """Panels of a main window and their state: open, closed or hidden.

    Signals
    -------
    changed
        The set of visible panels has changed.

    Parameters
    ----------
    main : QMainWindow
        Its central widget and docks are set here.

    Attributes
    ----------
    centre : QWidget
        The central widget.
    view : QVBoxLayout
        The layout of `centre`; the 3D view is inserted at its top.
    bars : QWidget
        Bars of panels, for the bottom row of the window.
    row : GroupRow
        Buttons of the groups, for the bottom row of the window.
    folded : bool
        The drawer (all docks below the view) is closed.
    group : PanelGroup
        The drawer contains the docks of this group.
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
        self._bars: dict[str, QWidget] = {}
        self._placeholder: Dock | None = None
        self.folded, self.hidden, self.group = True, False, PanelGroup.FIND
        self._drawer_height = _DRAWER
        self._placed = self._restoring = False
        # The arrangement before all panels were hidden.
        self._saved, self._shown_bars = QByteArray(), list[str]()
        self._offered: list[Dock] = []  # raised once they are visible
        self.centre = QWidget()
        self.centre.setMinimumSize(*_MINIMUM_VIEW)
        self.view = fill(QVBoxLayout(self.centre), margins=(0, 0, 0, 0), spacing=0)
        self.bars = QWidget()
        self._bar_layout = fill(QHBoxLayout(self.bars), margins=(0, 0, 0, 0))
        self.row = GroupRow(tr("Tasks"))
        main.setCentralWidget(self.centre)
        main.setDocumentMode(True)
        main.setAnimated(False)  # docks have their places at once, as restoring needs
        main.setDockOptions(QMainWindow.DockOption.AllowTabbedDocks | QMainWindow.DockOption.AllowNestedDocks)
        for corner in (Qt.Corner.TopRightCorner, Qt.Corner.BottomRightCorner):
            main.setCorner(corner, default_layout.RIGHT)
        main.setTabPosition(Qt.DockWidgetArea.AllDockWidgetAreas, QTabWidget.TabPosition.North)
        main.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Size the docks when the window is first shown, and set up tab bars when Qt creates them."""
        if event.type() in (QEvent.Type.Resize, QEvent.Type.Show) and not self._placed and self._docks:
            self.place()
        elif event.type() == QEvent.Type.LayoutRequest:
            self._tab_bars.set_up(self._all())
        return super().eventFilter(watched, event)

    # Adding

    def reserve(self, state: Mapping[str, object]) -> None:
        """Reserve the right column, as wide as in a saved state, for panels that are added later."""
        if not state.get("hidden"):
            self._placeholder = default_layout.reserve_column(self._main, state.get("column"))

    def add(self, panels: Sequence[Panel]) -> None:
        """Add panels; those with the same tab share a dock."""
        panels = sorted(panels, key=lambda panel: (_TAB_ORDER.index(panel.place), panel.order))
        for place, group in groupby(panels, key=lambda panel: panel.place):
            if place is PanelPlace.BELOW:
                for panel in group:
                    self._bars[panel.id] = bar = _wrapped(panel.widget)
                    self._bar_layout.addWidget(bar)
                self.row.follow(self.bars)
            elif place is PanelPlace.EMPTY:
                for panel in group:
                    self.view.insertWidget(0, panel.widget, 1)
            else:
                docks: dict[str, list[Panel]] = {}
                for panel in group:
                    docks.setdefault(panel.tab or panel.title, []).append(panel)
                for title, members in docks.items():
                    self._add_dock(title, members)
        if self._docks:
            if self._placeholder is not None:
                self._main.removeDockWidget(self._placeholder)
                self._placeholder.deleteLater()
                self._placeholder = None
            self.reset()

    def _add_dock(self, title: str, panels: list[Panel]) -> None:
        from hexmend_app.shell.panels.stacked_panels import stack

        first = panels[0]
        unwrapped = len(panels) == 1 and not first.scrolls and first.place is not PanelPlace.TOOLS
        dock = Dock(first.id, title, first.help, self._main)
        dock.place, dock.group = first.place, first.group
        dock.set_page(first.widget if unwrapped else stack(panels))
        dock.closed.connect(self._on_closed)
        dock.visibilityChanged.connect(self._on_visibility)
        for panel in panels:
            self._docks[panel.id] = dock
            self._panels[panel.id] = panel.widget

    # Arrangement

    def _all(self) -> list[Dock]:
        return list(dict.fromkeys(self._docks.values()))

    def _drawer(self) -> list[Dock]:
        return [dock for dock in self._all() if self._in_drawer(dock)]

    def _of_group(self, group: PanelGroup) -> list[Dock]:
        """Return the open docks of a group in the drawer."""
        return [dock for dock in self._drawer() if dock.is_open and dock.group is group]

    def _in_drawer(self, dock: Dock) -> bool:
        return not dock.isFloating() and self._main.dockWidgetArea(dock) == default_layout.BOTTOM

    def reset(self) -> None:
        """Restore the default arrangement: all panels open, the drawer closed."""
        self._restoring = True
        self.hidden, self.folded, self.group, self._drawer_height = False, True, PanelGroup.FIND, _DRAWER
        self._offered.clear()
        for bar in self._bars.values():
            bar.show()
        default_layout.arrange(self._main, self._all())
        self._placed = self._main.isVisible()
        self._restoring = False
        self._refresh_row()

    def place(self) -> None:
        """Give the right column its default size."""
        default_layout.size(self._main, self._all())
        self._placed = self._main.isVisible()

    # Queries

    def ids(self) -> list[str]:
        """Return the ids of the panels that can be shown and closed: tools, figures, drawer, bars."""
        docks = [id for place in default_layout.PLACES for id, dock in self._docks.items() if dock.place is place]
        return [*docks, *self._bars]

    def is_open(self, id: str) -> bool:
        """Return True unless the user has closed a panel."""
        return not self._bars[id].isHidden() if id in self._bars else self._docks[id].is_open

    def in_front(self, id: str) -> bool:
        """Return True if a panel is visible."""
        return self._bars[id].isVisible() if id in self._bars else self._docks[id].in_front

    def _on_closed(self) -> None:
        self._refresh_row()
        self.changed.emit()

    def _on_visibility(self) -> None:
        if not self._restoring:
            self.changed.emit()

    def _refresh_row(self) -> None:
        titles: dict[PanelGroup, list[str]] = {}
        for dock in [dock for dock in self._all() if dock.is_open and dock.place is not PanelPlace.FACTS]:
            titles.setdefault(dock.group, []).append(dock.windowTitle())
        self.row.set_panels(titles, None if self.folded or self.hidden else self.group)


def _wrapped(widget: QWidget) -> QWidget:
    """Return a container of a widget: the feature shows and hides the widget, the user the container."""
    container = QWidget()
    fill(QVBoxLayout(container), widget, margins=(0, 0, 0, 0))
    return container
