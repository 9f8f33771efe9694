"""Tab bars that Qt creates for docks."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtWidgets import QHBoxLayout, QMainWindow, QTabBar, QToolButton, QWidget

from hexmend_app.feature import PanelPlace
from hexmend_app.shell.panels.dock import Dock
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import icon, set_help
from hexmend_app.translation import tr

#: Property of tab bars that have been set up once.
_SET_UP = "set_up"

#: Accessible names of the tab bars.
_NAMES = {PanelPlace.TOOLS: "Tools", PanelPlace.FACTS: "Figures", PanelPlace.DRAWER: "Panels below the view"}


class TabBars:
    """Setup of the tab bars of docks, which Qt creates, empties and reuses as docks move.

    Parameters
    ----------
    main : QMainWindow
    close_drawer : callable
        Called when a tab of the drawer is double-clicked.
    """

    def __init__(self, main: QMainWindow, close_drawer: Callable[[], object]):
        self._main, self._close_drawer = main, close_drawer

    def _all(self) -> list[QTabBar]:
        return self._main.findChildren(QTabBar, options=Qt.FindChildOption.FindDirectChildrenOnly)

    def set_up(self, docks: Iterable[Dock]) -> None:
        """Name the tab bars, and insert those with tabs into the tab order, right before their pages."""
        docks = list(docks)
        by_title = {dock.windowTitle(): dock for dock in docks}
        for bar in self._all():
            used = bar.count() > 1 and bar.isVisible()  # Qt keeps bars that are not needed
            bar.setFocusPolicy(Qt.FocusPolicy.TabFocus if used else Qt.FocusPolicy.NoFocus)
            first = next((by_title[title] for title in map(bar.tabText, range(bar.count())) if title in by_title), None)
            if not used or first is None:
                bar.setAccessibleName("")
                continue
            if bar.accessibleName() == tr(_NAMES[first.place]):
                continue
            if not bar.property(_SET_UP):
                bar.setProperty(_SET_UP, True)
                bar.setElideMode(Qt.TextElideMode.ElideRight)
                bar.setUsesScrollButtons(False)
                bar.setDrawBase(False)
                bar.tabBarDoubleClicked.connect(lambda _, bar=bar: self._on_double_click(bar))
                _DockButtons(bar, lambda bar=bar: self._in_front(bar))
            bar.setAccessibleName(tr(_NAMES[first.place]))
            before = first.previousInFocusChain()
            while not before.focusPolicy() & Qt.FocusPolicy.TabFocus:  # setTabOrder ignores other widgets
                before = before.previousInFocusChain()
            if before is not bar:
                QWidget.setTabOrder(before, bar)
        for dock in docks:
            others = [] if dock.isFloating() else self._main.tabifiedDockWidgets(dock)
            dock.show_title(all(other.isHidden() for other in others))

    def hide_stale(self, docks: Iterable[Dock]) -> None:
        """Hide bars that are not right above a dock, or under a newer one: restoring a state leaves them visible."""
        tops = {(dock.x(), dock.y()) for dock in docks if dock.isVisible() and not dock.isFloating()}
        for bar in reversed(self._all()):
            place = bar.x(), bar.y() + bar.height()
            if bar.count() and place not in tops:
                bar.hide()
                bar.setAccessibleName("")  # another bar has it now
            elif bar.count() and bar.isVisible():
                tops.remove(place)

    def drawer_height(self) -> int:
        """Return the height of the tab bar of the drawer in pixels; 0 if it has none."""
        return sum(bar.height() for bar in self._all() if _is_drawer(bar) and bar.isVisible())

    def _in_front(self, bar: QTabBar) -> Dock | None:
        """Return the dock of the current tab of a bar."""
        title = bar.tabText(bar.currentIndex())
        docks = self._main.findChildren(Dock, options=Qt.FindChildOption.FindDirectChildrenOnly)
        return next((dock for dock in docks if dock.windowTitle() == title and not dock.isFloating()), None)

    def _on_double_click(self, bar: QTabBar) -> None:
        if _is_drawer(bar):
            self._close_drawer()


class _DockButtons(QWidget):
    """Buttons at the right end of a tab bar that float and close the dock in front.

    Parameters
    ----------
    bar : QTabBar
    in_front : callable
        Returns the dock in front; None if there is none.
    """

    def __init__(self, bar: QTabBar, in_front: Callable[..., Dock | None]):
        super().__init__(bar)
        self._bar, self._dock = bar, in_front
        row = fill(QHBoxLayout(self), margins=(0, 0, 4, 0), spacing=0)
        for name, title, help, act in (
            ("dock-window", tr("Float"), tr("Make the panel a window of its own."), self._float),
            ("close", tr("Close panel"), tr("Close the panel; the menu View > Panels opens it again."), self._close),
        ):
            button = QToolButton()
            button.setIcon(icon(name))
            button.setAutoRaise(True)
            button.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # the menu View > Panels does the same by keys
            set_help(button, title, help)
            button.clicked.connect(act)
            row.addWidget(button)
        bar.installEventFilter(self)
        self._place()
        self.show()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Stay at the right end of the bar."""
        if event.type() in (QEvent.Type.Resize, QEvent.Type.Show):
            self._place()
        return super().eventFilter(watched, event)

    def _place(self) -> None:
        width = self.sizeHint().width()
        self.setGeometry(self._bar.width() - width, 0, width, self._bar.height())
        self.raise_()

    def _float(self) -> None:
        if dock := self._dock():
            dock.setFloating(True)

    def _close(self) -> None:
        if dock := self._dock():
            dock.close()


def _is_drawer(bar: QTabBar) -> bool:
    return bar.accessibleName() == tr(_NAMES[PanelPlace.DRAWER])
