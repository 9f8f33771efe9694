"""Generated meshes for tests, benchmarks, studies and examples; one mesh a file.

>>> from hexmend import gallery
>>> gallery.make("five-side").n_hexes
7350
"""

import importlib
import pkgutil
from typing import Any

from hexmend.gallery.gallery_mesh import GALLERY, GalleryMesh
from hexmend.mesh.mesh import Mesh
from hexmend.parameters import from_values

for _module in pkgutil.iter_modules(__path__):
    importlib.import_module(f"{__name__}.{_module.name}")

__all__ = ["GALLERY", "GalleryMesh", "make"]


def make(name: str, **parameters: Any) -> Mesh:
    """Build a gallery mesh.

    Parameters
    ----------
    name : str
        Name in `GALLERY`.
    **parameters
        Parameters of that mesh, such as `size`.

    Returns
    -------
    Mesh

    Raises
    ------
    ParameterError
        For an unknown name of a mesh or parameter (the message suggests the nearest) and a value that is not allowed.
    """
    return from_values(GALLERY[name], parameters, name).build()
