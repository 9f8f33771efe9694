"""Sessions (.hexmend): the meshes of a window, the index of the mesh that is shown, and the state of the window.

`hexmend.read` gives the mesh that was shown, with the surface on which its boundary slides.
"""

from __future__ import annotations

from hexmend.io.base.format import Format, deferred

SUFFIX = ".hexmend"

#: Signature of a zip file, and the name of its first member.
_SIGNATURE, _FIRST_MEMBER = b"PK\x03\x04", b"description.json"


def is_session(head: bytes) -> bool:
    """Return True if a file that begins with these bytes is a session."""
    return head.startswith(_SIGNATURE) and head[30 : 30 + len(_FIRST_MEMBER)] == _FIRST_MEMBER  # behind its header


#: Deferred, because zipfile and json cost 9 ms.
_read = deferred("hexmend_app.formats.session.session_file:read_shown_mesh")
FORMAT = Format("session", "Hexmend session", (SUFFIX,), encodings=(), read=_read, matches=is_session)
