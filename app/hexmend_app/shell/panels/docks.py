"""Panels around the view: tabbed docks on the right and below, and bars between view and docks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import groupby, pairwise
from typing import Any

from PySide6.QtCore import QByteArray, QObject, Qt, QTimer, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMainWindow, QTabWidget, QToolBar, QVBoxLayout, QWidget

from hexmend_app.feature import Panel, PanelPlace
from hexmend_app.shell.panels.dock import Dock, set_up_tab_bars
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import set_help
from hexmend_app.widgets.form import row_of

#: Version of the saved arrangement; another one is ignored.
LAYOUT = 2

_RIGHT, _BOTTOM = Qt.DockWidgetArea.RightDockWidgetArea, Qt.DockWidgetArea.BottomDockWidgetArea

#: Default areas of docks by place, in the order of the menu.
_AREAS = {PanelPlace.TOOLS: _RIGHT, PanelPlace.FACTS: _RIGHT, PanelPlace.DRAWER: _BOTTOM}

#: Order of places in which panels are added and reached by Tab.
_TAB_ORDER = (PanelPlace.EMPTY, PanelPlace.BAR, PanelPlace.DRAWER, PanelPlace.TOOLS, PanelPlace.FACTS)

#: Default width of the right column as a share of that of the window, and its minimum in pixels; a dock is never
#: narrower than its panels.
_COLUMN_SHARE, _MINIMUM_COLUMN = 0.195, 256

#: Default share of tools in the height of the right column, and height of the docks below the view in pixels.
_TOOLS_SHARE, _DRAWER = 0.6, 260

#: Minimum size of the view in pixels.
_MINIMUM_VIEW = (320, 240)


class Docks(QObject):
    """Panels of a main window.

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
        The layout of `centre`; the 3D view is inserted into it.
    buttons : QToolBar
        A button for each dock below the view, for the status bar.
    hidden : bool
        All panels are hidden.
    """

    changed = Signal()

    def __init__(self, main: QMainWindow):
        super().__init__(main)
        self._main = main
        self._docks: dict[str, Dock] = {}  # by the id of each panel
        self._panels: dict[str, QWidget] = {}
        self._bars: dict[str, QWidget] = {}
        self._actions: dict[str, QAction] = {}  # of the docks below the view
        self._placeholder: Dock | None = None
        self.hidden = False
        self._saved = QByteArray()  # the arrangement before all panels were hidden
        self._drawer: list[Dock] = []  # open below the view before they were closed together
        self._update_timer = QTimer(self, singleShot=True, interval=0)
        self._update_timer.timeout.connect(self._update)
        self.centre, self.buttons = QWidget(), QToolBar()
        self.centre.setMinimumSize(*_MINIMUM_VIEW)
        self.view = fill(QVBoxLayout(self.centre), margins=(0, 0, 0, 0), spacing=0)
        main.setCentralWidget(self.centre)
        main.setDocumentMode(True)
        main.setAnimated(False)
        for corner in (Qt.Corner.TopRightCorner, Qt.Corner.BottomRightCorner):
            main.setCorner(corner, _RIGHT)
        main.setTabPosition(Qt.DockWidgetArea.AllDockWidgetAreas, QTabWidget.TabPosition.North)

    # Adding

    def reserve(self, state: Mapping[str, Any]) -> None:
        """Reserve the right column, as wide as in a saved state, for panels that are added later."""
        self._placeholder = dock = Dock("space", "", "", PanelPlace.TOOLS)
        dock.setFeatures(Dock.DockWidgetFeature.NoDockWidgetFeatures)
        dock.setWidget(QWidget())
        self._main.addDockWidget(_RIGHT, dock)
        width = state.get("column")
        self._main.resizeDocks([dock], [width if isinstance(width, int) else self._column], Qt.Orientation.Horizontal)

    def add(self, panels: Sequence[Panel]) -> None:
        """Add panels; those with the same tab share a dock."""
        panels = sorted(panels, key=lambda panel: (_TAB_ORDER.index(panel.place), panel.order))
        for place, group in groupby(panels, key=lambda panel: panel.place):
            if place is PanelPlace.EMPTY:
                for panel in group:
                    self.view.insertWidget(0, panel.widget, 1)
            elif place is PanelPlace.BAR:
                for panel in group:
                    self._bars[panel.id] = bar = row_of(panel.widget)  # the user hides the row
                    self.view.addWidget(bar)
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
        dock = Dock(first.id, title, first.help, first.place, self._main)
        dock.set_page(first.widget if unwrapped else stack(panels))
        dock.visibilityChanged.connect(lambda _: self._update_timer.start())
        dock.topLevelChanged.connect(lambda _: self._update_timer.start())
        for panel in panels:
            self._docks[panel.id] = dock
            self._panels[panel.id] = panel.widget
        if first.place is PanelPlace.DRAWER:
            self._add_button(first.id, title, first.help)

    def _add_button(self, id: str, title: str, help: str) -> None:
        action = self._actions[id] = self.buttons.addAction(title)
        action.setCheckable(True)
        action.triggered.connect(lambda: self.close_panel(id) if self._docks[id].in_front else self.show_panel(id))
        button = self.buttons.widgetForAction(action)
        button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        set_help(button, title, help)

    # Arrangement

    def _all(self) -> list[Dock]:
        return list(dict.fromkeys(self._docks.values()))

    def _of(self, place: PanelPlace) -> list[Dock]:
        return [dock for dock in self._all() if dock.place is place]

    @property
    def _column(self) -> int:
        return max(round(self._main.width() * _COLUMN_SHARE), _MINIMUM_COLUMN)

    def reset(self) -> None:
        """Restore the default arrangement: tools above figures on the right, the docks below the view closed."""
        self.set_hidden(False)
        for bar in self._bars.values():
            bar.show()
        for dock in self._all():
            dock.setFloating(False)
            self._main.removeDockWidget(dock)
            dock.hide()  # adding visible docks would lay out all of them each time
        for place, area in _AREAS.items():
            docks = self._of(place)
            for dock in docks:
                self._main.addDockWidget(area, dock)
            for before, dock in pairwise(docks):
                self._main.tabifyDockWidget(before, dock)
        tools, facts = self._of(PanelPlace.TOOLS), self._of(PanelPlace.FACTS)
        for dock in [*tools, *facts]:
            dock.show()
        column = [*tools[:1], *facts[:1]]
        for dock in column:
            dock.raise_()
        self._main.resizeDocks(column, [self._column] * len(column), Qt.Orientation.Horizontal)
        heights = [round(share * self._main.height()) for share in (_TOOLS_SHARE, 1 - _TOOLS_SHARE)]
        self._main.resizeDocks(column, heights[: len(column)], Qt.Orientation.Vertical)
        self._main.resizeDocks(self._of(PanelPlace.DRAWER)[:1], [_DRAWER], Qt.Orientation.Vertical)

    def _update(self) -> None:
        """Show the state of the docks on tabs, titles and buttons."""
        for dock in self._all():
            others = [] if dock.isFloating() else self._main.tabifiedDockWidgets(dock)
            dock.show_title(all(other.isHidden() for other in others))
            if dock.isFloating():  # Qt does not tell that a dock behind a tab is visible now
                dock.set_in_front(dock.isVisible())
        set_up_tab_bars(self._main, self._all())
        for id, action in self._actions.items():
            action.setChecked(self._docks[id].in_front)
        self.changed.emit()

    # Queries

    def ids(self) -> list[str]:
        """Return the ids of the panels that can be shown and closed: tools, figures, below the view, bars."""
        return [*(id for place in _AREAS for id, dock in self._docks.items() if dock.place is place), *self._bars]

    def is_open(self, id: str) -> bool:
        """Return True unless a panel is closed or hidden; it may be behind another tab."""
        return not (self._bars.get(id) or self._docks[id]).isHidden()

    def is_visible(self, id: str) -> bool:
        """Return True if a panel is visible."""
        return self._bars[id].isVisible() if id in self._bars else self._docks[id].in_front

    @property
    def drawer_open(self) -> bool:
        """True if there are open docks below the view."""
        return bool(self._open_below())

    def _open_below(self) -> list[Dock]:
        """Return the open docks below the view, the one in front last."""
        docks = [dock for dock in self._all() if not (dock.isHidden() or dock.isFloating())]
        below = [dock for dock in docks if self._main.dockWidgetArea(dock) == _BOTTOM]
        return sorted(below, key=lambda dock: dock.in_front)

    # Operations of the user

    def show_panel(self, id: str) -> None:
        """Open a panel in front of its tabs, and show all panels if they are hidden."""
        from hexmend_app.shell.panels.stacked_panels import unfold  # superqt is not needed before the first picture

        self.set_hidden(False)
        if id in self._bars:
            self._bars[id].show()
            self._update_timer.start()
        else:
            dock = self._docks[id]
            dock.show()
            self._raise(dock)
            unfold(dock.widget(), self._panels[id])

    def raise_if_open(self, id: str) -> None:
        """Put an open panel in front of its tabs."""
        dock = self._docks.get(id)
        if dock is not None and not dock.isHidden():
            self._raise(dock)

    def _raise(self, dock: Dock) -> None:
        dock.raise_()
        if dock.isVisible():
            for other in [] if dock.isFloating() else self._main.tabifiedDockWidgets(dock):
                other.set_in_front(False)  # type: ignore[attr-defined]  # all docks are a `Dock`
            dock.set_in_front(True)  # Qt tells it in the next turn of the event loop
        self._update_timer.start()

    def close_panel(self, id: str) -> None:
        """Close a panel until it is shown again."""
        (self._bars.get(id) or self._docks[id]).hide()
        self._update_timer.start()

    def set_drawer_open(self, is_open: bool) -> None:
        """Close all docks below the view, or open again those that were closed together."""
        if not is_open:
            self._drawer = self._open_below()
        self.set_hidden(False)
        for dock in self._drawer or self._of(PanelPlace.DRAWER)[:1]:
            dock.setVisible(is_open)
            if is_open:
                self._raise(dock)

    def set_hidden(self, hidden: bool) -> None:
        """Hide all panels, or show them as they were; the status bar stays."""
        if hidden == self.hidden:
            return
        self.hidden = hidden
        if hidden:
            self._saved = self._main.saveState(LAYOUT)
            for dock in self._all():
                dock.hide()
        else:
            self._restore(self._saved)
        for bar in self._bars.values():
            bar.setVisible(not hidden)
        self._update_timer.start()

    # Saving

    def state(self) -> dict[str, Any]:
        """Return the arrangement, for `restore`."""
        column = [dock.width() for dock in self._all() if dock.in_front and dock.place is PanelPlace.TOOLS]
        state = self._saved if self.hidden else self._main.saveState(LAYOUT)
        return {"state": state, "column": next(iter(column), None)}

    def restore(self, state: Mapping[str, Any]) -> None:
        """Restore an arrangement; one of another version or with invalid values is ignored.

        Parameters
        ----------
        state : mapping
            Return value of `state`.
        """
        self.set_hidden(False)
        if isinstance(state.get("state"), QByteArray):
            self._restore(state["state"])

    def _restore(self, state: QByteArray) -> None:
        for dock in self._all():
            dock.show_title(True)  # changing it in a floating dock would make a new window
            self._main.removeDockWidget(dock)  # otherwise Qt leaves tab bars of the former arrangement
        if not self._main.restoreState(state, LAYOUT):
            self.reset()
        for dock in self._all():  # of features that have been added since
            if not dock.isFloating() and self._main.dockWidgetArea(dock) == Qt.DockWidgetArea.NoDockWidgetArea:
                self._main.addDockWidget(_AREAS[dock.place], dock)
        self._update_timer.start()
