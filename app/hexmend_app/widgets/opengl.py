"""OpenGL settings of all windows, made before the first window."""

from __future__ import annotations

from PySide6.QtGui import QSurfaceFormat
from PySide6.QtOpenGLWidgets import QOpenGLWidget
from PySide6.QtWidgets import QWidget


def choose_format() -> None:
    """Set the default OpenGL format to that of VTK: a widget with another format stays black under Wayland."""
    surface = QSurfaceFormat()
    surface.setRenderableType(QSurfaceFormat.RenderableType.OpenGL)  # Wayland may default to OpenGL ES
    surface.setProfile(QSurfaceFormat.OpenGLContextProfile.CoreProfile)
    surface.setVersion(3, 2)
    surface.setSwapBehavior(QSurfaceFormat.SwapBehavior.DoubleBuffer)
    for part in ("Red", "Green", "Blue", "Alpha", "Depth"):
        getattr(surface, f"set{part}BufferSize")(8)
    surface.setStencilBufferSize(0)
    surface.setSamples(0)  # VTK smooths edges itself
    QSurfaceFormat.setDefaultFormat(surface)


def reserve_opengl(window: QWidget) -> None:
    """Prepare a window for an OpenGL widget that is added later: otherwise Qt would destroy and recreate the window.

    Parameters
    ----------
    window : QWidget
        Window that has not been shown yet.
    """
    choose_format()
    QOpenGLWidget(window).hide()
