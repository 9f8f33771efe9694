"""Where panels stand: in tabs at the right, in a drawer below the view, in a line under it."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

from PySide6.QtCore import QByteArray, QEvent, QObject, Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QSplitter, QVBoxLayout, QWidget

from hexmend_app.feature import Panel, Place
from hexmend_app.shell.tabs import Drawer, Tabs

#: Number of the layout: one that was saved with other panels is not restored.
LAYOUT = "7"

#: The order in which Tab walks through what stands around the view.
_READ = (Place.EMPTY, Place.BELOW, Place.DRAWER, Place.TOOLS, Place.FACTS)

#: Pixels that the view keeps whatever is dragged.
_LEAST_VIEW = (320, 240)

#: Width of the right column where nothing was saved, as a share of the window's and in pixels at least, and how much
#: of its height is for tools.
_COLUMN, _LEAST_COLUMN, _TOOLS = 0.19, 272, 0.55


class Docks(QWidget):
    """The view with all panels around it.

    Signals
    -------
    changed
        Other panels can be seen.

    Attributes
    ----------
    centre : QWidget
        What is not of panels.
    view : QVBoxLayout
        In it, where the 3D view goes.
    """

    changed = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._where: dict[str, tuple[Tabs, QWidget]] = {}
        self._lines: dict[str, QWidget] = {}  # around panels that are no tabs, below the view
        self._panels: dict[str, QWidget] = {}
        self.centre = QWidget()
        self.centre.setMinimumSize(*_LEAST_VIEW)
        self.view = QVBoxLayout(self.centre)
        self.view.setContentsMargins(0, 0, 0, 0)
        self.view.setSpacing(0)
        self.drawer = Drawer("Panels below the view")
        self._tabs = {Place.TOOLS: Tabs("Tools"), Place.FACTS: Tabs("Figures"), Place.DRAWER: self.drawer}
        self._left, self._right = QSplitter(Qt.Orientation.Vertical), QSplitter(Qt.Orientation.Vertical)
        self._all = QSplitter(Qt.Orientation.Horizontal)
        for splitter, parts in (
            (self._left, (self.centre, self.drawer)),
            (self._right, (self._tabs[Place.TOOLS], self._tabs[Place.FACTS])),
            (self._all, (self._left, self._right)),
        ):
            for part in parts:
                splitter.addWidget(part)
            splitter.setHandleWidth(5)
        for splitter in (self._left, self._all):
            splitter.setCollapsible(0, False)
            splitter.setStretchFactor(0, 1)
            splitter.setStretchFactor(1, 0)
        self._left.setCollapsible(1, False)
        self._right.setStretchFactor(0, 3)
        self._right.setStretchFactor(1, 2)
        self._placed = False
        self._put_away: tuple[bool, list[str]] = (True, [])  # whether the drawer was folded, and which lines there were
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self._all)
        for tabs in self._tabs.values():
            tabs.changed.connect(self.changed)
        self._left.handle(1).installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Open the drawer where its upper edge is dragged: folded, it could not follow."""
        if event.type() == QEvent.Type.MouseMove and self.drawer.folded and event.buttons() & Qt.MouseButton.LeftButton:
            self.drawer.set_folded(False)
        return super().eventFilter(watched, event)

    def add(self, panels: Sequence[Panel]) -> None:
        """Give panels their places: those of one tab one below the other, all in their order."""
        panels = sorted(panels, key=lambda one: (_READ.index(one.place), one.order))
        for place, group in groupby(panels, key=lambda one: one.place):
            if place is Place.BELOW:
                for panel in group:
                    self._add_line(panel)
                continue
            if place is Place.EMPTY:
                for panel in group:
                    self.view.insertWidget(0, panel.widget, 1)
                continue
            for title, within in groupby(group, key=lambda one: one.tab or one.title):
                self._add_tab(self._tabs[place], title, list(within))
        for tabs in self._tabs.values():
            tabs.read_before_pages()

    def _add_line(self, panel: Panel) -> None:
        around = QWidget()  # so that the feature and the user each show and hide one of the two
        layout = QVBoxLayout(around)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(panel.widget)
        self.view.addWidget(around)
        self._lines[panel.id] = around

    def _add_tab(self, tabs: Tabs, title: str, panels: list[Panel]) -> None:
        from hexmend_app.shell.column import column

        first = panels[0]
        alone = len(panels) == 1 and not first.scrolls and first.place is not Place.TOOLS
        page = first.widget if alone else column(panels)
        tabs.add(page, title, first.help)
        for panel in panels:
            self._where[panel.id] = (tabs, page)
            self._panels[panel.id] = panel.widget

    def ids(self) -> list[str]:
        """The panels that can be shown and closed, in their order: tools first."""
        tabs = [id for tabs in self._tabs.values() for id, (where, _) in self._where.items() if where is tabs]
        return [*tabs, *self._lines]

    def show_panel(self, id: str) -> None:
        """Bring a panel to the front, unfolded, and all panels back if they are hidden."""
        self.set_hidden(False)
        from hexmend_app.shell.column import unfold

        if id in self._lines:
            self._lines[id].show()
            return
        tabs, page = self._where[id]
        tabs.bring(page)
        unfold(page, self._panels[id])

    def offer_panel(self, id: str) -> None:
        """Bring a panel that is open to the front of its tabs, which stay folded or hidden if they are."""
        tabs, page = self._where[id]
        if tabs.is_open(page):
            tabs.offer(page)

    def close_panel(self, id: str) -> None:
        """Take a panel's tab away, until it is shown again."""
        if id in self._lines:
            self._lines[id].hide()
            return
        tabs, page = self._where[id]
        tabs.close_page(page)

    def is_open(self, id: str) -> bool:
        """Whether a panel has a tab, or its line below the view."""
        if id in self._lines:
            return not self._lines[id].isHidden()
        tabs, page = self._where[id]
        return tabs.is_open(page)

    def in_front(self, id: str) -> bool:
        """Whether a panel can be seen."""
        if id in self._lines:
            return self._lines[id].isVisible()
        tabs, page = self._where[id]
        return tabs.shows(page) and not tabs.isHidden() and not self._right_hidden(tabs)

    def _right_hidden(self, tabs: Tabs) -> bool:
        return tabs is not self.drawer and self._right.isHidden()

    @property
    def hidden(self) -> bool:
        """Whether all panels are hidden."""
        return self._right.isHidden()

    def set_hidden(self, hidden: bool) -> None:
        """Leave the window to the view, or bring the panels back as they were.

        The line of the drawer's tabs stays: what is going on is said there, with a way out.
        """
        if hidden == self.hidden:
            return
        if hidden:
            self._put_away = self.drawer.folded, [id for id in self._lines if self.is_open(id)]
        folded, lines = self._put_away
        self._right.setVisible(not hidden)
        self.drawer.set_folded(hidden or folded)
        for id in lines:
            self._lines[id].setVisible(not hidden)
        self.changed.emit()

    # How it is laid out

    def place(self) -> None:
        """Share the room out as it is where nothing was saved."""
        width = max(round(self.width() * _COLUMN), _LEAST_COLUMN)
        self._all.setSizes([self.width() - width, width])
        tools = round(self.height() * _TOOLS)
        self._right.setSizes([tools, self.height() - tools])
        self._placed = True

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Share the room out at first sight."""
        super().resizeEvent(event)
        if not self._placed and self.width() > 2 * _LEAST_COLUMN:
            self.place()

    def state(self) -> dict[str, object]:
        """The layout, for `restore`."""
        return {
            "layout": LAYOUT,
            "all": self._all.saveState(),
            "right": self._right.saveState(),
            "hidden": self.hidden,
            "drawer": self.drawer.height_open,
            "folded": self._put_away[0] if self.hidden else self.drawer.folded,
            "fronts": [tabs.front for tabs in self._tabs.values()],
            "closed": self._closed(),
        }

    def _closed(self) -> list[str]:
        """What the user has closed, whether panels are hidden or not."""
        put_away = self._put_away[1] if self.hidden else []
        return [id for id in self.ids() if not self.is_open(id) and id not in put_away]

    def restore(self, state: dict[str, object], room: bool = True, panels: bool = True) -> None:
        """Lay out as it was; what was saved with other panels, or cannot be read, is left alone.

        Parameters
        ----------
        state : dict
        room : bool
            Share the room out.
        panels : bool
            Bring tabs to the front and close them, which have to be there.
        """
        try:
            if state["layout"] != LAYOUT:
                return
            sizes = [(self._all, QByteArray(state["all"])), (self._right, QByteArray(state["right"]))]
            fronts = [str(title) for title in state["fronts"]]
            closed = [id for id in state["closed"] if id in self.ids()]
            height, folded, hidden = int(state["drawer"]), bool(state["folded"]), bool(state["hidden"])
        except (KeyError, TypeError, ValueError):
            return
        if room:
            self._placed = True
            for splitter, kept in sizes:
                splitter.restoreState(kept)
            self.drawer.set_height_open(height)
        if panels:
            for tabs, title in zip(self._tabs.values(), fronts, strict=False):
                tabs.set_front(title)
            for id in closed:
                self.close_panel(id)
            self.drawer.set_folded(folded)
            self.set_hidden(hidden)
