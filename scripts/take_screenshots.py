"""Takes the README's pictures: opens a mesh in the window, cuts it, runs the default method, pauses, steps, stops.

Use: xvfb-run -s "-screen 0 1600x1000x24" python scripts/take_screenshots.py MESH FOLDER
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

from PIL import Image
from PySide6.QtCore import QEventLoop, QSettings, QTimer

from hexmend.gallery import make
from hexmend.io import write
from hexmend_app.scene.palette import Choice
from hexmend_app.shell.program import application
from hexmend_app.shell.window import Window
from hexmend_app.state.clip import PlaneClip
from hexmend_app.state.run import Phase
from hexmend_app.widgets.theming import choose

#: What is photographed: what is done in the window, the gallery's mesh that is open in it, and how that is made.
Scenes = Sequence[tuple[Callable[[Window], object], str, dict]]


def turn(seconds: float) -> None:
    """Let the window live for a while."""
    loop = QEventLoop()
    QTimer.singleShot(round(seconds * 1e3), loop.quit)
    loop.exec()


def until(condition, seconds: float = 120) -> None:
    """Wait for something, looking ten times a second."""
    for _ in range(round(seconds * 10)):
        if condition():
            return
        turn(0.1)
    raise TimeoutError(f"waited {seconds} s in vain")


def shoot(window: Window, path: Path) -> None:
    """Photograph the screen where the window stands."""
    turn(1.0)
    at = window.geometry()
    window.screen().grabWindow(0, at.x(), at.y(), at.width(), at.height()).save(str(path))
    Image.open(path).convert("RGB").save(path, optimize=True)
    print(f"{path}: {path.stat().st_size / 1000:.0f} kB")


def opened(mesh: str | Path, size: tuple[int, int] = (1320, 830)) -> Window:
    """A window with a mesh open in it, without the first hint, that knows nothing of the user's settings."""
    QSettings.setPath(QSettings.Format.NativeFormat, QSettings.Scope.UserScope, tempfile.mkdtemp())
    application()
    window = Window()
    window.setGeometry(0, 0, *size)
    window.hint.dismiss()
    window.show()
    turn(0.5)
    window.furnish()
    window.build_canvas()
    window.features["open"].open(mesh)
    until(lambda: window.session.document.is_open)
    return window


def take(scenes: Scenes, folder: Path, prefix: str) -> None:
    """Photograph scenes, each in a window of its own, into files that are called after them."""
    with tempfile.TemporaryDirectory() as place:
        for scene, name, how in scenes:
            path = Path(place) / f"{name}.vtu"
            write(path, make(name, **how))
            window = opened(path, (1240, 780))
            scene(window)
            shoot(window, folder / f"{prefix}-{scene.__name__}.png")
            shut(window)
    choose(Choice.LIGHT)


def shut(window: Window) -> None:
    """Close the window, whatever is unsaved."""
    window.session.smoothing.end_now()
    window.session.document.commit("shown", window.session.document.now)
    window.session.document.saved(window.session.document.path)
    window.close()
    turn(0.1)


def main(mesh: str, folder: Path) -> None:
    """Go through the scenes."""
    window = opened(mesh)
    shoot(window, folder / "window-open.png")
    middle = tuple(window.session.document.now.mesh.points.mean(axis=0))
    window.session.view.set_clip(PlaneClip.at((1, 0, 0), middle, crinkle=True))
    shoot(window, folder / "window-cut.png")
    window.features["smooth"].panel.run_or_pause()
    until(lambda: window.session.smoothing.phase is Phase.RUNNING)
    turn(1)
    if window.session.smoothing.phase is Phase.RUNNING:  # a fast method may be through by now
        window.features["smooth"].panel.run_or_pause()
        until(lambda: window.session.smoothing.phase in (Phase.PAUSED, Phase.FINISHED))
    if window.session.smoothing.phase is Phase.PAUSED:
        window.features["smooth"].panel.step()
        turn(1)
    window.session.view.set_clip(PlaneClip.at((1, 0, 0), middle, crinkle=False))
    shoot(window, folder / "window-smoothing.png")
    if window.session.smoothing.phase is not Phase.FINISHED:
        window.session.smoothing.stop()
    until(lambda: window.session.smoothing.phase is Phase.FINISHED)
    shoot(window, folder / "window-stopped.png")
    shut(window)


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]))
