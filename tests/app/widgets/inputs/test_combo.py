"""Combo boxes in narrow panels."""

from __future__ import annotations

from hexmend_app.widgets.inputs.combo import ComboBox
from tests.app.theme.contrasts import painted

TEXT = "Local Newton, large patches and more"


def drawn(qtbot, text):
    box = ComboBox()
    qtbot.addWidget(box)
    box.addItem(text)
    box.setFixedSize(140, 24)
    box.show()
    return painted(box)


def test_a_long_text_is_elided(qtbot):
    metrics = ComboBox().fontMetrics()
    assert metrics.horizontalAdvance(TEXT) > 140
    shown = drawn(qtbot, TEXT)
    for letters in range(5, len(TEXT)):
        if (shown == drawn(qtbot, TEXT[:letters].rstrip() + "…")).all():
            break
    else:
        raise AssertionError("no beginning of the text with an ellipsis was drawn")


def test_the_list_is_as_wide_as_its_texts(qtbot):
    box = ComboBox()
    qtbot.addWidget(box)
    box.addItems([TEXT, "short"])
    box.setFixedSize(140, 24)
    box.show()
    box.showPopup()
    assert box.view().viewport().width() >= box.view().sizeHintForColumn(0) > 140
    box.hidePopup()
