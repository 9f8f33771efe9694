"""Captions of views: each at the top of its view, in one or two rows."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QPoint, QRect
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QToolButton, QWidget

from hexmend_app.canvas.view_captions import HEIGHT, Caption, CaptionRow
from hexmend_app.canvas.view_frame import ViewFrame
from hexmend_app.scene.views.arrangement import grid
from tests.app.driving import LEFT
from tests.patience import PATIENCE


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


def entries(view):
    """Return the rectangle of each caption in the view, by its name."""
    found = {}
    for row in view.findChildren(CaptionRow):
        for part in row.findChildren(QWidget):
            name = part.accessibleName().partition(":")[0]
            if name.startswith("view") and part.isVisible():
                found[name] = QRect(part.mapTo(view, QPoint(0, 0)), part.size())
    return found


def test_captions_show_the_counts_of_each_view_first(framed):
    framed.frame.set_captions(captions(2), None)
    counts = ((("newly invalid", 1200), ("mended", 0)), (("newly invalid", 0), ("mended", 0)))
    pairs = zip(framed.frame.captions, counts, strict=True)
    framed.frame.change_captions([replace(caption, counts=own) for caption, own in pairs])
    texts = [caption.figures for caption in framed.frame.captions]
    assert texts == ["1,200 newly invalid · q min 0.5000", "none invalid · q min 0.5000"]
    assert Caption("view", 0.5, 3, 3, None).figures == "3 inverted · q min 0.5000"
    assert Caption("view", 0.5, 3, 5, None).figures == "3 inverted · 2 invalid inside · q min 0.5000"


@pytest.mark.parametrize("count", [1, 2, 3, 4])
def test_each_caption_is_at_the_top_of_its_view(framed, qtbot, count):
    frame, view, size = framed.frame, framed.view, framed.view.size()
    frame.set_captions(captions(count), None)
    assert view.size() == size  # captions use the space that the views reserve
    found = entries(view)
    if count == 1:
        assert found == {}
        return
    for k, (left, _, right, high) in enumerate(grid(count)):
        place = found[f"view {k}"]
        assert place.top() == round((1 - high) * view.height())
        assert place.height() == HEIGHT
        assert abs(place.left() - left * view.width()) <= 1
        assert abs(place.right() + 1 - right * view.width()) <= 1


def test_a_close_button_in_the_lower_row_closes_its_view(framed, qtbot):
    frame, view = framed.frame, framed.view
    frame.set_captions(captions(4), None)
    cross = next(one for one in view.findChildren(QToolButton) if one.accessibleName() == "Close the view of view 2")
    with qtbot.waitSignal(frame.view_closed, timeout=PATIENCE) as closed:
        QTest.mouseClick(cross, LEFT)
    assert closed.args == [2]
