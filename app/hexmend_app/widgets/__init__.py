"""Widgets of the viewer: they show values given by setters and announce the user's wishes by signals.

Each module holds one widget and is imported by name, so that a program pays only for what it shows.
"""

import os

# pyqtgraph, superqt and qtawesome take whichever Qt binding they find first; there is one here.
os.environ.setdefault("PYQTGRAPH_QT_LIB", "PySide6")
os.environ.setdefault("QT_API", "pyside6")
