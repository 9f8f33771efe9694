"""Meshes that Hexmend makes itself: for tests, benchmarks, studies and first looks; one mesh a file.

>>> from hexmend import gallery
>>> gallery.make("five-side").n_hexes
7350
"""

import importlib
import pkgutil

from hexmend.gallery.gallery_mesh import GALLERY, GalleryMesh
from hexmend.mesh.mesh import Mesh

for _module in pkgutil.iter_modules(__path__):
    importlib.import_module(f"{__name__}.{_module.name}")

__all__ = ["GALLERY", "GalleryMesh", "make"]


def make(name: str, **parameters: object) -> Mesh:
    """Build the gallery mesh of that name.

    Raises
    ------
    ParameterError
        For a name or a value that is not admitted.
    """
    return GALLERY[name](**parameters).build()
