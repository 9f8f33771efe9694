"""Row of buttons, one for each group of panels: its tools on the right, its results below the view."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QToolButton, QWidget

from hexmend_app.feature import PanelGroup
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import set_help
from hexmend_app.translation import tr

#: Help of the buttons.
_HELP = {
    PanelGroup.LOOK: "Colour, layers and cuts.",
    PanelGroup.FIND: "Worst hexes, the selected hex, problems of the mesh and tags.",
    PanelGroup.SMOOTH: "Methods and their parameters, convergence, runs and the step of a node.",
    PanelGroup.COMPARE: "Results of several methods in a table and in views.",
    PanelGroup.REPORT: "Script and console: how the mesh was made.",
}


class GroupRow(QWidget):
    """Buttons of the groups of panels; the button of the group whose panels are open below the view is checked.

    Signals
    -------
    clicked(PanelGroup)

    Parameters
    ----------
    name : str
        Accessible name.
    """

    clicked = Signal(object)

    def __init__(self, name: str, parent: QWidget | None = None):
        super().__init__(parent)
        self.setAccessibleName(name)
        self._buttons = {}
        for group in PanelGroup:
            button = self._buttons[group] = QToolButton()
            button.setText(tr(group.value))
            button.setCheckable(True)
            button.setAutoRaise(True)
            button.clicked.connect(lambda _, group=group: self.clicked.emit(group))
        fill(QHBoxLayout(self), *self._buttons.values(), margins=(8, 0, 8, 0), spacing=0)
        self.set_panels({}, None)

    def set_panels(self, titles: Mapping[PanelGroup, list[str]], front: PanelGroup | None) -> None:
        """Show the groups that have panels, with their titles in the tooltip, and check the button of one group."""
        for group, button in self._buttons.items():
            panels = titles.get(group, [])
            button.setVisible(bool(panels))
            button.setChecked(group is front)
            set_help(button, tr(group.value), f"{tr(_HELP[group])}\n{', '.join(panels)}")

    def follow(self, widget: QWidget) -> None:
        """Let Tab come to the buttons after all controls in a widget."""
        focusable = [child for child in widget.findChildren(QWidget) if child.focusPolicy() & Qt.FocusPolicy.TabFocus]
        for before, after in pairwise([*focusable[-1:], *self._buttons.values()]):
            QWidget.setTabOrder(before, after)

    def button(self, group: PanelGroup) -> QToolButton:
        """Return the button of a group."""
        return self._buttons[group]
