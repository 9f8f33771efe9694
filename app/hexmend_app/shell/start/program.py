"""Start and end of the Qt program."""

from __future__ import annotations

import logging
import os
import signal
import sys
import traceback
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING

os.environ.setdefault("QT_API", "pyside6")
os.environ.setdefault("PYQTGRAPH_QT_LIB", "PySide6")

from PySide6.QtCore import QCoreApplication, QLocale, QTimer, QTranslator
from PySide6.QtGui import QIcon
from PySide6.QtWidgets import QApplication

from hexmend.cli.process.interrupts import ENDING
from hexmend_app.resources import demo_mesh, resource
from hexmend_app.state.settings import settings
from hexmend_app.state.tasks.task import running
from hexmend_app.state.tasks.ui_thread_gc import UiThreadGC
from hexmend_app.theme.theme_choice import apply_theme
from hexmend_app.translation import tr
from hexmend_app.widgets.error_report import report_of

if TYPE_CHECKING:
    from hexmend_app.shell.window import Window

log = logging.getLogger(__name__)


def application() -> QApplication:
    """Return the QApplication with its theme; from now on it runs the garbage collector."""
    app = QApplication.instance() or QApplication(sys.argv[:1])
    QCoreApplication.setOrganizationName("Hexmend")
    QCoreApplication.setApplicationName("Hexmend")
    QApplication.setApplicationDisplayName("Hexmend")
    QApplication.setDesktopFileName("hexmend")
    QApplication.setWindowIcon(QIcon(str(resource("icon.svg"))))
    apply_theme()
    if app.findChild(UiThreadGC) is None:
        UiThreadGC(app)
    return app  # type: ignore[return-value]


def open_window(mesh: str | None = None) -> int:
    """Show the window, open `mesh` or the demo mesh, and run until it is closed; return the exit status."""
    app = application()
    translator = QTranslator(app)
    if translator.load(QLocale.system(), "hexmend", "_", str(resource("icon.svg").parent / "translations")):
        app.installTranslator(translator)
    from hexmend_app.shell.start.window_start import WindowStart
    from hexmend_app.shell.window import Window

    window = Window()
    report_unexpected_errors(window)
    window.ready.connect(lambda: [f.program_started() for f in window.features.values()])  # type: ignore[func-returns-value]
    window.ready.connect(app.findChild(UiThreadGC).freeze)
    # A signal may arrive during painting: close the window afterwards.
    signal.signal(signal.SIGINT, lambda *_: QTimer.singleShot(0, window.close))
    for number in ENDING:  # end at once; the autosave is offered at the next start
        if number != signal.SIGINT and signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, signal.SIG_DFL)
    wake_up = QTimer()  # lets Python handle signals
    wake_up.start(250)
    wake_up.timeout.connect(lambda: None)
    window.show()
    app.processEvents()  # show it before the slow imports
    WindowStart(window, Path(mesh) if mesh else demo_mesh())
    status = app.exec()
    end_with_threads(status)
    return status


def end_with_threads(status: int) -> None:
    """End the process if threads are still running: Python would wait for them.

    A thread cannot be ended while it reads from a network drive that does not respond, for example. All data has been
    written before.
    """
    if not running():
        return
    log.warning("closed while threads were running: %s", ", ".join(task.name for task in running()))
    settings.write_all()
    logging.shutdown()
    for stream in (sys.stdout, sys.stderr):
        if stream is not None:
            stream.flush()
    os._exit(status)


def report_unexpected_errors(window: Window) -> None:
    """Show exceptions raised in slots as messages in the window; Qt would only print them."""

    def hook(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
        if issubclass(kind, KeyboardInterrupt):
            window.close()
            return
        log.error("unexpected error", exc_info=(kind, error, trace))
        place = traceback.extract_tb(trace)[-1] if trace else None
        where = f" ({Path(place.filename).name}, line {place.lineno})" if place else ""
        window.messages.show_error(
            tr("Unexpected error in Hexmend"), f"{kind.__name__}: {error}{where}", report_of(error)
        )

    sys.excepthook = hook
