"""Letters of twice the size: no text of a panel or a dialog is clipped."""

import pytest
from PySide6.QtWidgets import QAbstractButton, QApplication, QLabel, QWidget

from hexmend_app.theme.style import apply_style
from tests.app.conftest import close, separate_settings, window_with_mesh
from tests.app.dialogs import DIALOGS
from tests.app.driving import turn

pytestmark = pytest.mark.slow

#: Pixels by which a text may be larger than its widget: rounding of fonts.
ROUNDING = 2


@pytest.fixture
def large_window(qapp, qtbot, tmp_path, mesh_file):
    """Return a new window with an open mesh and letters of twice the size."""
    before = QApplication.font()
    font = QApplication.font()
    font.setPointSizeF(2 * font.pointSizeF())
    qapp.setFont(font)
    apply_style(qapp, dark=False)
    try:
        with separate_settings(tmp_path / "settings"):
            window = window_with_mesh(qtbot, mesh_file)
            window.resize(1366, 768)
            yield window
            close(window)
    finally:
        qapp.setFont(before)
        apply_style(qapp, dark=False)


def clipped(parent):
    """Return the texts of buttons and labels that are larger than their widgets."""
    found = []
    for widget in parent.findChildren(QAbstractButton) + parent.findChildren(QLabel):
        if not widget.isVisible() or not widget.text():
            continue
        if isinstance(widget, QLabel):
            high, wide = needed_by_label(widget)
        elif getattr(widget, "toolButtonStyle", None) and widget.toolButtonStyle().name == "ToolButtonIconOnly":
            continue
        else:
            metrics, text = widget.fontMetrics(), widget.text().replace("&", "")
            high, wide = metrics.tightBoundingRect(text).height(), metrics.horizontalAdvance(text)
        if widget.height() + ROUNDING < high or widget.width() + ROUNDING < wide:
            found.append(f"{widget.text()!r}: {widget.size().toTuple()}, needs {(wide, high)}")
    return found


def needed_by_label(label):
    """Return height and width that a text needs; an elided or wrapped one needs no width."""
    elided = type(label).minimumSizeHint is not QLabel.minimumSizeHint
    if label.wordWrap():
        return label.heightForWidth(label.width()), 0
    return label.sizeHint().height(), 0 if elided else label.sizeHint().width()


def lay_out_all(window):
    """Process events until no size changes: sizes reach nested panels one level after the other."""
    before = None
    while (sizes := [widget.size().toTuple() for widget in window.findChildren(QWidget)]) != before:
        before = sizes
        turn()


def test_no_text_of_a_panel_is_clipped(large_window):
    window = large_window
    found = set()
    for id in window.docks.ids():
        window.show_panel(id)
        window.refresh()
        lay_out_all(window)
        found |= {f"{id}: {text}" for text in clipped(window)}
    assert "\n".join(sorted(found)) == ""


def test_no_text_of_a_dialog_is_clipped(large_window, qtbot):
    found = {}
    for name, make in DIALOGS.items():
        dialog = make(large_window)
        with qtbot.waitExposed(dialog):
            dialog.show()
        found[name] = clipped(dialog)
        dialog.close()
        dialog.deleteLater()
    assert not any(found.values()), found
