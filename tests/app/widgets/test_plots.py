"""Tick texts that have a colour of their own stay clear of the other ones."""

import pytest
from PySide6.QtCore import QRectF

from hexmend_app.widgets.plots import left_of_next


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
