"""No text of a panel or a dialog is clipped, with letters of twice the size too."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAccessible
from PySide6.QtWidgets import QAbstractButton, QAbstractSpinBox, QApplication, QComboBox, QLabel, QLineEdit, QWidget

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
    assert "\n".join(clipped_in_panels(large_window)) == ""


@pytest.mark.parametrize("size", [(1366, 768), (1920, 1080)])
def test_no_text_is_clipped_in_windows_of_usual_sizes(window, size):
    window.resize(*size)
    window.docks.reset()
    assert "\n".join(clipped_in_panels(window)) == ""


def clipped_in_panels(window):
    """Return the clipped texts of each panel."""
    found = set()
    for id in window.docks.ids():
        window.show_panel(id)
        window.refresh()
        lay_out_all(window)
        found |= {f"{id}: {text}" for text in clipped(window)}
    return sorted(found)


def shown_dialogs(window, qtbot):
    """Show each dialog, and yield its name and the dialog."""
    for name, make in DIALOGS.items():
        dialog = make(window)
        with qtbot.waitExposed(dialog):
            dialog.show()
        yield name, dialog
        dialog.close()
        dialog.deleteLater()


def test_no_text_of_a_dialog_is_clipped(large_window, qtbot):
    found = {name: clipped(dialog) for name, dialog in shown_dialogs(large_window, qtbot)}
    assert not any(found.values()), found


# What screen readers say of the window, its panels and its dialogs: every control has a name and a role.


Role = QAccessible.Role

#: Roles that say nothing, and parts that Qt makes by itself: rows and cells are read with their texts.
MEANINGLESS = {Role.NoRole, Role.Client, Role.Pane, Role.Window}
PARTS = {Role.Cell, Role.ListItem, Role.TreeItem, Role.RowHeader, Role.ColumnHeader, Role.Row, Role.Column}
TABLES = {Role.Table, Role.List, Role.Tree}

#: Canvases have no role of their own in Qt; their names and descriptions say what they are.
CANVASES = {"3D view"}


def accessible_controls(widget):
    """Yield what is visible and takes the focus, of all that a screen reader finds in a widget."""
    waiting = [QAccessible.queryAccessibleInterface(widget)]
    while waiting:
        one = waiting.pop()
        if one is None or not one.isValid() or one.state().invisible:
            continue
        if one.state().focusable and one.role() not in PARTS and _takes_keys(one.object()):
            yield one
        if one.role() not in TABLES:
            waiting += [one.child(k) for k in range(one.childCount())]


def _takes_keys(widget):
    """Return True if Tab reaches a widget; the line of a spin box or combo box is a part of that box, which is named."""
    if isinstance(widget, QLineEdit) and isinstance(widget.parent(), (QAbstractSpinBox, QComboBox)):
        return False
    return not isinstance(widget, QWidget) or bool(widget.focusPolicy() & Qt.FocusPolicy.TabFocus)


def unnamed(widget):
    """Return descriptions of the controls without a name, or with a role that says nothing."""
    problems = []
    for one in accessible_controls(widget):
        name, kind = one.text(QAccessible.Text.Name).strip(), one.object()
        described = f"{kind.metaObject().className() if kind else ''} {one.role().name} {name!r}"
        if not name or (one.role() in MEANINGLESS and name not in CANVASES and kind is not widget):
            problems.append(described)
    return problems


def test_the_controls_of_all_panels_have_names_and_roles(window):
    window.action("cut").trigger()
    window.session.selection.choose(7, int(window.session.document.now.mesh.hexes[7, 0]))
    window.session.commands.tag("bad", [7])
    problems, count = set(), 0
    for id in window.docks.ids():
        window.show_panel(id)
        window.refresh()
        problems |= set(unnamed(window))
        count += len(list(accessible_controls(window)))
    assert "\n".join(sorted(problems)) == ""
    assert count > 500


def test_the_controls_of_dialogs_have_names_and_roles(window, qtbot):
    problems = {}
    for name, dialog in shown_dialogs(window, qtbot):
        assert dialog.windowTitle() or name in ("palette", "waiting")
        assert list(accessible_controls(dialog))
        problems[name] = unnamed(dialog)
    assert not any(problems.values()), problems
