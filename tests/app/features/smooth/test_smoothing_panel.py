"""Requests and states of the smoothing panel."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QComboBox, QLabel

from hexmend import METHODS, Stage, StoppingCriteria
from hexmend_app.features.smooth.breakpoint_form import BreakpointForm
from hexmend_app.features.smooth.smoothing_panel import SmoothingPanel
from hexmend_app.state.run.breakpoints import Breakpoints
from hexmend_app.state.run.run_setup import RunSetup
from hexmend_app.widgets.section import Section
from tests.app.driving import heard_from, named, type_text

_STATES = ("idle", "preparing", "running", "paused", "finished")
_SIGNALS = (
    "run_requested",
    "step_requested",
    "pause_requested",
    "resume_requested",
)
_STAGE = Stage(METHODS["getme"](scaling=0.25), StoppingCriteria(max_iterations=7))


@pytest.fixture
def setup(qapp):
    """Set-up of the panel: the method GETMe, scaling 0.25."""
    setup = RunSetup()
    setup.choose(_STAGE)
    return setup


@pytest.fixture
def panel(shown, setup):
    return shown(SmoothingPanel(setup), 360, 700)


@pytest.fixture
def heard(panel):
    calls = []
    for name in _SIGNALS:
        getattr(panel, name).connect(lambda *args, name=name: calls.append((name, *args)))
    return calls


def sections(panel):
    return panel.findChildren(Section)


def test_run_and_step_request_the_stage_of_the_form(panel, heard):
    panel.run_or_pause()
    panel.step()
    assert heard == [("run_requested", _STAGE), ("step_requested", _STAGE, 1)]


def test_the_main_button_runs_pauses_and_resumes(panel, heard):
    for state in _STATES:
        panel.set_state(state)
        panel.run_or_pause()
    assert [call[0] for call in heard] == ["run_requested", "pause_requested", "resume_requested", "run_requested"]


@pytest.mark.parametrize("state", _STATES)
def test_nothing_is_edited_while_a_run_is_active(panel, state):
    panel.set_state(state)
    method = named(panel, QComboBox, "Method")
    assert panel.stage.parameters.isEnabled() is panel.stage.stop.isEnabled() is method.isEnabled()
    assert panel.stage.parameters.isEnabled() is (state in ("idle", "paused", "finished"))


def test_keys_choose_a_method_and_each_keeps_its_values(panel, setup):
    method = named(panel, QComboBox, "Method")
    method.setFocus()
    QTest.keyClick(method, Qt.Key.Key_Down)
    assert setup.method == "getme-sequential"
    assert setup.stage.smoother == METHODS["getme-sequential"]()
    assert METHODS["getme-sequential"].help in "".join(label.text() for label in panel.findChildren(QLabel))
    QTest.keyClick(method, Qt.Key.Key_Up)
    assert panel.stage.parameters.values()["scaling"] == 0.25
    assert setup.stage == _STAGE


def test_a_stage_set_elsewhere_is_shown(panel, setup, heard):
    setup.choose(Stage(METHODS["laplacian"](), StoppingCriteria(max_iterations=3)))
    assert named(panel, QComboBox, "Method").currentText() == METHODS["laplacian"].title
    assert panel.stage.stop.values()["max_iterations"] == 3
    assert heard == []
    panel.run_or_pause()
    assert heard == [("run_requested", setup.stage)]


def test_settings_changed_while_paused_change_the_run(panel, setup):
    changes = heard_from(panel.change_requested)
    setup.active_stage = setup.stage
    panel.set_state("paused")
    panel.run_or_pause()
    assert changes == []
    panel.stage.parameters.editor("scaling").setFocus()
    panel.stage.parameters.editor("scaling").stepUp()
    panel.run_or_pause()
    assert changes == [setup.stage]
    assert setup.stage.smoother.scaling > 0.25


def test_run_shows_an_invalid_value(panel, setup, heard):
    parameters = sections(panel)[0]
    parameters.expand()
    editor = panel.stage.parameters.editor("scaling")
    editor.lineEdit().setFocus()
    type_text(editor.lineEdit(), "-7")
    assert setup.stage is None
    assert setup.smoother is None
    parameters.collapse()
    panel.run_or_pause()
    panel.step()
    assert heard == []
    assert "Correct" in named(panel, QLabel, "Outcome").text()
    assert editor.isVisible()
    assert editor.hasFocus()


def test_the_status_shows_progress_and_wraps_the_outcome(panel, qtbot):
    panel.set_status(12, 1.839, "Converged: no node moved further than the tolerance. " * 3)
    progress, sentence = named(panel, QLabel, "Progress"), named(panel, QLabel, "Outcome")
    assert progress.text().split("·")[0].strip() == "12 iterations"
    assert "1.84 s" in progress.text()
    qtbot.waitUntil(lambda: sentence.height() > 2 * sentence.fontMetrics().height())
    assert sentence.width() <= panel.width()


# Form for breakpoints, without a run.


@pytest.fixture
def form(qtbot):
    form = BreakpointForm()
    qtbot.addWidget(form)
    form.set_mesh(10, 20)
    return form


@pytest.mark.parametrize("breakpoints", [
    Breakpoints(),
    Breakpoints(inverts=True, q_min_falls=True),
    Breakpoints(node=3, move=0.25),
    Breakpoints(hex=7, change=0.5, backtracks=9),
])  # fmt: skip
def test_breakpoints_are_emitted_and_read_back(form, qtbot, breakpoints):
    with qtbot.waitSignal(form.changed) as told:
        form.set_breakpoints(breakpoints)
    assert told.args == [breakpoints]
    assert form.breakpoints() == breakpoints


def test_another_mesh_removes_breakpoints_on_single_hexes_and_nodes(form):
    form.set_breakpoints(Breakpoints(inverts=True, node=19, hex=9))
    form.set_mesh(5, 6)
    assert form.breakpoints() == Breakpoints(inverts=True)
