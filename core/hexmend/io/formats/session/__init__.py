"""Sessions (.hexmend): the meshes of a window, the index of the mesh that is shown, and the state of the window.

`hexmend.read` gives the mesh that was shown, with the surface on which its boundary slides.
"""

from __future__ import annotations

from pathlib import Path

from hexmend.aliases import exports
from hexmend.io.base.format import Format, register
from hexmend.mesh.mesh import Mesh

SUFFIX = ".hexmend"

#: Signature of a zip file, and the name of its first member.
_SIGNATURE, _FIRST_MEMBER = b"PK\x03\x04", b"description.json"


def read(path: Path) -> Mesh:
    """Read the mesh that was shown."""
    from hexmend.io.formats.session.session_file import read_shown_mesh  # late: zipfile and json cost 9 ms

    return read_shown_mesh(path)


def is_session(head: bytes) -> bool:
    """Return True if a file that begins with these bytes is a session."""
    return head.startswith(_SIGNATURE) and head[30 : 30 + len(_FIRST_MEMBER)] == _FIRST_MEMBER  # behind its header


register(
    Format(
        name="session",
        title="Hexmend session",
        suffixes=(SUFFIX,),
        encodings=(),
        read=read,
        matches=is_session,
    )
)

__getattr__ = exports(__name__)
