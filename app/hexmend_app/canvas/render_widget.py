"""Widget that VTK draws into."""

from __future__ import annotations

import ctypes
import sys

import vtkmodules.vtkRenderingFreeType  # noqa: F401  registers the text renderer of VTK
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
_LESS_OR_EQUAL, _LINEAR = 0x0203, 0x2601  # GL_LEQUAL, GL_LINEAR
_COLOURS = 0x00004000  # GL_COLOR_BUFFER_BIT

#: Angle units of a step of the mouse wheel.
_STEP = 120

#: Qt cursors by number of the VTK cursor; all others are the arrow.
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

#: Names of the mouse buttons in VTK events.
_BUTTONS = {
    Qt.MouseButton.LeftButton: "LeftButton",
    Qt.MouseButton.RightButton: "RightButton",
    Qt.MouseButton.MiddleButton: "MiddleButton",
}


class RenderWidget(QOpenGLWidget):
    """Lets VTK render into a Qt framebuffer, and passes mouse events to VTK.

    It corresponds to `QVTKOpenGLNativeWidget`, which VTK provides in C++ only. It has no native window, so that other
    widgets can overlap it and Wayland is supported. It renders only when Qt paints it: render requests of VTK schedule
    a paint event, and several requests are combined into one frame.

    Attributes
    ----------
    render_window : vtkGenericOpenGLRenderWindow
    iren : vtkGenericRenderWindowInteractor
        Interactor: the left button rotates, with Shift it pans; the right button and the wheel zoom.
    """

    def __init__(self, parent: QWidget | None = None):
        choose_format()
        super().__init__(parent)
        self.setUpdateBehavior(QOpenGLWidget.UpdateBehavior.NoPartialUpdate)
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.WheelFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self._gl_context: QOpenGLContext | None = None
        self._painting = False
        self._wheel_angle = 0  # since the last whole step
        self._pressed: list[Qt.MouseButton] = []  # buttons that VTK takes for pressed
        window = self.render_window = vtkGenericOpenGLRenderWindow()
        window.SetReadyForRendering(False)
        window.SetFrameBlitModeToNoBlit()
        iren = self.iren = vtkGenericRenderWindowInteractor()
        iren.SetRenderWindow(window)
        iren.SetInteractorStyle(vtkInteractorStyleTrackballCamera())
        iren.EnableRenderOff()
        iren.Initialize()
        self._observers = [
            (source, source.AddObserver(event, handler))
            for source, event, handler in (
                (window, "WindowMakeCurrentEvent", self._make_current),
                (window, "WindowIsCurrentEvent", self._report_current),
                (window, "WindowFrameEvent", self._request_frame),
                (window, "CursorChangedEvent", lambda *_: QTimer.singleShot(0, self, self._show_cursor)),
                (iren, "RenderEvent", self._request_frame),
            )
        ]

    # OpenGL

    def _make_current(self, *_: object) -> None:
        """Make the OpenGL context current; `makeCurrent` of Qt would also bind another framebuffer."""
        if self._gl_context is not None:
            self._gl_context.makeCurrent(self._gl_context.surface())

    def _report_current(self, *_: object) -> None:
        current = QOpenGLContext.currentContext()
        self.render_window.SetIsCurrent(self._gl_context is not None and current is self._gl_context)

    def _request_frame(self, *_: object) -> None:
        if not self._painting:
            self.update()

    def initializeGL(self) -> None:
        """Initialise VTK with the OpenGL context of Qt."""
        self._gl_context = self.context()
        self._gl_context.aboutToBeDestroyed.connect(self._on_context_destroyed)
        window = self.render_window
        if sys.platform.startswith("linux"):
            window.SetOpenGLSymbolLoader2(_loader(), 0)
        window.OpenGLInitContext()
        window.OpenGLInit()
        state = window.GetState()
        state.Reset()
        state.vtkglDepthFunc(_LESS_OR_EQUAL)  # Qt sets GL_LESS
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
        state.Reset()  # Qt may have changed the state
        state.Push()
        state.vtkglDepthFunc(_LESS_OR_EQUAL)
        self._painting = True
        try:
            window.Render()
        finally:
            self._painting = False
        self.makeCurrent()
        self._copy()
        state.Pop()

    def _copy(self) -> None:
        """Copy the rendered picture with full opacity; a translucent picture would show windows behind."""
        window, pixels = self.render_window, self._pixels
        gl = self._gl_context.extraFunctions()
        gl.glBindFramebuffer(_DRAW_FRAMEBUFFER, self.defaultFramebufferObject())
        gl.glDrawBuffers(1, [_COLOUR])
        scissors = gl.glIsEnabled(_SCISSORS)
        if scissors:
            window.GetState().vtkglDisable(_SCISSORS)
            gl.glDisable(_SCISSORS)
        rectangles = 0, 0, *window.GetSize(), 0, 0, *pixels  # left, bottom, width, height of source and destination
        window.BlitDisplayFramebuffer(0, *rectangles, _COLOURS, _LINEAR)
        gl.glColorMask(False, False, False, True)
        gl.glClearColor(0.0, 0.0, 0.0, 1.0)
        gl.glViewport(0, 0, *pixels)
        gl.glClear(_COLOURS)
        gl.glColorMask(True, True, True, True)
        if scissors:
            window.GetState().vtkglEnable(_SCISSORS)
            gl.glEnable(_SCISSORS)

    def _on_context_destroyed(self) -> None:
        self._make_current()
        self._finalise()
        self.forget_context()

    def _finalise(self) -> None:
        self.render_window.Finalize()
        self.render_window.SetReadyForRendering(False)

    def forget_context(self) -> None:
        """Forget a destroyed OpenGL context."""
        self._gl_context = None

    def release_graphics(self) -> None:
        """Release graphics resources; must be called while the window exists."""
        self._finalise()
        for source, observer in self._observers:
            source.RemoveObserver(observer)
        self._observers.clear()

    # Mouse

    def _pass_position(self, event: QMouseEvent, repeat: int = 0) -> None:
        """Pass the pointer position, in device pixels from the lower left corner, and modifier keys to VTK."""
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
        """Start to move the camera or to drag a handle."""
        self._pass_position(event, int(event.type() == QEvent.Type.MouseButtonDblClick))
        if event.button() in _BUTTONS:
            self._pressed.append(event.button())
            self.iren.InvokeEvent(f"{_BUTTONS[event.button()]}PressEvent")

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """End the drag."""
        self._pass_position(event)
        self._release(event.button())

    def _release(self, button: Qt.MouseButton) -> None:
        """Tell VTK that a button was released."""
        if button in self._pressed:
            self._pressed.remove(button)
            self.iren.InvokeEvent(f"{_BUTTONS[button]}ReleaseEvent")

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Continue the drag; end it if another window received the release of the button."""
        for button in [button for button in self._pressed if not button & event.buttons()]:
            self._release(button)
        self._pass_position(event)
        self.iren.MouseMoveEvent()

    def leaveEvent(self, event: QEvent) -> None:
        """Let VTK forget the handle below the pointer, unless it is dragged."""
        super().leaveEvent(event)
        if not self._pressed:
            self.iren.SetEventInformation(-1, -1, 0, 0, "\0", 0, None)
            self.iren.MouseMoveEvent()

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Zoom by whole steps."""
        self._wheel_angle += event.angleDelta().y()
        zoom = self.iren.MouseWheelForwardEvent if self._wheel_angle > 0 else self.iren.MouseWheelBackwardEvent
        for _ in range(abs(self._wheel_angle) // _STEP):
            zoom()
        self._wheel_angle -= int(self._wheel_angle / _STEP) * _STEP

    def _show_cursor(self) -> None:
        self.setCursor(_CURSORS.get(self.render_window.GetCurrentCursor(), Qt.CursorShape.ArrowCursor))


def _loader() -> int:
    """Return the address of the loader of OpenGL functions on Linux."""
    wayland = QGuiApplication.platformName().startswith("wayland")
    library, name = ("libEGL.so.1", "eglGetProcAddress") if wayland else ("libGL.so.1", "glXGetProcAddressARB")
    return ctypes.cast(getattr(ctypes.CDLL(library), name), ctypes.c_void_p).value
