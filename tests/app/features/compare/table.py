"""The table of the comparison, driven by the mouse."""

from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QApplication, QTableView, QWidget

from hexmend.report.comparison import LINES
from hexmend.run import StoppingCriteria
from hexmend_app.canvas.view_captions import CaptionRow
from hexmend_app.features.compare.comparison_table import METHOD
from tests.app.driving import LEFT, named

COLUMN = {quantity.key: at for at, quantity in enumerate(LINES, 2)}

SHORT, ENDLESS = StoppingCriteria(max_iterations=4), StoppingCriteria(max_iterations=100_000, tolerance=0.0)


def table_of(window):
    window.refresh()
    return named(window.features["compare"].panel, QTableView, "Comparison of methods")


def model(window):
    return table_of(window).model()


def row(window, name):
    return [one.name for one in model(window).rows].index(name)


def tick(window, name, column):
    """Click on a check box of a row."""
    table = table_of(window)
    index = model(window).index(row(window, name), column)
    table.scrollTo(index)
    rect = table.visualRect(index)
    QTest.mouseClick(table.viewport(), LEFT, pos=QPoint(rect.left() + 10, rect.center().y()))
    window.refresh()


def button(window, name):
    window.refresh()
    return named(window.features["compare"].panel, QAbstractButton, name)


def choose_methods(window, *names):
    for name in sorted(model(window).ticks ^ set(names)):
        tick(window, name, METHOD)
    assert model(window).ticks == set(names)


def captions(window):
    """Return the captions of the views, row by row."""
    window.refresh()
    QApplication.processEvents()  # layouts apply changes in the event loop
    direct = Qt.FindChildOption.FindDirectChildrenOnly
    parts = [part for row in window.findChildren(CaptionRow) for part in row.findChildren(QWidget, options=direct)]
    return [part.accessibleName().partition(":")[0] for part in parts if part.isVisibleTo(window)]
