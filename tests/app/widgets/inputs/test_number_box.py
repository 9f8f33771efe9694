"""Stepping of boxes for numbers."""

from hypothesis import given
from hypothesis import strategies as st
from PySide6.QtWidgets import QAbstractSpinBox

from hexmend.parameters import Parameter
from hexmend_app.widgets.inputs.number_box import NumberBox
from tests.app.driving import type_text

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
