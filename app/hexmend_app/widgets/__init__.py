"""Widgets of the viewer: setters set the values to show, and signals report actions of the user.

Each module contains one widget and is imported separately, so that a program loads only the widgets it shows.
"""

import os

# Otherwise pyqtgraph, superqt and qtawesome use the first Qt binding they find.
os.environ.setdefault("PYQTGRAPH_QT_LIB", "PySide6")
os.environ.setdefault("QT_API", "pyside6")
