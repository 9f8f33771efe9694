"""3D view as a widget: mouse, keys and history of camera poses."""

from dataclasses import replace

import numpy as np
import pytest
import shiboken6
from hypothesis import assume, given
from hypothesis import strategies as st
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QImage, QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QWidget

from hexmend.quality import measure
from hexmend_app.canvas.canvas import Canvas
from hexmend_app.canvas.colour_bar import ColourBar
from hexmend_app.canvas.view_captions import Caption
from hexmend_app.canvas.view_frame import ViewFrame
from hexmend_app.scene.camera.vtk_pose import pose_of
from hexmend_app.scene.colour.colouring import Colouring, SpecialColour
from hexmend_app.scene.geometry.frame import Frame
from tests.app.driving import LEFT, heard_from, turn
from tests.core.grids import grid

MESH = grid(4)
FIGURES = measure(MESH.points, MESH.hexes)
RIGHT = Qt.MouseButton.RightButton

#: Canvases of finished tests; collecting them would release graphics resources of VTK that are in use.
CLOSED = []


@pytest.fixture
def canvas(qtbot):
    canvas = Canvas()
    canvas.resize(600, 500)
    with qtbot.waitExposed(canvas):
        canvas.show()
    canvas.draw(Frame(MESH, FIGURES))
    rested(qtbot, canvas)
    yield canvas
    canvas.close()
    CLOSED.append(canvas)
    shiboken6.invalidate(canvas.windowHandle())
    canvas.deleteLater()
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    canvas.interactor.forget_context()


def pose(canvas):
    return pose_of(canvas.viewport.camera)


def rested(qtbot, canvas):
    """Wait until the camera is at rest, and draw a frame."""
    qtbot.waitUntil(lambda: canvas.camera_animation.at_rest)
    canvas.interactor.grabFramebuffer()


def middle(canvas):
    return canvas.interactor.rect().center()


def double_click(canvas, place):
    """Send the events of a double click."""
    view = canvas.interactor
    QTest.mouseClick(view, LEFT, pos=place)
    QTest.mouseDClick(view, LEFT, pos=place)
    QTest.mouseRelease(view, LEFT, pos=place)


def test_an_unbound_key_does_not_end_a_flight(canvas, qtbot):
    canvas.fly_to(0)
    QTest.keyClick(canvas.interactor, Qt.Key.Key_N)
    assert canvas.camera_animation.active
    QTest.keyClick(canvas.interactor, Qt.Key.Key_Left)
    assert not canvas.camera_animation.active


@pytest.mark.slow
def test_the_camera_returns_to_the_bookmarked_pose(canvas, qtbot):
    home = pose(canvas)
    for h in (3, 60):  # from one to the next
        canvas.camera_animation.remember()
        canvas.fly_to(h)
        rested(qtbot, canvas)
    canvas.camera_animation.fly_to_bookmark()
    assert canvas.camera_animation.active
    rested(qtbot, canvas)
    assert pose(canvas).looks_like(home)
    canvas.look_along("+z")
    canvas.camera_animation.fly_to_bookmark()  # there is nothing to return to
    assert not canvas.camera_animation.active


@pytest.mark.slow
def test_a_double_click_sets_the_centre_of_rotation(canvas, qtbot):
    clicks = heard_from(canvas.clicked)
    before = pose(canvas)
    place = middle(canvas) + QPoint(60, 20)
    double_click(canvas, place)
    qtbot.waitUntil(lambda: canvas.camera_animation.active)
    rested(qtbot, canvas)
    after = pose(canvas)
    assert len(clicks) == 1  # the first click selects
    focal = np.array(after.focal)
    on = np.isclose(focal, 0, atol=1e-6) | np.isclose(focal, 4, atol=1e-6)
    assert on.any()  # on the skin
    assert not np.allclose(focal, before.focal)
    assert after.distance == pytest.approx(before.distance)
    hit = canvas.panes.pick(*(canvas.interactor.width() / 2, canvas.interactor.height() / 2))
    np.testing.assert_allclose(hit.place, focal, atol=0.05)
    double_click(canvas, QPoint(3, 3))  # beside the mesh
    rested(qtbot, canvas)
    assert pose(canvas).looks_like(after)


def test_two_clicks_with_ctrl_dig_twice(canvas):
    dug = heard_from(canvas.hide_clicked)
    view, ctrl = canvas.interactor, Qt.KeyboardModifier.ControlModifier
    QTest.mouseClick(view, LEFT, ctrl, middle(canvas))
    at = QPointF(middle(canvas))
    for kind in (QEvent.Type.MouseButtonDblClick, QEvent.Type.MouseButtonRelease):
        QApplication.sendEvent(view, QMouseEvent(kind, at, view.mapToGlobal(at), LEFT, LEFT, ctrl))
    assert len(dug) == 2
    assert not canvas.camera_animation.active


def test_a_right_click_requests_a_menu_and_a_right_drag_zooms(canvas, qtbot):
    asked, clicks = [], []
    canvas.menu_requested.connect(lambda hit, place: asked.append((hit, place)))
    canvas.clicked.connect(clicks.append)
    view, at = canvas.interactor, middle(canvas)
    before = pose(canvas)
    QTest.mouseClick(view, RIGHT, pos=at)
    qtbot.waitUntil(lambda: len(asked) == 1)
    (h, node), place = asked[0]
    assert node in MESH.hexes[h]
    assert place == view.mapToGlobal(at)
    QTest.mouseClick(view, RIGHT, pos=QPoint(3, 3))
    qtbot.waitUntil(lambda: len(asked) == 2)
    assert asked[1][0] is None
    assert pose(canvas).looks_like(before)
    QTest.mousePress(view, RIGHT, pos=at)
    for k in range(1, 9):
        QTest.mouseMove(view, at + QPoint(0, 10 * k))
    QTest.mouseRelease(view, RIGHT, pos=at + QPoint(0, 80))
    assert pose(canvas).distance != pytest.approx(before.distance, rel=0.05)
    QTest.keyClick(view, Qt.Key.Key_Menu)
    assert len(asked) == 3  # the drag asked for none
    assert not clicks


def test_a_menu_may_block(canvas, qtbot):
    """A receiver of the signal may run an event loop, because VTK has handled the release of the button."""
    before = pose(canvas)
    moved = []

    def wait(hit, place):
        for k in range(1, 6):
            QTest.mouseMove(canvas.interactor, middle(canvas) + QPoint(0, 15 * k))
        QApplication.processEvents()
        moved.append(pose(canvas))

    canvas.menu_requested.connect(wait)
    QTest.mouseClick(canvas.interactor, RIGHT, pos=middle(canvas))
    qtbot.waitUntil(lambda: len(moved) == 1)
    assert moved[0].looks_like(before)


@pytest.mark.parametrize("views", [2, 3, 4])
def test_the_colour_bar_covers_none_of_several_views(canvas, views):
    canvas.resize(900, 600)
    canvas.show_side_by_side([(MESH, FIGURES)] * (views - 1))
    turn()
    for view in canvas.panes.all:
        right = view.layers[0].GetViewport()[2] * canvas.interactor.width()
        assert canvas.colour_bar.geometry().left() >= right
    canvas.show_side_by_side([])
    assert canvas.viewport.layers[0].GetViewport() == (0.0, 0.0, 1.0, 1.0)


# Colour bar, checked by its pixels.


@pytest.fixture
def ramp():
    """A colour table in which each entry encodes its row number."""
    k = np.arange(256, dtype=np.uint8)
    return np.column_stack([k, 255 - k, np.full(256, 60, np.uint8)])


def pixels(widget):
    # Not grab(): its pixels have the screen's depth, which may be 16 bits.
    image = QImage(widget.size(), QImage.Format.Format_RGB32)
    widget.render(image)
    return np.array(
        [[image.pixelColor(x, y).getRgb()[:3] for x in range(image.width())] for y in range(image.height())]
    )


def test_the_gradient_shows_the_whole_table_in_order(shown, ramp):
    bar = ColourBar()
    bar.show_colouring(Colouring("q(H)", 0.0, 1.0, ramp))
    shown(bar, 90, 500)
    rgb = pixels(bar)
    of_table = (rgb[..., 2] == 60) & (rgb[..., 0].astype(int) + rgb[..., 1] == 255)
    along = [rgb[y, of_table[y], 0].max() for y in range(rgb.shape[0]) if of_table[y].sum() > 5][::-1]
    assert len(along) > 250
    assert np.all(np.diff(np.array(along, dtype=int)) >= 0)
    assert along[0] <= 2
    assert along[-1] >= 253


@pytest.mark.slow
@pytest.mark.usefixtures("qapp")
@given(st.floats(-1e7, 1e7), st.floats(-1e7, 1e7), st.floats(10, 2000))
def test_ticks_include_both_ends_and_labels_do_not_overlap(low, high, length):
    assume(high - low > 1e-6 * max(abs(low), abs(high), 1e-3))
    bar = ColourBar()
    bar.show_colouring(Colouring("q(H)", low, high, np.zeros((256, 3), np.uint8)))
    ticks = bar.ticks(length)
    assert (ticks[0], ticks[-1]) == (low, high)
    if len(ticks) > 2:
        assert np.diff(ticks).min() / (high - low) * length >= 1.9 * bar.fontMetrics().height()


KINDS = tuple(
    SpecialColour(name, colour)
    for name, colour in (
        ("newly invalid", (0x12, 0xAB, 0x34)),
        ("still invalid", (0xAB, 0x12, 0x34)),
        ("mended", (0x34, 0x12, 0xAB)),
    )
)


def test_each_special_colour_has_a_swatch_below_the_gradient(shown, ramp):
    bar = ColourBar()
    bar.show_colouring(Colouring("q(H)", -0.25, 0.25, ramp, KINDS), [3, 0, 12])
    shown(bar, 130)
    rgb = pixels(bar)
    for special in KINDS:
        assert (rgb == special.colour).all(axis=2).sum() > 80
    assert bar.accessibleDescription() == ("newly invalid (3); still invalid; mended (12); q(H) from −0.25 to 0.25")
    bar.show_colouring(Colouring("q(H)", -0.25, 0.25, ramp, KINDS[2:]), [12])
    assert bar.accessibleDescription().startswith("mended (12); q(H)")
    assert [one.isVisible() for one in bar.swatches] == [True, False, False]


def test_a_swatch_can_be_clicked_by_mouse_and_keys_unless_its_count_is_zero(shown, ramp):
    bar = ColourBar()
    bar.show_colouring(Colouring("q(H)", 0.0, 1.0, ramp, KINDS[:2]), [3, 0])
    shown(bar, 130)
    asked = heard_from(bar.special_clicked)
    for swatch in bar.swatches:
        QTest.mouseClick(swatch, Qt.MouseButton.LeftButton)
    assert asked == ["newly invalid"]
    bar.swatches[0].setFocus()
    QTest.keyClick(bar.swatches[0], Qt.Key.Key_Space)
    assert asked == ["newly invalid"] * 2
    assert not bar.swatches[1].isEnabled()


# Captions of views.


def test_captions_show_the_counts_of_each_view_first(shown):
    widget, frame = QWidget(), ViewFrame(QWidget())
    widget.setLayout(frame)
    shown(widget, 801, 603)
    frame.set_captions([Caption(f"view {k}", 0.5, 0, 0, None) for k in range(2)], None)
    counts = ((("newly invalid", 1200), ("mended", 0)), (("newly invalid", 0), ("mended", 0)))
    pairs = zip(frame.captions, counts, strict=True)
    frame.change_captions([replace(caption, counts=own) for caption, own in pairs])
    texts = [caption.figures for caption in frame.captions]
    assert texts == ["1,200 newly invalid · q min 0.5000", "none invalid · q min 0.5000"]
    assert Caption("view", 0.5, 3, 3, None).figures == "3 inverted · q min 0.5000"
    assert Caption("view", 0.5, 3, 5, None).figures == "3 inverted · 2 invalid inside · q min 0.5000"
