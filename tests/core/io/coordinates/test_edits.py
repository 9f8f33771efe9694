"""Parts of a text are replaced, whatever their number, place and length."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.io.coordinates.edits import Edits, edited
from hexmend.io.coordinates.text_coordinates import number_texts, parse_fields


@given(st.data())
def test_parts_are_replaced_as_by_a_loop(data):
    text = data.draw(st.binary(max_size=60))
    places = sorted(data.draw(st.lists(st.integers(0, len(text)), max_size=12)))
    begin, end = places[: len(places) // 2 * 2 : 2], places[1::2]
    words = [data.draw(st.sampled_from([b"", b"7", b"-1.25", b"3.0000000001"])) for _ in begin]
    expected, at = b"", 0
    for first, last, word in zip(begin, end, words, strict=True):
        expected, at = expected + text[at:first] + word, last
    edits = Edits(np.array(begin, np.int64), np.array(end, np.int64), words)
    assert b"".join(edited(text, edits)) == expected + text[at:]


@given(st.lists(st.floats(allow_nan=False, allow_infinity=False), max_size=20))
def test_numbers_are_read_back_as_they_were_unless_a_width_limits_them(values):
    array = np.array(values)
    assert [float(word) for word in number_texts(array)] == values
    words = number_texts(array, width=20)
    assert all(len(word) <= 20 for word in words)
    np.testing.assert_allclose([float(word) for word in words], array, rtol=1e-12)


@pytest.mark.parametrize("end", ["\n", ""])
def test_fields_are_parsed_as_numbers_and_blank_ones_as_zero(end):
    text = f"1, 2.5, -1D3,, 1e-3{end}".encode()
    begin, end = np.array([0, 3, 8, 13, 15]), np.array([1, 6, 12, 13, 19])
    np.testing.assert_array_equal(parse_fields(text, begin, end), [1, 2.5, -1000, 0, 0.001])


@pytest.mark.parametrize("text", [b"1 2,", b"one,", b"1-2,"])
def test_fields_that_are_no_numbers_are_none(text):
    assert parse_fields(text, np.array([0]), np.array([len(text) - 1])) is None
