"""Operations on the panels around the view: show, close, hide, save and restore."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from PySide6.QtCore import QByteArray, QEvent, Qt
from PySide6.QtWidgets import QApplication, QMainWindow

from hexmend_app.feature import PanelGroup, PanelPlace
from hexmend_app.shell.panels import default_layout
from hexmend_app.shell.panels.dock import Dock
from hexmend_app.shell.panels.dock_set import DockSet
from hexmend_app.shell.panels.tab_bars import TabBars

#: Version of the saved arrangement; another one is ignored.
LAYOUT = 1


class Docks(DockSet):
    """Panels of a main window, with the operations of the user."""

    def __init__(self, main: QMainWindow):
        super().__init__(main)
        self._tab_bars = TabBars(main, lambda: self.set_folded(True))
        self.row.clicked.connect(self.toggle_group)

    def show_panel(self, id: str) -> None:
        """Open a panel in front of its tabs, and show all panels if they are hidden."""
        from hexmend_app.shell.panels.stacked_panels import unfold  # superqt is not needed before the first picture

        self.set_hidden(False)
        if id in self._bars:
            self._bars[id].show()
            self.changed.emit()
            return
        dock = self._docks[id]
        dock.is_open = True
        if self._in_drawer(dock):
            self._open_drawer(dock.group)
        dock.show()
        self._raise(dock)
        unfold(dock.widget(), self._panels[id])
        self.changed.emit()

    def offer_panel(self, id: str) -> None:
        """Put an open panel in front of its tabs; the drawer and hidden panels stay closed."""
        dock = self._docks.get(id)
        if dock is None or not dock.is_open:  # a bar below the view is always visible
            return
        if self.folded and self._in_drawer(dock):
            self._offered.append(dock)
            self.group = dock.group
        elif self.hidden:
            self._offered.append(dock)
        elif self._in_drawer(dock):
            self._open_drawer(dock.group)
            self._raise(dock)
        else:
            self._raise(dock)

    def toggle_group(self, group: PanelGroup) -> None:
        """Bring the tools of a group to the front and open its results below the view; close these if they are open."""
        was_open = not (self.folded or self.hidden) and group is self.group
        self.set_hidden(False)
        if was_open:
            self.set_folded(True)
        else:
            tools = [dock for dock in self._all() if dock.group is group and dock.place is PanelPlace.TOOLS]
            for dock in tools[:1]:
                self.show_panel(dock.objectName())
            if self._of_group(group):
                self._open_drawer(group)
            else:
                self.set_folded(True)
        self._refresh_row()

    def _raise(self, dock: Dock) -> None:
        dock.raise_()
        if not dock.isFloating():  # for a floating dock, Qt returns its former neighbours
            for other in self._main.tabifiedDockWidgets(dock):
                other.set_in_front(False)  # type: ignore[attr-defined]  # all docks are a `Dock`
        dock.set_in_front(dock.isVisible())

    def close_panel(self, id: str) -> None:
        """Close a panel until it is shown again."""
        if id in self._bars:
            self._bars[id].hide()
        else:
            self._docks[id].close()
            self._docks[id].is_open = False
        self._refresh_row()
        self.changed.emit()

    def set_folded(self, folded: bool) -> None:
        """Close the drawer, or open it with the panels of its group."""
        if folded == self.folded:
            return
        if folded:
            self._show_in_drawer([])
        else:
            self._open_drawer(self.group)

    def _open_drawer(self, group: PanelGroup) -> None:
        """Open the drawer with the panels of a group; without any, with the panels of the first group that is open."""
        if not self.folded and group is self.group:
            return
        if not self._of_group(group):
            group = next((dock.group for dock in self._drawer() if dock.is_open), group)
        self._show_in_drawer(self._of_group(group))
        self.group = group
        self._refresh_row()

    def _show_in_drawer(self, shown: list[Dock]) -> None:
        """Show these docks in the drawer and no others; close it if there are none."""
        front = next((dock for dock in self._drawer() if dock.in_front), None)
        if front is not None:
            self._drawer_height = front.height() + self._tab_bars.drawer_height()
            self._offered.append(front)
        self.folded = not shown
        for dock in self._drawer():
            dock.setVisible(dock in shown)
        if shown:
            self._main.resizeDocks(shown[:1], [self._drawer_height], Qt.Orientation.Vertical)
            self._raise(next((dock for dock in reversed(self._offered) if dock in shown), shown[0]))
            self._offered = [dock for dock in self._offered if dock not in shown]
        self._refresh_row()
        self.changed.emit()

    def set_hidden(self, hidden: bool) -> None:
        """Hide all panels, or show them as they were; the status bar stays."""
        if hidden == self.hidden:
            return
        self._restoring = True
        if hidden:
            self._saved = self._main.saveState(LAYOUT)
            self._shown_bars = [id for id in self._bars if self.is_open(id)]
            self._offered += [dock for dock in self._all() if dock.in_front]
            for dock in self._all():
                dock.hide()
        else:
            self._main.restoreState(self._saved, LAYOUT)
        self.hidden = hidden
        newest = next((dock for dock in reversed(self._offered) if self._in_drawer(dock)), None)
        if not hidden:
            for dock in [dock for dock in self._offered if dock.isVisible()]:
                self._raise(dock)
            self._offered = [dock for dock in self._offered if self._in_drawer(dock) and not dock.isVisible()]
        for id in self._shown_bars:
            self._bars[id].setVisible(not hidden)
        self._restoring = False
        if not (hidden or self.folded) and newest is not None:
            self._open_drawer(newest.group)  # a panel of another group was offered meanwhile
        self._refresh_row()
        self.changed.emit()

    # Saving

    def state(self) -> dict[str, object]:
        """Return the arrangement, for `restore`."""
        shown = self._shown_bars if self.hidden else []
        tools = next((dock for dock in self._all() if dock.place is PanelPlace.TOOLS), None)
        fronts = [dock for dock in self._all() if dock.in_front] if not self.hidden else []
        return {
            "layout": LAYOUT,
            "state": self._saved if self.hidden else self._main.saveState(LAYOUT),
            "hidden": self.hidden,
            "drawer": self._drawer_height,
            "group": self.group.value,
            "column": tools.width() if tools is not None else 0,
            "fronts": [dock.windowTitle() for dock in dict.fromkeys([*self._offered, *fronts])],
            "closed": [id for id in self.ids() if not self.is_open(id) and id not in shown],
        }

    def restore(self, state: Mapping[str, Any]) -> None:
        """Restore an arrangement with the drawer closed; one of another version or with invalid values is ignored.

        Parameters
        ----------
        state : mapping
            Return value of `state`.
        """
        try:
            docks, drawer, group = QByteArray(state["state"]), int(state["drawer"]), PanelGroup(state["group"])
            closed, fronts = set(state["closed"]), set(state["fronts"])
            layout, hidden = state["layout"], bool(state["hidden"])
        except (KeyError, TypeError, ValueError):
            return
        if layout != LAYOUT:
            return
        self.reset()
        QApplication.sendPostedEvents(self._main, QEvent.Type.LayoutRequest)
        self._restoring = True
        self._drawer_height, self.group = drawer, group
        self._placed = self._main.restoreState(docks, LAYOUT) or self._placed
        for id in closed.intersection(self.ids()):
            self.close_panel(id)
        for dock in self._all():
            if not dock.isFloating() and self._main.dockWidgetArea(dock) == Qt.DockWidgetArea.NoDockWidgetArea:
                self._main.addDockWidget(default_layout.area_of(dock.place), dock)
        for dock in self._all():
            dock.setVisible(dock.is_open and not self._in_drawer(dock))
        for dock in self._all():
            if dock.windowTitle() in fronts and dock.is_open:
                if self._in_drawer(dock):
                    self._offered.append(dock)
                else:
                    self._raise(dock)
        self._restoring = False
        QApplication.sendPostedEvents(self._main, QEvent.Type.LayoutRequest)
        self._tab_bars.hide_stale(self._all())
        self._refresh_row()
        self.set_hidden(hidden)
