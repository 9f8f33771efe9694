"""Windows with meshes, for benchmarks."""

from __future__ import annotations

import atexit
import shutil
import tempfile
from collections.abc import Callable, Iterable
from pathlib import Path
from statistics import median
from time import perf_counter
from typing import Any

from PySide6.QtCore import QEventLoop, QTimer
from PySide6.QtWidgets import QApplication

from hexmend.errors import HexmendError
from hexmend.mesh.mesh import Mesh
from hexmend_app.shell.start.program import application
from hexmend_app.shell.window import Window
from hexmend_app.state.mesh.document import MeasuredMesh
from hexmend_app.state.session.session import Session
from hexmend_app.state.settings.settings import store_in

_FRAMES = 40
_FRAME_TIMEOUT = 60.0  # seconds for a frame
_TIMEOUT = 300.0  # seconds for anything else


def measure_meshes(meshes: Iterable[Mesh], row: Callable[[Window], dict[str, Any]]) -> dict[str, Any]:
    """Measure each mesh in a new window; return one row each."""
    keep_settings()
    app = application()
    rows = []
    for mesh in meshes:
        window = Window()
        window.resize(1440, 900)
        window.show()
        window.build_features()
        window.build_canvas()
        window.session.document.replace(MeasuredMesh.of(mesh), Path(f"{mesh.name}.vtu"))
        run_event_loop(0.5)  # until the layout has settled
        rows.append({"mesh": mesh.name, "hexes": mesh.n_hexes, **row(window)})
        document = window.session.document
        document.commit("measured", document.now)  # otherwise closing would ask to save
        document.mark_saved(document.path)
        window.close()
        app.processEvents()
    return {"meshes": rows}


def keep_settings() -> None:
    """Let windows of this process use settings of their own, so that a benchmark leaves those of the user alone."""
    folder = tempfile.mkdtemp(prefix="hexmend-bench-")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    store_in(folder)


def rotation_frame_ms(window: Window) -> float:
    """Return the median milliseconds per frame while the camera moves around the mesh."""
    canvas, times = window.canvas, []
    run_event_loop(0.5)  # until the shaded frame is drawn
    for _ in range(_FRAMES):
        canvas.panes.turning()
        canvas.viewport.camera.Azimuth(4)
        canvas.panes.camera_controller.reset_depth()
        start = perf_counter()
        draw(window)
        times.append(perf_counter() - start)
    return 1e3 * median(times)


def draw(window: Window) -> None:
    """Draw a frame, and wait until it and the changed panels are on the screen."""
    interactor, swapped = window.canvas.interactor, []
    connection = interactor.frameSwapped.connect(lambda: swapped.append(True))
    interactor.update()
    start = perf_counter()
    while not swapped:
        QApplication.processEvents()
        if perf_counter() - start > _FRAME_TIMEOUT:
            raise HexmendError("the window does not draw: is it hidden?")
    interactor.frameSwapped.disconnect(connection)


def report(figures: dict[str, Any], lines: Callable[[dict[str, Any]], Iterable[str]]) -> list[str]:
    """Return the printed lines of a section: the lines of each row."""
    return [line for row in figures["meshes"] for line in lines(row)]


def save_and_wait(session: Session, path: str | Path) -> None:
    """Save the mesh, or with the suffix of sessions the session, and wait; raise an error of the task."""
    saving = session.commands.save_in_background(path)
    wait_until(lambda: saving.over)
    if saving.error is not None:
        raise saving.error


def end_run(session: Session) -> None:
    """Stop the run, if there is one, and wait for its end."""
    session.run.stop()
    wait_until(lambda: not session.run.busy)


def wait_until(condition: Callable[[], bool]) -> None:
    """Run the event loop until a condition holds."""
    start = perf_counter()
    while not condition():
        run_event_loop(0.02)
        if perf_counter() - start > _TIMEOUT:
            raise HexmendError(f"the window has not responded for {_TIMEOUT:.0f} s")


def run_event_loop(seconds: float) -> None:
    """Run Qt's event loop for some seconds; polling would take the processor from the worker."""
    loop = QEventLoop()
    QTimer.singleShot(round(seconds * 1e3), loop.quit)
    loop.exec()
