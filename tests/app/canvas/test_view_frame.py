"""Captions of views: each at the top of its view, in one or two rows."""

from dataclasses import replace

import pytest
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QToolButton, QWidget

from hexmend_app.canvas.view_captions import Caption
from hexmend_app.canvas.view_frame import ViewFrame
from tests.app.driving import LEFT


class Framed(QWidget):
    """A view in its frame."""

    def __init__(self):
        super().__init__()
        self.view = QWidget()
        self.frame = ViewFrame(self.view)
        self.setLayout(self.frame)


@pytest.fixture
def framed(shown):
    return shown(Framed(), 801, 603)


def captions(count):
    return [Caption(f"view {k}", 0.5, 0, 0, None) for k in range(count)]


def test_captions_show_the_counts_of_each_view_first(framed):
    framed.frame.set_captions(captions(2), None)
    counts = ((("newly invalid", 1200), ("mended", 0)), (("newly invalid", 0), ("mended", 0)))
    pairs = zip(framed.frame.captions, counts, strict=True)
    framed.frame.change_captions([replace(caption, counts=own) for caption, own in pairs])
    texts = [caption.figures for caption in framed.frame.captions]
    assert texts == ["1,200 newly invalid · q min 0.5000", "none invalid · q min 0.5000"]
    assert Caption("view", 0.5, 3, 3, None).figures == "3 inverted · q min 0.5000"
    assert Caption("view", 0.5, 3, 5, None).figures == "3 inverted · 2 invalid inside · q min 0.5000"


def test_a_close_button_in_the_lower_row_closes_its_view(framed, qtbot):
    frame, view = framed.frame, framed.view
    frame.set_captions(captions(4), None)
    cross = next(one for one in view.findChildren(QToolButton) if one.accessibleName() == "Close the view of view 2")
    with qtbot.waitSignal(frame.view_closed) as closed:
        QTest.mouseClick(cross, LEFT)
    assert closed.args == [2]
