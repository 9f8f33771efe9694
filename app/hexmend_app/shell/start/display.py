"""Check that a window can be opened: otherwise Qt and VTK would end the process."""

from __future__ import annotations

import ctypes
import os
import sys

from hexmend.errors import HexmendError

#: Libraries that Qt's xcb plugin loads, and the Debian packages that contain them.
_XCB_PACKAGES = {
    "libxcb-cursor.so.0": "libxcb-cursor0",
    "libxcb-icccm.so.4": "libxcb-icccm4",
    "libxcb-keysyms.so.1": "libxcb-keysyms1",
    "libxcb-shape.so.0": "libxcb-shape0",
    "libxkbcommon.so.0": "libxkbcommon0",
    "libxkbcommon-x11.so.0": "libxkbcommon-x11-0",
    "libfontconfig.so.1": "libfontconfig1",
    "libdbus-1.so.3": "libdbus-1-3",
    "libGL.so.1": "libgl1",
    "libEGL.so.1": "libegl1",
    "libglib-2.0.so.0": "libglib2.0-0",
}


class DisplayError(HexmendError):
    """No window can be opened."""


def check_display() -> None:
    """Raise `DisplayError` with the reason if Qt could not open a window."""
    if not sys.platform.startswith("linux"):
        return
    if not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        raise DisplayError(
            "there is no display to open a window on (neither DISPLAY nor WAYLAND_DISPLAY is set). "
            "Use `hexmend smooth` or `hexmend render`, which need no display, or a virtual one: xvfb-run hexmend."
        )
    missing = sorted({package for library, package in _XCB_PACKAGES.items() if not _loads(library)})
    if missing:
        raise DisplayError(f"libraries of the window system are missing: run  apt-get install {' '.join(missing)}")
    if os.environ.get("DISPLAY") and not os.environ.get("WAYLAND_DISPLAY") and not _responds():
        raise DisplayError(f"the display {os.environ['DISPLAY']} does not respond. Check that its server is running.")


def _loads(library: str) -> bool:
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True


def _responds() -> bool:
    """Return True if the X server can be reached."""
    try:
        xcb = ctypes.CDLL("libxcb.so.1")
    except OSError:
        return True  # Qt reports the missing library
    xcb.xcb_connect.restype = ctypes.c_void_p
    xcb.xcb_connect.argtypes = [ctypes.c_char_p, ctypes.c_void_p]
    xcb.xcb_connection_has_error.argtypes = [ctypes.c_void_p]
    xcb.xcb_disconnect.argtypes = [ctypes.c_void_p]
    connection = xcb.xcb_connect(None, None)
    failed = bool(xcb.xcb_connection_has_error(connection))
    xcb.xcb_disconnect(connection)
    return not failed
