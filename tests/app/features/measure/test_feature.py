"""Measuring in the window, by mouse and keys."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QPushButton

from hexmend_app.picture.appearance import Measurement
from tests.app.driving import key, named, press, seen_at

_STEPS = (0, 0), (2, 2), (-2, -2), (2, -2), (-2, 2)


@pytest.fixture
def strip(window):
    return window.features["measure"].strip


def boundary_nodes(window, count):
    """Return visible nodes of the boundary that are far apart, as the view shows the mesh."""
    canvas, mesh = window.canvas, window.session.document.now.mesh
    found = []
    for node in np.unique(mesh.topology.boundary_faces):
        place = mesh.points[node]
        at = seen_at(window, place)
        far = all((at - other).manhattanLength() > 60 for _, other in found)
        around = [at + QPoint(*step) for step in _STEPS] if far else ()
        hits = [canvas.viewport.pick(other.x(), canvas.interactor.height() - 1 - other.y()) for other in around]
        if hits and all(hit is not None and hit.node == node for hit in hits):
            found.append((place, at))
            if len(found) == count:
                return found
    raise AssertionError("there are too few visible nodes")


def click_at(window, at):
    QTest.mouseClick(window.canvas.interactor, Qt.MouseButton.LeftButton, pos=at)
    window.refresh()


@pytest.mark.slow
def test_two_clicks_measure_a_distance_a_third_an_angle_and_escape_ends(window, strip):
    key(window, Qt.Key.Key_R)
    QApplication.processEvents()
    window.canvas.draw_still()
    ends = boundary_nodes(window, 3)
    assert window.session.view.measuring
    assert "Click two points" in strip.text.text()
    for _, at in ends[:2]:
        click_at(window, at + QPoint(2, 2))
    points = np.array(window.session.view.look.measurement.points)
    np.testing.assert_allclose(points, [place for place, _ in ends[:2]], err_msg="a click close to a node takes it")
    assert window.session.selection.hex is None
    distance = np.linalg.norm(points[1] - points[0])
    assert f"{distance:.5g}" in strip.text.text()
    click_at(window, ends[2][1])
    assert "Angle at 2" in strip.text.text()
    press(named(strip, QPushButton, "Copy measurement"))
    copied = QApplication.clipboard().text()
    assert copied.startswith("Point 1")
    assert "Angle at 2" in copied
    key(window, Qt.Key.Key_Escape)
    assert not strip.isVisible()
    assert not window.session.view.measuring
    assert window.session.view.look.measurement == Measurement()
    click_at(window, ends[0][1])
    assert window.session.selection.hex is not None
