"""Size and place of the main window, and the layout of its status bar."""

from __future__ import annotations

from PySide6.QtWidgets import QMainWindow, QStatusBar, QWidget

from hexmend_app.state.settings import settings


def restore_geometry(window: QMainWindow) -> None:
    """Restore the saved geometry of a window, or fit it to the screen."""
    screen = window.screen().availableGeometry()
    window.resize(min(1600, round(screen.width() * 0.94)), min(1000, round(screen.height() * 0.92)))
    window.restoreGeometry(settings.GEOMETRY.get())  # no effect without a saved geometry


def lay_out_status_bar(bar: QStatusBar, main: QWidget, *parts: QWidget) -> None:
    """Fill a status bar: its main part takes the width that the parts on its right leave."""
    bar.setSizeGripEnabled(False)
    bar.addPermanentWidget(main, 1)  # messages do not hide permanent widgets
    for part in parts:
        bar.addPermanentWidget(part)
    bar.layout().setContentsMargins(0, 0, 8, 0)  # after the widgets, as adding one makes a new layout
