"""Functions that scripts/pictures share: open a window with a mesh, wait for its work, take screenshots of it."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from PIL import Image
from PySide6.QtCore import QEventLoop, QSettings, Qt, QTimer
from PySide6.QtWidgets import QAbstractButton, QComboBox, QDockWidget

from benchmarks.window.windows import end_run
from hexmend.gallery import make
from hexmend.io import write
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Stage
from hexmend.smoothers import METHODS
from hexmend_app.picture.cut import Cut, CutStyle
from hexmend_app.shell.start.program import application
from hexmend_app.shell.window import Window
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.theme.theme_choice import ThemeChoice, choose

#: Screenshots to take: a function that prepares the window, the name of a gallery mesh, and the mesh's parameters.
Scenes = Sequence[tuple[Callable[[Window], object], str, dict]]

#: Size in bytes above which colours are reduced, and the share of the image from which on a colour is kept exactly.
_LARGE, _AREA = 280_000, 0.004


def process_events(seconds: float) -> None:
    """Run the event loop for some seconds."""
    loop = QEventLoop()
    QTimer.singleShot(round(seconds * 1e3), loop.quit)
    loop.exec()


def wait_until(condition: Callable[[], object], seconds: float = 120) -> None:
    """Wait until a condition holds; it is checked ten times a second."""
    for _ in range(round(seconds * 10)):
        if condition():
            return
        process_events(0.1)
    raise TimeoutError(f"the condition does not hold after {seconds} s")


def open_window(mesh: str | Path, size: tuple[int, int] = (1280, 800)) -> Window:
    """Open a mesh in a window that ignores the user's settings."""
    QSettings.setPath(QSettings.Format.NativeFormat, QSettings.Scope.UserScope, tempfile.mkdtemp())
    application()
    choose(ThemeChoice.LIGHT)
    window = Window()
    window.setGeometry(0, 0, *size)
    window.show()
    process_events(0.5)
    window.build_features()
    window.build_canvas()
    window.features["open"].open(mesh)
    wait_until(lambda: window.session.document.is_open)
    wait_until_drawn(window)
    window.messages.clear()  # the card would cover the mesh
    return window


def wait_until_drawn(window: Window) -> None:
    """Wait until the panels are refreshed, the camera has stopped, and the shaded frame is drawn."""
    window.refresh()
    process_events(0.5)
    canvas = window.canvas
    wait_until(lambda: not canvas.camera_animation.active)
    canvas.draw_still()
    wait_until(lambda: not canvas.shading_task.busy)
    process_events(0.5)


def screenshot(window: Window, path: Path) -> None:
    """Save a screenshot of the window."""
    wait_until_drawn(window)
    frame = window.geometry()
    window.screen().grabWindow(0, frame.x(), frame.y(), frame.width(), frame.height()).save(str(path))
    compress(path)


def compress(path: Path) -> None:
    """Rewrite a picture with a smaller file size."""
    image = Image.open(path).convert("RGB")
    image.save(path, optimize=True)
    if path.stat().st_size > _LARGE:
        _coarsened(image).save(path, optimize=True)
    print(f"{path}: {path.stat().st_size / 1000:.0f} kB")


def _coarsened(image: Image.Image) -> Image.Image:
    """Reduce red, green and blue to 32 levels each, except for colours of large areas."""
    pixels = np.asarray(image).reshape(-1, 3)
    _, colours, counts = np.unique(pixels @ (1 << 16, 1 << 8, 1), return_inverse=True, return_counts=True)
    coarse = np.rint(np.rint(pixels * (31 / 255)) * (255 / 31))
    reduced = np.where((counts > _AREA * len(pixels))[colours, None], pixels, coarse).astype(np.uint8)
    return Image.fromarray(reduced.reshape(image.height, image.width, 3))


def take_screenshots(scenes: Scenes, folder: Path, prefix: str) -> None:
    """Take a screenshot of each scene in a new window; the files are named after the scenes."""
    with tempfile.TemporaryDirectory() as directory:
        for scene, name, parameters in scenes:
            path = Path(directory) / f"{name}.vtu"
            write(path, make(name, **parameters))
            window = open_window(path)
            scene(window)
            screenshot(window, folder / f"{prefix}-{scene.__name__}.png")
            close_window(window)


def close_window(window: Window) -> None:
    """Close the window without asking to save."""
    end_run(window.session)
    window.session.document.commit("shown", window.session.document.now)
    window.session.document.mark_saved(window.session.document.path)
    window.close()
    process_events(0.1)


def zoom_out(window: Window, share: float = 0.85) -> None:
    """Zoom out, so that the colour bar does not cover the mesh."""
    wait_until_drawn(window)
    window.canvas.viewport.camera.Zoom(share)
    window.canvas.draw_soon()


def resize_panels(window: Window, width: int, height: int) -> None:
    """Resize the panels on the right, in pixels."""
    docks = [dock for dock in window.findChildren(QDockWidget) if dock.windowTitle() in ("Smooth", "Histogram")]
    tools, facts = sorted(docks, key=lambda dock: dock.windowTitle() != "Smooth")
    window.resizeDocks([tools, facts], [width, width], Qt.Orientation.Horizontal)
    window.resizeDocks([tools, facts], [tools.height() + facts.height() - height, height], Qt.Orientation.Vertical)


def choose_entry(window: Window, name: str, data: str) -> None:
    """Select an entry of the combo box with this accessible name."""
    box = next(box for box in window.findChildren(QComboBox) if box.accessibleName() == name)
    box.setCurrentIndex(box.findData(data))


def cut_mesh(window: Window, normal: tuple[float, float, float] = (1, 0, 0), crinkle: bool = True) -> None:
    """Cut the mesh through its middle, by whole hexes or smoothly."""
    middle = tuple(window.session.document.now.mesh.points.mean(axis=0))
    window.session.view.set_cut(Cut.at(normal, middle, CutStyle.CRINKLE if crinkle else CutStyle.SMOOTH))


def set_method(window: Window, name: str, **limits: float) -> None:
    """Select a method with its default parameters, and the limits of its run."""
    window.session.run_setup.choose(Stage(METHODS[name](), StoppingCriteria(**limits)))
    window.refresh()


def run_method(window: Window, method: str, **limits: float) -> None:
    """Run a method on the mesh shown until it finishes."""
    set_method(window, method, **limits)
    window.features["smooth"].run_or_pause()
    wait_until(lambda: window.session.run.phase is Phase.FINISHED)
    window.refresh()


def click(window: Window, name: str) -> None:
    """Click the button or check box with this name."""
    next(one for one in window.findChildren(QAbstractButton) if name in (one.accessibleName(), one.text())).click()
    window.refresh()
