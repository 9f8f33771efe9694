"""OpenGL settings of the program's windows, made before the first window."""

from __future__ import annotations

from PySide6.QtGui import QSurfaceFormat
from PySide6.QtOpenGLWidgets import QOpenGLWidget
from PySide6.QtWidgets import QWidget


def choose_format() -> None:
    """Have all OpenGL be as VTK wants it: a widget with a format of its own stays black under Wayland."""
    chosen = QSurfaceFormat()
    chosen.setRenderableType(QSurfaceFormat.RenderableType.OpenGL)  # Wayland may else give one for telephones
    chosen.setProfile(QSurfaceFormat.OpenGLContextProfile.CoreProfile)
    chosen.setVersion(3, 2)
    chosen.setSwapBehavior(QSurfaceFormat.SwapBehavior.DoubleBuffer)
    for part in ("Red", "Green", "Blue", "Alpha", "Depth"):
        getattr(chosen, f"set{part}BufferSize")(8)
    chosen.setStencilBufferSize(0)
    chosen.setSamples(0)  # edges are smooth in what VTK hands over
    QSurfaceFormat.setDefaultFormat(chosen)


def reserve_opengl(window: QWidget) -> None:
    """Have a window take OpenGL later: one made without it is taken down by Qt for that, and made anew on the screen.

    Parameters
    ----------
    window : QWidget
        It has not been shown.
    """
    choose_format()
    QOpenGLWidget(window).hide()
