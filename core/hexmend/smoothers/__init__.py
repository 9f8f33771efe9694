"""Smoothers and untanglers: a module for each method or family; each registers itself in METHODS.

Every module of this package and of its folders is imported here: the command line, the viewer, the docs and the tests
take the methods from METHODS. Other distributions add theirs through the entry-point group `hexmend.smoothers`, which
is read as soon as all methods are asked for.
"""

import importlib
import pkgutil

from hexmend.smoothers.base import METHODS, Smoother, method

for _module in pkgutil.walk_packages(__path__, f"{__name__}."):
    importlib.import_module(_module.name)

#: The method that is used where none is named.
DEFAULT_METHOD = "mend"

__all__ = ["DEFAULT_METHOD", "METHODS", "Smoother", "method"]
