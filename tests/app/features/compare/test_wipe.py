"""The wipe: two results in one view with an edge to drag."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from hexmend_app.canvas.wipe_handle import WipeHandle
from hexmend_app.features.compare.comparison_table import VIEW, title_of
from hexmend_app.features.side_views.feature import STEP
from tests.app.driving import drag, key
from tests.app.features.compare.table import captions, tick

pytestmark = pytest.mark.slow


def test_the_wipe_is_switched_and_moved_by_mouse_and_keys(compared, qtbot):
    tick(compared, "getme", VIEW)
    tick(compared, "laplacian", VIEW)
    key(compared, Qt.Key.Key_W)
    wipe, handle = compared.session.side_views.wipe, compared.findChild(WipeHandle)
    assert (wipe.left, wipe.right, wipe.at) == (0, 2, 0.5)
    assert handle.isVisible()
    assert captions(compared) == []
    width = compared.canvas.interactor.width()
    knob = handle.rect().center()
    drag(handle, knob, knob + QPoint(-width // 5, 0), steps=1)
    assert compared.session.side_views.wipe.at == pytest.approx(0.3, abs=0.01)
    assert handle.geometry().center().x() == pytest.approx(0.3 * width, abs=3)
    at = compared.session.side_views.wipe.at
    key(compared, Qt.Key.Key_BracketRight)
    key(compared, Qt.Key.Key_BracketRight)
    key(compared, Qt.Key.Key_BracketLeft)
    assert compared.session.side_views.wipe.at == pytest.approx(at + STEP)
    handle.setFocus()
    QTest.keyClick(handle, Qt.Key.Key_Left)
    compared.refresh()
    assert compared.session.side_views.wipe.at == pytest.approx(at)
    for _ in range(60):
        QTest.keyClick(handle, Qt.Key.Key_Left)
    compared.refresh()
    assert 0 < compared.session.side_views.wipe.at < 0.05
    key(compared, Qt.Key.Key_W)
    assert captions(compared) == ["now", title_of("getme"), title_of("laplacian")]
    assert not handle.isVisible()
