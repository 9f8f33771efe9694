"""The mesh and the view, saved from the window."""

from __future__ import annotations

import numpy as np
import pytest
from PIL import Image
from PySide6.QtCore import Qt

from hexmend import io
from hexmend_app.state.run import Phase
from tests.app.driving import key, phase
from tests.patience import PATIENCE


def test_saving_writes_the_mesh_as_it_is_now(window, qtbot, tmp_path):
    key(window, Qt.Key.Key_F10)
    qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)
    window.session.smoothing.stop()
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    window.refresh()
    assert window.isWindowModified()
    assert window.features["save"].mesh(tmp_path / "out.vtk")
    np.testing.assert_array_equal(io.read(tmp_path / "out.vtk").points, window.session.document.now.mesh.points)
    window.refresh()
    assert not window.isWindowModified()
    assert not window.features["save"].mesh(tmp_path / "missing" / "out.vtk")
    assert window.messages.messages()[-1][0] == "error"


@pytest.mark.parametrize("size", [(640, 480), (1500, 500)])
def test_a_picture_has_the_size_asked_for_whatever_the_window(window, tmp_path, size):
    window.action("cut").trigger()
    window.refresh()
    assert window.features["save"].picture(tmp_path / "view.png", size)
    image = Image.open(tmp_path / "view.png")
    assert image.size == size
    colourful = np.ptp(np.asarray(image.convert("RGB")).astype(int), axis=2) > 60
    assert colourful.mean() > 0.05
