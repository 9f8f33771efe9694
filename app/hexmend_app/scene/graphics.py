"""Whether VTK can draw here. Without a usable OpenGL it ends the process; this says so first."""

from __future__ import annotations

import ctypes
import os
import sys
from functools import cache

from hexmend.errors import HexmendError


class GraphicsError(HexmendError):
    """Nothing can be drawn here."""


@cache
def prepare_off_screen() -> None:
    """Make VTK draw without a window and without an X server.

    Raises
    ------
    GraphicsError
        Where a library is missing, with the Debian package that brings it.
    """
    if not sys.platform.startswith("linux"):
        return
    # EGL needs no server; VTK would try X first and complain.
    os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")
    try:
        egl = ctypes.CDLL("libEGL.so.1")
    except OSError:
        raise GraphicsError("pictures need OpenGL: run  apt-get install libegl1 libgl1-mesa-dri") from None
    if not _initialises(egl):
        raise GraphicsError("OpenGL finds no driver to draw with: run  apt-get install libgl1-mesa-dri")


def _initialises(egl: ctypes.CDLL) -> bool:
    """Whether some EGL device, a software one included, can be opened."""
    egl.eglGetProcAddress.restype = ctypes.c_void_p
    egl.eglGetProcAddress.argtypes = [ctypes.c_char_p]
    get_display = egl.eglGetProcAddress(b"eglGetPlatformDisplayEXT")
    if not get_display:
        return False
    surfaceless = 0x31DD  # EGL_PLATFORM_SURFACELESS_MESA
    prototype = ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.c_uint, ctypes.c_void_p, ctypes.c_void_p)
    display = prototype(get_display)(surfaceless, None, None)
    egl.eglInitialize.argtypes = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p]
    return bool(display) and bool(egl.eglInitialize(display, None, None))
