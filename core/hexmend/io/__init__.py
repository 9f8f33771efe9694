"""Reading and writing of mesh files and surfaces.

Every module of `hexmend.io.formats` is imported here and registers its formats in FORMATS.

>>> sorted(FORMATS)[:4]
['abaqus', 'ansys', 'avsucd', 'cgns']
"""

from __future__ import annotations

import importlib
import pkgutil

from hexmend.io import formats
from hexmend.io.base.format import FORMATS, Format
from hexmend.io.coordinates.replacement import Original, Written
from hexmend.io.files import (
    read,
    readable_suffixes,
    replaces_coordinates,
    unsupported_data,
    writable_suffixes,
    write,
    write_as_given,
    writer_for,
)

for _module in pkgutil.iter_modules(formats.__path__):
    importlib.import_module(f"{formats.__name__}.{_module.name}")

TYPE_CHECKING = False
if TYPE_CHECKING:
    from hexmend.io.surfaces import read_surface

__all__ = [
    "FORMATS", "Format", "Original", "Written", "read", "read_surface", "readable_suffixes", "replaces_coordinates",
    "unsupported_data", "writable_suffixes", "write", "write_as_given", "writer_for",
]  # fmt: skip


def __getattr__(name: str) -> object:
    if name == "read_surface":
        from hexmend.io.surfaces import read_surface

        return read_surface
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
