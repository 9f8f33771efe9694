"""Controls with a given text, for tests of the theme: one of each kind of text and background."""

from __future__ import annotations

from PySide6.QtGui import QAction, QIcon
from PySide6.QtWidgets import QCheckBox, QLineEdit, QMenu, QPushButton, QTableWidget, QTableWidgetItem, QToolButton

from hexmend_app.widgets.inputs.segmented import Segmented

SIZE = (300, 140)


def default_button(text):
    widget = QPushButton(text)
    widget.setProperty("default", True)
    return widget


def tool_button(text):
    return QToolButton(text=text, checkable=True, autoRaise=True)


def segmented(text):
    widget = Segmented("Choice", [("a", text, ""), ("b", "b", "")])
    widget.target = widget.button("a")
    return widget


def placeholder(text):
    widget = QLineEdit()
    widget.setPlaceholderText(text)
    return widget


def selected_row(text):
    widget = QTableWidget(2, 1)
    widget.setHorizontalHeaderLabels(["a"])
    widget.setItem(1, 0, QTableWidgetItem(text))
    widget.selectRow(1)
    return widget


#: Functions that make a control with a text, with a state of the control.
CONTROLS = {
    "button": (QPushButton, "enabled"),
    "pressed button": (QPushButton, "pressed"),
    "disabled button": (QPushButton, "disabled"),
    "default button": (default_button, "hover"),
    "checked tool button": (tool_button, "checked"),
    "chosen segment": (segmented, "checked and disabled"),
    "field": (QLineEdit, "focus"),
    "placeholder": (placeholder, "enabled"),
    "check box": (QCheckBox, "checked"),
    "selected row": (selected_row, "enabled"),
}


def menu(text, enabled=True, active=False, checkable=False):
    """Return an open menu with an entry."""
    widget = QMenu()
    action = QAction(text, widget)
    action.setEnabled(enabled)
    action.setCheckable(checkable)
    action.setChecked(checkable)
    action.setIcon(QIcon())
    widget.addAction(action)
    widget.addAction("another one that is longer")
    if active:
        widget.setActiveAction(action)
    return widget
