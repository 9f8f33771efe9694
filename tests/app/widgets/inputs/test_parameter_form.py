"""Forms of declared parameters of every type."""

import dataclasses
from dataclasses import dataclass

import pytest
from hypothesis import given
from hypothesis import strategies as st
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractSpinBox, QApplication, QLabel, QLineEdit, QToolButton, QVBoxLayout, QWidget

from hexmend.parameters import Parameter, Parametrised, declared, parameter
from hexmend.smoothers import METHODS
from hexmend_app.widgets.inputs.number_box import NumberBox
from hexmend_app.widgets.inputs.parameter_form import ParameterForm
from hexmend_app.widgets.inputs.segmented import Segmented
from tests.app.driving import named, type_text

_LEFT = Qt.MouseButton.LeftButton


@dataclass(frozen=True)
class AllKinds(Parametrised):
    """Parameters of every type."""

    delta: float = parameter(0.01, low=0, high=10, unit="mean edge length³", help="Softness of the barrier.")
    free_value: float = parameter(-3.5, help="A number without bounds.")
    max_cuts: int = parameter(30, low=1, high=200, help="Cuts at most.")
    take_back_where_the_attached_minimum_falls: bool = parameter(False, help="Whether a move is taken back.")
    weights: str = parameter("equal", choices=("equal", "root-of-quality"), help="Weights of the hexes.")
    label: str = parameter("a", help="Free text.")


_NAMES = [field.name for field in dataclasses.fields(AllKinds)]
_OTHER = {
    "delta": 2.5e-4,
    "free_value": 1e30,
    "max_cuts": 7,
    "take_back_where_the_attached_minimum_falls": True,
    "weights": "root-of-quality",
    "label": "b",
}


@pytest.fixture
def form(shown):
    return shown(ParameterForm(declared(AllKinds)))


@pytest.fixture
def changes(form):
    count = []
    form.changed.connect(lambda: count.append(form.values()))
    return count


def type_into(editor, text):
    line = editor.lineEdit() if isinstance(editor, NumberBox) else editor
    line.setFocus()
    type_text(line, text)


def test_set_values_are_returned_without_a_signal(form, changes):
    form.set_values(_OTHER)
    assert form.values() == AllKinds(**form.values()).values() == _OTHER
    assert changes == []
    assert named(form, QToolButton, "Defaults").isEnabled()


@pytest.mark.parametrize(("text", "value"), [("1e-4", 1e-4), (" 2.5E-3", 2.5e-3), ("10", 10.0), (".5", 0.5)])
def test_any_notation_of_a_number_is_accepted(form, changes, text, value):
    type_into(form.editors["delta"], text)
    assert form.values()["delta"] == value
    assert changes[-1]["delta"] == value
    assert form.problems() == {}


@pytest.mark.parametrize("text", ["11", "-1", "abc", "1,5", "nan", "inf", ""])
def test_an_invalid_text_is_explained_and_kept(form, text):
    editor = form.editors["delta"]
    if text:
        type_into(editor, text)
    else:
        editor.lineEdit().setFocus()
        editor.lineEdit().selectAll()
        QTest.keyClick(editor.lineEdit(), Qt.Key.Key_Delete)
    QTest.keyClick(editor, Qt.Key.Key_Tab)
    assert editor.lineEdit().text() == text
    assert "from 0 to 10" in form.problems()["delta"]
    assert any("from 0 to 10" in label.text() and label.isVisible() for label in form.findChildren(QLabel))
    assert form.values()["delta"] == 0.01  # as before the typing


@pytest.mark.parametrize("text", ["0", "201", "3.5"])
def test_integers_have_bounds(form, text):
    type_into(form.editors["max_cuts"], text)
    assert "a whole number from 1 to 200" in form.problems()["max_cuts"]


def test_every_type_is_edited_by_keys_and_clicks(form, changes):
    QTest.keyClick(form.editors["max_cuts"], Qt.Key.Key_Up)
    QTest.mouseClick(form.editors["take_back_where_the_attached_minimum_falls"], _LEFT, pos=QPoint(8, 8))
    form.editors["weights"].setFocus()
    QTest.keyClick(form.editors["weights"], Qt.Key.Key_Down)
    type_into(form.editors["label"], "b")
    expected = {name: _OTHER[name] for name in _NAMES[3:]} | {"max_cuts": 31}
    assert {name: form.values()[name] for name in expected} == expected
    assert len(changes) == 4


def test_modified_values_are_marked_and_reset(form, changes):
    (label,) = (label for label in form.findChildren(QLabel) if label.buddy() is form.editors["delta"])
    form.set_values(_OTHER)
    assert label.font().bold()
    QTest.mouseClick(named(form, QToolButton, "Defaults"), _LEFT)
    assert form.values() == AllKinds().values()
    assert not label.font().bold()
    assert len(changes) == 1


def test_the_wheel_changes_only_focused_editors(form):
    form.editors["label"].setFocus()

    def turn(widget):
        place = widget.mapTo(form, QPoint(5, 5))
        QTest.wheelEvent(form.windowHandle(), QPointF(place), QPoint(0, 120))

    turn(form.editors["max_cuts"])
    turn(form.editors["weights"])
    assert AllKinds(**form.values()) == AllKinds()
    form.editors["max_cuts"].setFocus()
    turn(form.editors["max_cuts"])
    assert form.values()["max_cuts"] == 31


@dataclass(frozen=True)
class WithSuggestions(Parametrised):
    """A text for which values are offered."""

    target: str = parameter("auto", suggestions=("auto", "ideal"), help="A name, or a formula.")


def test_a_text_with_suggestions_can_be_chosen_and_written(shown):
    form = shown(ParameterForm(declared(WithSuggestions)))
    editor, changes = form.editors["target"], []
    form.changed.connect(lambda: changes.append(form.values()["target"]))
    assert form.values() == {"target": "auto"}
    form.set_values({"target": "0.1 + x"})
    assert (form.values(), changes) == ({"target": "0.1 + x"}, [])
    type_text(editor.lineEdit(), "2*x")
    assert (form.values(), changes[-1]) == ({"target": "2*x"}, "2*x")
    editor.setCurrentIndex(editor.findText("ideal"))
    editor.activated.emit(editor.currentIndex())
    assert (form.values(), changes[-1]) == ({"target": "ideal"}, "ideal")


def test_choices_have_their_declared_titles_and_a_word_stands_for_a_number(shown):
    form = shown(ParameterForm(declared(METHODS["mend"])))
    goal, p = form.editors["goal"], form.editors["p"]
    assert goal.currentText() == "Balanced"
    assert [goal.itemData(at) for at in range(goal.count())][:2] == ["balanced", "shape"]
    assert goal.itemText(2) == "Minimum scaled Jacobian"
    assert p.value() == "auto"
    assert p.lineEdit().text() == "auto"
    type_into(p, "2")
    assert form.values()["p"] == 2
    type_into(p, "auto")
    assert form.values()["p"] == "auto"
    assert form.problems() == {}


# Advanced parameters


@dataclass(frozen=True)
class Mixed(Parametrised):
    """Basic and advanced parameters."""

    c1: float = parameter(0.1, low=0, high=1, help="Share of the slope.", advanced=True)
    goal: str = parameter("shape", choices=("shape", "time-step"), help="Aim.")
    backtracks: int = parameter(30, low=1, help="Limit.", advanced=True)


def shown_names(form):
    return [name for name, editor in form.editors.items() if editor.isVisible()]


def test_advanced_parameters_are_shown_on_request_below_the_basic_ones(shown):
    form = shown(ParameterForm(declared(Mixed)))
    assert shown_names(form) == ["goal"]
    low = form.sizeHint().height()
    QTest.mouseClick(named(form, QToolButton, "Advanced"), _LEFT)
    assert shown_names(form) == ["goal", "c1", "backtracks"]
    assert form.sizeHint().height() > low + 40
    QTest.mouseClick(named(form, QToolButton, "Advanced"), _LEFT)
    assert shown_names(form) == ["goal"]
    QApplication.processEvents()
    assert form.sizeHint().height() == low


# Rows of joined buttons, used by keyboard.


@pytest.fixture
def between(shown):
    """Three joined buttons between two text fields."""
    widget = QWidget()
    column = QVBoxLayout(widget)
    widget.before, widget.after = QLineEdit(), QLineEdit()
    widget.choice = Segmented("Size", [(key, key.title(), f"{key}.") for key in ("small", "middle", "large")])
    for part in (widget.before, widget.choice, widget.after):
        column.addWidget(part)
    return shown(widget)


@pytest.mark.parametrize("chosen", ["small", "middle", "large"])
@pytest.mark.parametrize("back", [False, True], ids=["Tab", "Shift+Tab"])
def test_tab_reaches_only_the_checked_button_from_either_side(between, chosen, back):
    between.choice.set_value(chosen)
    first, last = (between.after, between.before) if back else (between.before, between.after)
    first.setFocus()
    key = Qt.Key.Key_Backtab if back else Qt.Key.Key_Tab
    QTest.keyClick(first, key)
    assert QApplication.focusWidget() is between.choice.button(chosen)
    QTest.keyClick(QApplication.focusWidget(), key)
    assert QApplication.focusWidget() is last


def test_arrow_keys_check_buttons(between, qtbot):
    between.before.setFocus()
    QTest.keyClick(between.before, Qt.Key.Key_Tab)
    with qtbot.waitSignal(between.choice.chosen) as told:
        QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_Right)
    assert told.args == ["middle"]
    assert between.choice.value() == "middle"
    assert between.choice.button("middle").hasFocus()


# Stepping of boxes for numbers.


_BOUNDED = Parameter("delta", float, 0.01, 0.0, 10.0, None, "", "")


@given(start=st.floats(0, 10), steps=st.lists(st.integers(-12, 12), max_size=6))
def test_stepping_stays_in_bounds_and_has_the_right_sign(qapp, start, steps):
    box = NumberBox(_BOUNDED)
    box.set_value(start)
    for step in steps:
        before = box.value()
        box.stepBy(step)
        assert 0 <= box.value() <= 10
        assert (box.value() - before) * step >= 0


def test_stepping_down_from_one_passes_through_tenths(qapp):
    box = NumberBox(_BOUNDED)
    box.set_value(1.0)
    box.stepBy(-1)
    assert box.value() == 0.9
    box.stepBy(1)
    assert box.value() == 1.0


def test_the_step_after_the_upper_bound_is_no_limit(qapp):
    box = NumberBox(Parameter("room", float, 0.3, 0.0, 10.0, None, "", "", "unlimited"))
    box.set_value(9.0)
    box.stepBy(3)
    assert box.value() == box.text() == "unlimited"
    assert not box.stepEnabled() & QAbstractSpinBox.StepEnabledFlag.StepUpEnabled
    box.stepBy(-1)
    assert box.value() == 10
    type_text(box.lineEdit(), "unlimited")
    assert (box.value(), box.problem) == ("unlimited", "")
    type_text(box.lineEdit(), "none")
    assert "or unlimited" in box.problem


def test_a_number_left_to_the_program_is_below_all_numbers(qapp):
    declaration = Parameter(
        "room", float, "auto", 0.0, 10.0, None, "", "", "unlimited", automatic="auto", percent_of="diagonal"
    )
    box = NumberBox(declaration)
    assert box.value() == box.text() == "auto"
    box.stepBy(-1)
    assert box.value() == "auto"
    box.stepBy(1)
    assert box.value() == 0.0
    box.stepBy(-1)
    assert box.value() == "auto"
    type_text(box.lineEdit(), "0.5 %")
    assert (box.value(), box.problem) == ("0.5%", "")
    box.stepBy(1)
    assert box.value() == box.text() == "0.6%"
    type_text(box.lineEdit(), "101%")
    assert "a percentage such as 0.5%" in box.problem
