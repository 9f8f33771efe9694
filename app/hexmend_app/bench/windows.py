"""Windows with meshes in them, to be measured."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from statistics import median
from time import perf_counter
from typing import TYPE_CHECKING, Any

from hexmend.errors import HexmendError

if TYPE_CHECKING:
    from hexmend.mesh.mesh import Mesh
    from hexmend_app.shell.window import Window
    from hexmend_app.state.session import Session

_FRAMES = 40
_PATIENCE = 60.0  # seconds for a frame
_LONGEST = 300.0  # seconds for anything else


def measured(meshes: Iterable[Mesh], row: Callable[[Window], dict[str, Any]]) -> dict[str, Any]:
    """A row of figures for each mesh, found in a window of its own; why not, where there is no display."""
    from hexmend_app.shell.display import DisplayError, check_display

    try:
        check_display()
    except DisplayError as error:
        return {"skipped": str(error), "meshes": []}
    from hexmend_app.shell.program import application
    from hexmend_app.shell.window import Window
    from hexmend_app.state.document import State

    app = application()
    rows = []
    for mesh in meshes:
        window = Window()
        window.resize(1440, 900)
        window.show()
        window.furnish()
        window.build_canvas()
        window.session.document.replace(State.of(mesh), Path(f"{mesh.name}.vtu"))
        turn(0.5)  # until the layout has settled
        rows.append({"mesh": mesh.name, "hexes": mesh.n_hexes, **row(window)})
        document = window.session.document
        document.commit("measured", document.now)  # or closing would ask for what is not saved
        document.saved(document.path)
        window.close()
        app.processEvents()
    return {"meshes": rows}


def turning_ms(window: Window) -> float:
    """Median milliseconds of a frame while the camera moves around the whole mesh."""
    canvas, times = window.canvas, []
    turn(0.5)  # until the fine frame is drawn
    for _ in range(_FRAMES):
        canvas.panes.turning()
        canvas.viewport.camera.Azimuth(4)
        canvas.panes.eye.reset_depth()
        began = perf_counter()
        draw(window)
        times.append(perf_counter() - began)
    return 1e3 * median(times)


def draw(window: Window) -> None:
    """Draw a frame and wait until it is on the screen, with the panels that have changed."""
    from PySide6.QtWidgets import QApplication

    interactor, seen = window.canvas.interactor, []
    told = interactor.frameSwapped.connect(lambda: seen.append(True))
    interactor.update()
    began = perf_counter()
    while not seen:
        QApplication.processEvents()
        if perf_counter() - began > _PATIENCE:
            raise HexmendError("the window draws no frame: is it hidden?")
    interactor.frameSwapped.disconnect(told)


def report(figures: dict[str, Any], lines: Callable[[dict[str, Any]], Iterable[str]]) -> list[str]:
    """What a section prints: the lines of each mesh's row, or why there are none."""
    left_out = [f"left out: {figures['skipped']}"] if "skipped" in figures else []
    return left_out + [line for row in figures["meshes"] for line in lines(row)]


def save_and_wait(session: Session, path: str | Path) -> None:
    """Save the mesh, or under a session's suffix the session, and wait until it is written; raises why it was not."""
    saving = session.commands.save_in_background(path)
    until(lambda: saving.over)
    if saving.error is not None:
        raise saving.error


def end_run(session: Session) -> None:
    """End a run, if one is under way, and wait until it is recorded."""
    session.smoothing.stop()
    until(lambda: not session.smoothing.busy)


def until(condition: Callable[[], bool]) -> None:
    """Let the window live until something is so."""
    began = perf_counter()
    while not condition():
        turn(0.02)
        if perf_counter() - began > _LONGEST:
            raise HexmendError(f"the window has not answered for {_LONGEST:.0f} s")


def turn(seconds: float) -> None:
    """Let Qt's own event loop turn; one of ours would take the processor from the worker."""
    from PySide6.QtCore import QEventLoop, QTimer

    loop = QEventLoop()
    QTimer.singleShot(round(seconds * 1e3), loop.quit)
    loop.exec()
