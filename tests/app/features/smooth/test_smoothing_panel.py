"""The smoothing panel's requests and states."""

from dataclasses import dataclass

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QScrollArea

from hexmend.parameters import Parametrised, declared, parameter
from hexmend_app.features.smooth.smoothing_panel import SmoothingPanel

_LEFT = Qt.MouseButton.LeftButton
_STATES = ("idle", "preparing", "running", "paused", "finished")
_SIGNALS = (
    "run_requested",
    "step_requested",
    "pause_requested",
    "resume_requested",
    "stop_requested",
    "reset_requested",
    "method_changed",
)


@dataclass(frozen=True)
class Blend(Parametrised):
    """Parameters of a method."""

    rho: float = parameter(0.5, low=0, high=1, help="Share of the new place.")


@dataclass(frozen=True)
class Limit(Parametrised):
    """Stop conditions."""

    max_iterations: int = parameter(300, low=0, high=1000, help="Most iterations.")


@dataclass(frozen=True)
class Plain(Parametrised):
    """A method without parameters."""


_METHODS = (
    ("blend", "Blending", "Blends.", "Paper 1", declared(Blend)),
    ("plain", "Plain method", "Does it plainly.", "Paper 2", declared(Plain)),
)


@pytest.fixture
def panel(shown):
    widget = SmoothingPanel(declared(Limit))
    widget.set_methods(_METHODS)
    return shown(widget, 360, 700)


@pytest.fixture
def heard(panel):
    calls = []
    for name in _SIGNALS:
        getattr(panel, name).connect(lambda *args, name=name: calls.append((name, *args)))
    return calls


def click(panel, name):
    QTest.mouseClick(panel.buttons.button(name), _LEFT)


def test_run_asks_with_what_is_set(panel, heard):
    panel.form.set_values({"rho": 0.25})
    panel.stop_form.set_values({"max_iterations": 7})
    click(panel, "run")
    click(panel, "step")
    expected = ("blend", {"rho": 0.25}, {"max_iterations": 7})
    assert heard == [("run_requested", *expected), ("step_requested", *expected, 1)]


def test_the_main_button_runs_pauses_and_resumes(panel, heard):
    said = []
    for state in _STATES:
        panel.set_state(state)
        said.append(panel.buttons.button("run").text())
        click(panel, "run")
    assert said == ["Run", "Preparing", "Pause", "Resume", "Run"]
    assert [call[0] for call in heard] == ["run_requested", "pause_requested", "resume_requested", "run_requested"]


@pytest.mark.parametrize("state", _STATES)
def test_a_run_can_be_stopped_exactly_while_there_is_one_and_nothing_is_edited_as_it_runs(panel, heard, state):
    panel.set_state(state)
    under_way = state in ("preparing", "running", "paused")
    click(panel, "stop")
    assert heard == ([("stop_requested",)] if under_way else [])
    assert panel.form.isEnabled() is panel.stop_form.isEnabled() is panel._method.isEnabled()
    assert panel.form.isEnabled() is (state == "paused" or not under_way)


def test_reset_is_offered_once_there_is_something_to_reset(panel, heard):
    for state in ("idle", "running", "paused", "finished"):
        panel.set_state(state)
        click(panel, "reset")
    assert heard == [("reset_requested",)] * 2


def test_keys_choose_a_method_and_each_keeps_its_values(panel, heard):
    panel.form.set_values({"rho": 0.25})
    panel._method.setFocus()
    QTest.keyClick(panel._method, Qt.Key.Key_Down)
    assert heard == [("method_changed", "plain")]
    assert panel.method() == "plain"
    assert panel._help.text().startswith("Does it plainly.")
    assert panel.form.values() == {}
    QTest.keyClick(panel._method, Qt.Key.Key_Up)
    assert panel.form.values() == {"rho": 0.25}


def test_setting_a_method_is_silent(panel, heard):
    panel.set_method("plain")
    panel.set_method("blend", {"rho": 0.75})
    assert heard == []
    assert panel.form.values() == {"rho": 0.75}
    with pytest.raises(KeyError):
        panel.set_method("unknown")
    assert panel.method() == "blend"


def test_a_wrong_value_is_led_to_instead_of_run_with(panel, heard):
    panel._sections[0].expand()
    editor = panel.form.editor("rho")
    editor.lineEdit().setFocus()
    editor.lineEdit().selectAll()
    QTest.keyClicks(editor.lineEdit(), "7")
    panel._sections[0].collapse()
    panel.buttons.button("run").setFocus()
    click(panel, "run")
    click(panel, "step")
    assert heard == []
    assert "Correct" in panel._sentence.text()
    assert editor.isVisible()
    assert editor.hasFocus()


def test_without_methods_nothing_can_be_asked_for(shown):
    panel = shown(SmoothingPanel(declared(Limit)))
    assert not any(panel.buttons.button(name).isEnabled() for name in ("run", "step", "stop", "reset"))
    panel.run_or_pause()
    panel.step()


def test_status_says_how_far_it_is_and_wraps_the_outcome(panel):
    panel.set_status(12, 1.839, "Converged: no node moved further than the tolerance. " * 3)
    assert panel._progress.text().split("·")[0].strip() == "12 iterations"
    assert "1.84 s" in panel._progress.text()
    QTest.qWait(10)
    assert panel._sentence.height() > 2 * panel._sentence.fontMetrics().height()
    assert panel._sentence.width() <= panel.width()


def test_shortcuts_are_told_in_the_tooltips_in_every_state(panel):
    panel.set_shortcuts({"run": "F5", "reset": "Ctrl+R"})
    for state in _STATES:
        panel.set_state(state)
        assert "(F5)" in panel.buttons.button("run").toolTip()
        assert "(Ctrl+R)" in panel.buttons.button("reset").toolTip()


@pytest.mark.parametrize(("height", "opened"), [(900, True), (220, False)])
def test_parameters_are_unfolded_where_there_is_room(shown, height, opened):
    panel = SmoothingPanel(declared(Limit))
    panel.set_methods(_METHODS)
    area = QScrollArea()
    area.setWidget(panel)
    area.setWidgetResizable(True)
    shown(area, 380, height)
    assert panel._sections[0].isExpanded() is opened
    assert panel.form.editor("rho").isVisible() is opened


def test_a_folded_section_is_not_walked_through_and_opens_by_key(panel):
    section = panel._sections[0]
    section.collapse()
    assert not panel.form.isVisible()
    section.toggleButton().setFocus()
    QTest.keyClick(section.toggleButton(), Qt.Key.Key_Space)
    assert panel.form.isVisible()
    assert panel.form.editor("rho").height() > 15
