"""Smoothers and untanglers: one method a file, each announcing itself in METHODS.

A file added to this folder is imported here, and with that is in the command line, the viewer, the docs and the tests.
Other distributions add theirs through the entry-point group `hexmend.smoothers`, as soon as somebody asks for all.
"""

import importlib
import pkgutil

from hexmend.smoothers.smoother import METHODS, Smoother, method

for _module in pkgutil.iter_modules(__path__):
    importlib.import_module(f"{__name__}.{_module.name}")

#: The method that is used where none is named.
DEFAULT_METHOD = "mend"

__all__ = ["DEFAULT_METHOD", "METHODS", "Smoother", "method"]
