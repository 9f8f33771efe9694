"""Check for a usable OpenGL, without which VTK would terminate the process."""

from __future__ import annotations

import ctypes
import os
import sys
from functools import cache

from hexmend.errors import HexmendError


class GraphicsError(HexmendError):
    """Drawing is impossible on this machine."""


@cache
def prepare_off_screen() -> None:
    """Configure VTK for drawing without a window and without an X server.

    Raises
    ------
    GraphicsError
        If a library is missing; the message names the Debian package that contains it.
    """
    if not sys.platform.startswith("linux"):
        return
    # EGL requires no X server; by default VTK would try X first and print errors.
    os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")
    try:
        egl = ctypes.CDLL("libEGL.so.1")
    except OSError:
        raise GraphicsError("pictures need OpenGL: run  apt-get install libegl1 libgl1-mesa-dri") from None
    if not _initialises(egl):
        raise GraphicsError("OpenGL finds no driver to draw with: run  apt-get install libgl1-mesa-dri")


def _initialises(egl: ctypes.CDLL) -> bool:
    """Return True if an EGL device, such as a software renderer, can be opened."""
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
