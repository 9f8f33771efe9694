"""What the palette finds beside commands."""

import pytest
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QCheckBox, QMainWindow, QVBoxLayout, QWidget

from hexmend.boundary.displacement import DISPLACEMENT_QUANTITIES
from hexmend.quality import METRICS
from hexmend.smoothers import METHODS
from hexmend_app.feature import Panel, PanelPlace
from hexmend_app.shell.palette.palette_entries import choices, commands, panels_in
from hexmend_app.shell.panels.docks import Docks
from hexmend_app.theme.style import set_help
from hexmend_app.widgets.section import Section
from tests.app.hosting import PlainHost
from tests.core.grids import grid


@pytest.fixture
def host(qtbot):
    host = PlainHost(grid(3))
    yield host
    host.session.close()


@pytest.fixture
def panel(qtbot):
    """A panel with a check box in a folded section, one that is disabled and one that is hidden."""
    widget = QWidget()
    boxes = {name: QCheckBox(name) for name in ("Folded", "Disabled", "Hidden", "Plain")}
    for name, box in boxes.items():
        set_help(box, f"{name} box", f"The box that is {name.lower()}.")
    boxes["Disabled"].setEnabled(False)
    column = QVBoxLayout(widget)
    column.addWidget(Section("More", boxes["Folded"], ""))
    for name in ("Disabled", "Hidden", "Plain"):
        column.addWidget(boxes[name])
    boxes["Hidden"].hide()
    return Panel(id="boxes", title="Boxes", widget=widget, place=PanelPlace.TOOLS, help="Some boxes.")


def test_panels_and_what_is_set_in_them_are_found_and_gone_to(panel, shown):
    other = Panel(id="other", title="Other", widget=QWidget(), place=PanelPlace.TOOLS, order=1)
    main = QMainWindow()
    docks = Docks(main)
    docks.add([panel, other])
    shown(main, 900, 500)
    docks.show_panel("other")
    entries = {one.title: one for one in panels_in(docks, [panel, other])}
    assert list(entries) == ["Panel: Boxes", "Panel: Other", "In Boxes: Folded box", "In Boxes: Plain box"]
    entries["In Boxes: Folded box"].do()
    box = next(one for one in panel.widget.findChildren(QCheckBox) if one.text() == "Folded")
    assert docks.in_front("boxes")
    assert box.isVisible()
    assert box.hasFocus()
    entries["Panel: Other"].do()
    assert docks.in_front("other")


def test_a_method_is_chosen_with_what_was_set_for_it(host):
    order = host.session.run_setup
    entries = {one.title: one for one in choices(host.session)}
    for method in METHODS.values():
        entries[f"Method: {method.title}"].do()
        assert order.method == method.name
        assert order.smoother == order.smoother_of(method.name)
        assert method.title in order.reason


def test_a_metric_is_coloured_by(host, qtbot):
    entries = {one.title: one for one in choices(host.session)}
    for metric in (*METRICS.values(), *DISPLACEMENT_QUANTITIES.values()):
        with qtbot.waitSignal(host.session.view.metric_wanted) as told:
            entries[f"Colour by: {metric.title}"].do()
        assert told.args == [metric.name]


def test_commands_that_cannot_be_carried_out_or_only_open_panels_are_left_out(qtbot):
    done, actions = [], {}
    for id, enabled in (("fit", True), ("undo", False), ("panel_run", True), ("edges", True)):
        actions[id] = QAction(f"&{id.title()}")
        actions[id].setEnabled(enabled)
        actions[id].triggered.connect(lambda _=False, id=id: done.append(id))
    actions["edges"].setCheckable(True)
    found = list(commands(actions))
    assert [one.title for one in found] == ["Fit", "Edges: off"]
    found[0].do()
    assert done == ["fit"]
