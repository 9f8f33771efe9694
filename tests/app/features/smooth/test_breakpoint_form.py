"""Form for breakpoints, without a run."""

import pytest

from hexmend_app.features.smooth.breakpoint_form import BreakpointForm
from hexmend_app.state.run.breakpoints import Breakpoints
from tests.patience import PATIENCE


@pytest.mark.parametrize(
    "breakpoints",
    [
        Breakpoints(),
        Breakpoints(inverts=True, q_min_falls=True),
        Breakpoints(node=3, move=0.25),
        Breakpoints(hex=7, change=0.5, backtracks=9),
    ],
)
def test_breakpoints_are_emitted_and_read_back(qtbot, breakpoints):
    form = BreakpointForm()
    qtbot.addWidget(form)
    form.set_mesh(10, 20)
    with qtbot.waitSignal(form.changed, timeout=PATIENCE) as told:
        form.set_breakpoints(breakpoints)
    assert told.args == [breakpoints]
    assert form.breakpoints() == breakpoints


def test_another_mesh_removes_breakpoints_on_single_hexes_and_nodes(qtbot):
    form = BreakpointForm()
    qtbot.addWidget(form)
    form.set_mesh(10, 20)
    form.set_breakpoints(Breakpoints(inverts=True, node=19, hex=9))
    form.set_mesh(5, 6)
    assert form.breakpoints() == Breakpoints(inverts=True)
