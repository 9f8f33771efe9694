"""The widget that VTK draws in."""

from __future__ import annotations

import ctypes
import sys

import vtkmodules.vtkRenderingFreeType  # noqa: F401  brings what VTK writes with
from PySide6.QtCore import QEvent, Qt, QTimer
from PySide6.QtGui import QGuiApplication, QMouseEvent, QOpenGLContext, QWheelEvent
from PySide6.QtOpenGLWidgets import QOpenGLWidget
from PySide6.QtWidgets import QSizePolicy, QWidget
from vtkmodules.vtkInteractionStyle import vtkInteractorStyleTrackballCamera
from vtkmodules.vtkRenderingOpenGL2 import vtkGenericOpenGLRenderWindow
from vtkmodules.vtkRenderingUI import vtkGenericRenderWindowInteractor

from hexmend_app.widgets.opengl import choose_format

_DRAW_FRAMEBUFFER, _COLOUR = 0x8CA9, 0x8CE0  # GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0
_SCISSORS, _DEPTH_TEST = 0x0C11, 0x0B71  # GL_SCISSOR_TEST, GL_DEPTH_TEST
_NOT_BEYOND, _LINEAR = 0x0203, 0x2601  # GL_LEQUAL, GL_LINEAR
_COLOURS = 0x00004000  # GL_COLOR_BUFFER_BIT

#: Units of a wheel's step.
_STEP = 120

#: VTK's cursors that are not the arrow.
_CURSORS = {
    2: Qt.CursorShape.SizeBDiagCursor,
    3: Qt.CursorShape.SizeFDiagCursor,
    4: Qt.CursorShape.SizeBDiagCursor,
    5: Qt.CursorShape.SizeFDiagCursor,
    6: Qt.CursorShape.SizeVerCursor,
    7: Qt.CursorShape.SizeHorCursor,
    8: Qt.CursorShape.SizeAllCursor,
    9: Qt.CursorShape.PointingHandCursor,
    10: Qt.CursorShape.CrossCursor,
}

#: What VTK calls the buttons.
_BUTTONS = {
    Qt.MouseButton.LeftButton: "LeftButton",
    Qt.MouseButton.RightButton: "RightButton",
    Qt.MouseButton.MiddleButton: "MiddleButton",
}


class RenderWidget(QOpenGLWidget):
    """Shows what VTK renders into a Qt framebuffer, and passes mouse events on.

    It does what VTK's `QVTKOpenGLNativeWidget` does in C++: without a window of the system's, so that other widgets can
    lie over it, and Wayland knows it. It renders as Qt paints it, and at no other time: a wish of VTK's to render asks
    Qt to paint, and several make one frame.

    Attributes
    ----------
    render_window : vtkGenericOpenGLRenderWindow
    iren : vtkGenericRenderWindowInteractor
        Its own: the left button turns the camera, with Shift it shifts, the right one and the wheel zoom.
    """

    def __init__(self, parent: QWidget | None = None):
        choose_format()
        super().__init__(parent)
        self.setUpdateBehavior(QOpenGLWidget.UpdateBehavior.NoPartialUpdate)
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.WheelFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self._drawn_on: QOpenGLContext | None = None
        self._painting = False
        self._turned = 0  # of the wheel, since its last whole step
        window = self.render_window = vtkGenericOpenGLRenderWindow()
        window.SetReadyForRendering(False)
        window.SetFrameBlitModeToNoBlit()
        iren = self.iren = vtkGenericRenderWindowInteractor()
        iren.SetRenderWindow(window)
        iren.SetInteractorStyle(vtkInteractorStyleTrackballCamera())
        iren.EnableRenderOff()
        iren.Initialize()
        self._report = [
            (of, of.AddObserver(event, act))
            for of, event, act in (
                (window, "WindowMakeCurrentEvent", self._make_current),
                (window, "WindowIsCurrentEvent", self._tell_current),
                (window, "WindowFrameEvent", self._ask_for_frame),
                (window, "CursorChangedEvent", lambda *_: QTimer.singleShot(0, self, self._show_cursor)),
                (iren, "RenderEvent", self._ask_for_frame),
            )
        ]

    # OpenGL

    def _make_current(self, *_: object) -> None:
        """Let VTK draw; Qt's own `makeCurrent` would change the buffer that it draws into, too."""
        if self._drawn_on is not None:
            self._drawn_on.makeCurrent(self._drawn_on.surface())

    def _tell_current(self, *_: object) -> None:
        current = QOpenGLContext.currentContext()
        self.render_window.SetIsCurrent(self._drawn_on is not None and current is self._drawn_on)

    def _ask_for_frame(self, *_: object) -> None:
        if not self._painting:
            self.update()

    def initializeGL(self) -> None:
        """Let VTK draw with what Qt has prepared."""
        self._drawn_on = self.context()
        self._drawn_on.aboutToBeDestroyed.connect(self._let_go_of_graphics)
        window = self.render_window
        if sys.platform.startswith("linux"):
            window.SetOpenGLSymbolLoader2(_loader(), 0)
        window.OpenGLInitContext()
        window.OpenGLInit()
        state = window.GetState()
        state.Reset()
        state.vtkglDepthFunc(_NOT_BEYOND)  # Qt leaves it at less
        state.vtkglEnable(_DEPTH_TEST)
        window.SetForceMaximumHardwareLineWidth(1)
        window.SetReadyForRendering(True)
        window.SetOwnContext(0)

    def resizeGL(self, width: int, height: int) -> None:
        """Resize the render window, in device pixels."""
        self.iren.UpdateSize(*self._pixels)
        self.iren.InvokeEvent("ConfigureEvent")
        self.render_window.SetDPI(round(72 * self.devicePixelRatioF()))

    @property
    def _pixels(self) -> tuple[int, int]:
        ratio = self.devicePixelRatioF()
        return max(1, round(self.width() * ratio)), max(1, round(self.height() * ratio))

    def paintGL(self) -> None:
        """Render, and copy the picture to the framebuffer of Qt."""
        window = self.render_window
        if not window.GetReadyForRendering():
            return
        state = window.GetState()
        state.Reset()  # Qt has drawn since
        state.Push()
        state.vtkglDepthFunc(_NOT_BEYOND)
        self._painting = True
        try:
            window.Render()
        finally:
            self._painting = False
        self.makeCurrent()
        self._copy()
        state.Pop()

    def _copy(self) -> None:
        """Copy the rendered picture with full opacity: a translucent one would show what is behind the window."""
        window, pixels = self.render_window, self._pixels
        gl = self._drawn_on.extraFunctions()
        gl.glBindFramebuffer(_DRAW_FRAMEBUFFER, self.defaultFramebufferObject())
        gl.glDrawBuffers(1, [_COLOUR])
        cut = gl.glIsEnabled(_SCISSORS)
        if cut:
            window.GetState().vtkglDisable(_SCISSORS)
            gl.glDisable(_SCISSORS)
        window.BlitDisplayFramebuffer(0, 0, 0, *window.GetSize(), 0, 0, *pixels, _COLOURS, _LINEAR)
        gl.glColorMask(False, False, False, True)
        gl.glClearColor(0.0, 0.0, 0.0, 1.0)
        gl.glViewport(0, 0, *pixels)
        gl.glClear(_COLOURS)
        gl.glColorMask(True, True, True, True)
        if cut:
            window.GetState().vtkglEnable(_SCISSORS)
            gl.glEnable(_SCISSORS)

    def _let_go_of_graphics(self) -> None:
        self._make_current()
        self._end()
        self.forget_context()

    def _end(self) -> None:
        self.render_window.Finalize()
        self.render_window.SetReadyForRendering(False)

    def forget_context(self) -> None:
        """Stop drawing on a destroyed context."""
        self._drawn_on = None

    def let_go(self) -> None:
        """End drawing for good, while the window still exists."""
        self._end()
        for of, observer in self._report:
            of.RemoveObserver(observer)
        self._report.clear()

    # The mouse

    def _tell_place(self, event: QMouseEvent, repeat: int = 0) -> None:
        """Pass the pointer position, in device pixels from below, and pressed modifiers to VTK."""
        ratio, place, keys = self.devicePixelRatioF(), event.position(), event.modifiers()
        self.iren.SetEventInformation(
            round(place.x() * ratio),
            round((self.height() - place.y() - 1) * ratio),
            bool(keys & Qt.KeyboardModifier.ControlModifier),
            bool(keys & Qt.KeyboardModifier.ShiftModifier),
            "\0",
            repeat,
            None,
        )

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Begin to move the camera, or to drag a handle."""
        self._tell_place(event, int(event.type() == QEvent.Type.MouseButtonDblClick))
        if event.button() in _BUTTONS:
            self.iren.InvokeEvent(f"{_BUTTONS[event.button()]}PressEvent")

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """End the drag."""
        self._tell_place(event)
        if event.button() in _BUTTONS:
            self.iren.InvokeEvent(f"{_BUTTONS[event.button()]}ReleaseEvent")

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Continue the drag."""
        self._tell_place(event)
        self.iren.MouseMoveEvent()

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Zoom by whole steps."""
        self._turned += event.angleDelta().y()
        zoom = self.iren.MouseWheelForwardEvent if self._turned > 0 else self.iren.MouseWheelBackwardEvent
        for _ in range(abs(self._turned) // _STEP):
            zoom()
        self._turned -= int(self._turned / _STEP) * _STEP

    def _show_cursor(self) -> None:
        self.setCursor(_CURSORS.get(self.render_window.GetCurrentCursor(), Qt.CursorShape.ArrowCursor))


def _loader() -> int:
    """Return the address of the loader of OpenGL functions on Linux."""
    wayland = QGuiApplication.platformName().startswith("wayland")
    library, name = ("libEGL.so.1", "eglGetProcAddress") if wayland else ("libGL.so.1", "glXGetProcAddressARB")
    return ctypes.cast(getattr(ctypes.CDLL(library), name), ctypes.c_void_p).value
