"""What screen readers say of the window, its panels and its dialogs: every control has a name and a role."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAccessible
from PySide6.QtWidgets import QAbstractSpinBox, QComboBox, QLineEdit, QWidget

from tests.app.dialogs import DIALOGS

pytestmark = pytest.mark.slow

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
    for name, make in DIALOGS.items():
        dialog = make(window)
        with qtbot.waitExposed(dialog):
            dialog.show()
        assert dialog.windowTitle() or name in ("palette", "waiting")
        assert list(accessible_controls(dialog))
        problems[name] = unnamed(dialog)
        dialog.close()
        dialog.deleteLater()
    assert not any(problems.values()), problems
