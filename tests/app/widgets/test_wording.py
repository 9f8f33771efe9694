"""Texts of numbers and names."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from PySide6.QtCore import QRectF

from hexmend_app.widgets.plots import left_of_next
from hexmend_app.widgets.wording import figure, name_in_words, short_number


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_a_short_number_is_parsed_as_the_same_value(value):
    assert float(short_number(value)) == value


@given(st.floats(min_value=-1e15, max_value=1e15))
def test_a_figure_is_close_to_its_value_and_fits_its_column(value):
    text = figure(value)
    assert float(text.replace(",", "").replace("−", "-")) == pytest.approx(value, rel=1e-3, abs=5.1e-5)
    assert len(text) <= 14


@given(st.from_regex(r"[a-z]+(_[a-z]+)*", fullmatch=True))
def test_a_name_in_words_has_no_underscores_and_keeps_its_letters(name):
    words = name_in_words(name)
    assert "_" not in words
    assert words.lower().startswith(name.replace("_", " "))


def test_a_value_that_is_not_finite_is_a_dash():
    assert figure(None) == figure(float("inf")) == figure(float("nan")) == "–"


# Tick texts that have a colour of their own stay clear of the other ones.


@pytest.mark.parametrize(
    ("left", "others", "expected"),
    [
        (10.0, [(80.0, 8.0), (120.0, 8.0)], 10.0),  # room enough
        (40.0, [(80.0, 8.0), (120.0, 8.0)], 26.0),  # 50 wide: it would end at 90
        (40.0, [(120.0, 8.0), (80.0, 8.0)], 26.0),  # whatever their order
        (40.0, [(10.0, 8.0)], 40.0),  # a text on the left does not push it
        (40.0, [], 40.0),
    ],
)
def test_a_text_moves_to_the_left_of_the_next_one(left, others, expected):
    rect = left_of_next(QRectF(left, 3, 50, 12), [QRectF(at, 3, width, 12) for at, width in others])
    assert rect == QRectF(expected, 3, 50, 12)
