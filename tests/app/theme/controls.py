"""Controls of all classes with a given text, for tests of the theme."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QIcon
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QDockWidget,
    QDoubleSpinBox,
    QGroupBox,
    QLabel,
    QLineEdit,
    QListWidget,
    QMenu,
    QMenuBar,
    QMessageBox,
    QPlainTextEdit,
    QProgressBar,
    QPushButton,
    QRadioButton,
    QSpinBox,
    QStatusBar,
    QTabBar,
    QTableWidget,
    QTableWidgetItem,
    QTextBrowser,
    QToolBar,
    QToolButton,
    QTreeWidget,
    QTreeWidgetItem,
    QWidget,
)

from hexmend.parameters import Parameter
from hexmend_app.canvas.swatch_button import SwatchButton
from hexmend_app.theme.style import note
from hexmend_app.widgets.inputs.number_box import NumberBox
from hexmend_app.widgets.inputs.segmented import Segmented
from hexmend_app.widgets.section import Section

SIZE = (300, 140)


def button(text, variant="", **properties):
    widget = QPushButton(text)
    if variant:
        widget.setProperty("variant", variant)
    for name, value in properties.items():
        widget.setProperty(name, value)
    return widget


def tool(text, **properties):
    widget = QToolButton()
    widget.setText(text)
    widget.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextOnly)
    for name, value in properties.items():
        widget.setProperty(name, value)
    return widget


def tool_bar(text):
    bar = QToolBar()
    action = bar.addAction(text)
    action.setCheckable(True)
    bar.target = bar.widgetForAction(action)
    bar.target.setFixedSize(90, 28)
    return bar


def spin(text, kind=QSpinBox):
    widget = kind()
    widget.setButtonSymbols(widget.ButtonSymbols.UpDownArrows)
    widget.setPrefix(text)
    return widget


def number_box(text, typed=False):
    widget = NumberBox(Parameter("number", float, 1.0, None, None, None, "", "A number."))
    line = widget.lineEdit()
    line.setText(text)
    if typed:
        line.textEdited.emit("x")
    return widget


def segmented(text):
    widget = Segmented("Choice", [("a", text, ""), ("b", "b", "")])
    widget.target = widget.button("a")
    return widget


def other_segment(text):
    widget = segmented("a")
    widget.target = widget.button("b")
    widget.target.setText(text)
    return widget


def combo(text):
    widget = QComboBox()
    widget.addItem(text)
    return widget


def editable_combo(text):
    widget = combo(text)
    widget.setEditable(True)
    return widget


def tabs(text):
    bar = QTabBar()
    bar.addTab("chosen")
    bar.addTab(text)
    return bar


def chosen_tab(text):
    bar = QTabBar()
    bar.addTab(text)
    bar.addTab("other")
    return bar


def list_of(text, row=-1):
    widget = QListWidget()
    widget.addItems(["a", text])
    widget.setAlternatingRowColors(True)
    widget.setCurrentRow(row)
    return widget


def table(text, row=-1):
    widget = QTableWidget(2, 1)
    widget.setHorizontalHeaderLabels(["a"])
    widget.setItem(1, 0, QTableWidgetItem(text))
    if row >= 0:
        widget.selectRow(row)
    return widget


def header(text):
    widget = QTableWidget(1, 1)
    widget.setHorizontalHeaderLabels([text])
    return widget


def tree(text):
    widget = QTreeWidget()
    widget.addTopLevelItem(QTreeWidgetItem([text]))
    return widget


def text_page(kind, text):
    widget = kind()
    widget.setPlainText(text)
    return widget


def selected_text(text):
    widget = QLineEdit(text)
    widget.selectAll()
    return widget


def progress(text, value):
    bar = QProgressBar()
    bar.setValue(value)
    bar.setFormat(text)
    return bar


def menu_bar(text):
    bar = QMenuBar()
    bar.addMenu(QMenu(text, bar))
    return bar


def dock(text):
    widget = QDockWidget(text)
    widget.setWidget(QWidget())
    return widget


def status_bar(text):
    bar = QStatusBar()
    bar.showMessage(text)
    return bar


def placeholder(text):
    widget = QLineEdit()
    widget.setPlaceholderText(text)
    return widget


def message_box(text):
    box = QMessageBox(
        QMessageBox.Icon.Warning, "Title", f"{text}\nA second line that is longer", QMessageBox.StandardButton.Ok
    )
    box.target = box.button(QMessageBox.StandardButton.Ok)
    return box


def swatch(text):
    widget = SwatchButton()
    widget.show_kind(text, 4, Qt.GlobalColor.red)
    return widget


def name(text):
    widget = QLineEdit(text)
    widget.setProperty("variant", "name")
    return widget


#: Functions that make a control with a text, by name.
CONTROLS = {
    "push button": button,
    "default button": lambda text: button(text, default=True),
    "flat button": lambda text: button(text, flat=True),
    "checkable button": lambda text: button(text, checkable=True),
    "link": lambda text: button(text, "link"),
    "section": lambda text: button(text, "section", checkable=True),
    "section of a panel": lambda text: Section(text, QWidget(), "Help"),
    "tool button": tool,
    "raised tool button": lambda text: tool(text, autoRaise=True, checkable=True),
    "main button": lambda text: tool(text, variant="main"),
    "small button": lambda text: tool(text, variant="small"),
    "tool bar": tool_bar,
    "chosen segment": segmented,
    "other segment": other_segment,
    "line edit": QLineEdit,
    "name": name,
    "selected text": selected_text,
    "placeholder": placeholder,
    "spin box": spin,
    "double spin box": lambda text: spin(text, QDoubleSpinBox),
    "number box": number_box,
    "wrong number": lambda text: number_box(text, typed=True),
    "combo box": combo,
    "editable combo box": editable_combo,
    "check box": QCheckBox,
    "radio button": QRadioButton,
    "tab": tabs,
    "chosen tab": chosen_tab,
    "list": list_of,
    "selected row of a list": lambda text: list_of(text, 1),
    "table": table,
    "selected row of a table": lambda text: table(text, 1),
    "header": header,
    "tree": tree,
    "plain text": lambda text: text_page(QPlainTextEdit, text),
    "page": lambda text: text_page(QTextBrowser, text),
    "empty progress bar": lambda text: progress(text, 0),
    "menu bar": menu_bar,
    "group box": QGroupBox,
    "dock": dock,
    "status bar": status_bar,
    "label": QLabel,
    "note": note,
    "message box": message_box,
    "swatch": swatch,
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
