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

from PySide6.QtCore import QCoreApplication, QLocale, QObject, QTimer, QTranslator
from PySide6.QtGui import QIcon
from PySide6.QtWidgets import QApplication

from hexmend.cli.process.interrupts import ENDING
from hexmend_app.resources import demo_mesh, resource
from hexmend_app.state.settings import settings
from hexmend_app.state.tasks.task import Task, running
from hexmend_app.state.tasks.ui_thread_gc import UiThreadGC
from hexmend_app.theme.theme_choice import apply_theme
from hexmend_app.translation import tr
from hexmend_app.widgets.error_report import report_of

if TYPE_CHECKING:
    from hexmend_app.shell.window import Window

#: Maximum time in milliseconds for which building the panels is delayed until the mesh is drawn.
_WAIT = 700
_EXHAUSTED = object()

os.environ.setdefault("QT_API", "pyside6")

os.environ.setdefault("PYQTGRAPH_QT_LIB", "PySide6")

log = logging.getLogger(__name__)


def application() -> QApplication:
    """Return the QApplication with its theme; from now on it runs the garbage collector."""
    app = QApplication.instance() or QApplication(sys.argv[:1])
    QCoreApplication.setOrganizationName("Hexmend")
    QCoreApplication.setApplicationName("Hexmend")
    QApplication.setApplicationDisplayName("Hexmend")
    QApplication.setDesktopFileName("hexmend")
    QApplication.setWindowIcon(QIcon(str(resource("icon.svg"))))
    if app.property("dark") is None:  # without a style yet
        font = QApplication.font()
        font.setPointSizeF(font.pointSizeF() * settings.LETTERS.get() / 100)
        QApplication.setFont(font)
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
    WindowStart(window, Path(mesh) if mesh else first_mesh())
    status = app.exec()
    end_with_threads(status)
    return status


def first_mesh() -> Path:
    """Return what a start without a file opens: the last file, if so set and it exists, or the demo mesh."""
    last = next(iter(settings.RECENT.get()), None) if settings.REOPEN.get() else None
    return last if last is not None and last.exists() else demo_mesh()


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


class WindowStart(QObject):
    """Opening of a mesh in a new window, followed by building all features.

    The 3D modules are imported in a thread, so that the window is repainted meanwhile. The panels are built in turns of
    the event loop, once the mesh is drawn, has failed to open, or takes too long.

    Parameters
    ----------
    window : Window
        Visible window.
    mesh : Path
    """

    def __init__(self, window: Window, mesh: Path):
        super().__init__(window)
        self._window, self._mesh = window, mesh
        self._steps = window.build_steps()
        self._step = QTimer(self, interval=0)
        self._step.timeout.connect(self._build_features)
        self._wait = QTimer(self, interval=_WAIT, singleShot=True)
        self._wait.timeout.connect(self._step.start)
        self._loading = Task("3D modules", _load)
        self._loading.ended.connect(self._open)
        self._loading.start()

    def _open(self) -> None:
        window = self._window
        if not window.isVisible():
            return  # closed meanwhile
        if self._loading.error is not None:
            raise self._loading.error
        window.begin()
        window.session.commands.open(self._mesh)  # in a thread
        window.build_canvas()
        self._wait.start()
        window.canvas.interactor.frameSwapped.connect(self._on_frame)
        window.session.opener.failed.connect(self._continue)

    def _on_frame(self) -> None:
        if self._window.canvas.colouring is not None:
            self._continue()

    def _continue(self) -> None:
        self._window.canvas.interactor.frameSwapped.disconnect(self._on_frame)
        self._window.session.opener.failed.disconnect(self._continue)
        self._wait.start(0)

    def _build_features(self) -> None:
        if not self._window.isVisible() or next(self._steps, _EXHAUSTED) is _EXHAUSTED:
            self._step.stop()


def _load(task: Task) -> None:
    """Import the 3D modules and the features that draw a mesh."""
    import hexmend_app.canvas.canvas
    import hexmend_app.state.session.session  # noqa: F401
    from hexmend_app.shell.features import FIRST, feature_class

    for name in FIRST:
        feature_class(name)
