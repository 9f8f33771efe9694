"""What the scripts that take pictures share: a window with a mesh in it, waiting for what it does, photographing it."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from PIL import Image
from PySide6.QtCore import QEventLoop, QSettings, QTimer
from PySide6.QtWidgets import QAbstractButton, QComboBox

from hexmend.gallery import make
from hexmend.io import write
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Stage
from hexmend.smoothers import METHODS
from hexmend_app.bench.windows import end_run
from hexmend_app.shell.program import application
from hexmend_app.shell.window import Window
from hexmend_app.state.clip import PlaneClip
from hexmend_app.state.run import Phase
from hexmend_app.widgets.theming import Choice, choose

#: What is photographed: what is done in the window, the gallery's mesh that is open in it, and how that is made.
Scenes = Sequence[tuple[Callable[[Window], object], str, dict]]

#: Bytes beyond which a picture is written with fewer colours, and the share of it that a colour has which stays.
_LARGE, _AREA = 280_000, 0.004


def turn(seconds: float) -> None:
    """Let the window live for a while."""
    loop = QEventLoop()
    QTimer.singleShot(round(seconds * 1e3), loop.quit)
    loop.exec()


def until(condition: Callable[[], object], seconds: float = 120) -> None:
    """Wait for something, looking ten times a second."""
    for _ in range(round(seconds * 10)):
        if condition():
            return
        turn(0.1)
    raise TimeoutError(f"waited {seconds} s in vain")


def opened(mesh: str | Path, size: tuple[int, int] = (1280, 800)) -> Window:
    """A window with a mesh open in it that knows nothing of the user's settings."""
    QSettings.setPath(QSettings.Format.NativeFormat, QSettings.Scope.UserScope, tempfile.mkdtemp())
    application()
    choose(Choice.LIGHT)
    window = Window()
    window.setGeometry(0, 0, *size)
    window.show()
    turn(0.5)
    window.furnish()
    window.build_canvas()
    window.features["open"].open(mesh)
    until(lambda: window.session.document.is_open)
    settle(window)
    return window


def settle(window: Window) -> None:
    """Wait until everything is shown, the view has come to rest, and its shades are there."""
    window.refresh()
    turn(0.5)
    canvas = window.canvas
    until(lambda: not canvas.travel.under_way)
    canvas.draw_still()
    until(lambda: not canvas.lighting.under_way)
    turn(0.5)


def shoot(window: Window, path: Path) -> None:
    """Photograph the screen where the window stands."""
    settle(window)
    at = window.geometry()
    window.screen().grabWindow(0, at.x(), at.y(), at.width(), at.height()).save(str(path))
    compress(path)


def compress(path: Path) -> None:
    """Write a picture again, smaller."""
    image = Image.open(path).convert("RGB")
    image.save(path, optimize=True)
    if path.stat().st_size > _LARGE:
        _coarsened(image).save(path, optimize=True)
    print(f"{path}: {path.stat().st_size / 1000:.0f} kB")


def _coarsened(image: Image.Image) -> Image.Image:
    """The same with 32 shades of red, green and blue each, but for colours of whole areas, which stay."""
    pixels = np.asarray(image).reshape(-1, 3)
    _, which, counts = np.unique(pixels @ (1 << 16, 1 << 8, 1), return_inverse=True, return_counts=True)
    coarse = np.rint(np.rint(pixels * (31 / 255)) * (255 / 31))
    found = np.where((counts > _AREA * len(pixels))[which, None], pixels, coarse).astype(np.uint8)
    return Image.fromarray(found.reshape(image.height, image.width, 3))


def take(scenes: Scenes, folder: Path, prefix: str) -> None:
    """Photograph scenes, each in a window of its own, into files that are called after them."""
    with tempfile.TemporaryDirectory() as place:
        for scene, name, how in scenes:
            path = Path(place) / f"{name}.vtu"
            write(path, make(name, **how))
            window = opened(path)
            scene(window)
            shoot(window, folder / f"{prefix}-{scene.__name__}.png")
            shut(window)


def shut(window: Window) -> None:
    """Close the window, whatever is unsaved."""
    end_run(window.session)
    window.session.document.commit("shown", window.session.document.now)
    window.session.document.saved(window.session.document.path)
    window.close()
    turn(0.1)


# What is done in several pictures


def step_back(window: Window, share: float = 0.85) -> None:
    """Let what is seen be smaller, beside the colour bar."""
    settle(window)
    window.canvas.viewport.camera.Zoom(share)
    window.canvas.draw_soon()


def widen(window: Window, width: int, height: int) -> None:
    """Drag the figures beside the view to another size."""
    right = window.docks.drawer.parentWidget().parentWidget()
    right.setSizes([right.width() - width, width])
    right.widget(1).setSizes([right.height() - height, height])


def choose_entry(window: Window, name: str, data: str) -> None:
    """Choose from the list of a name."""
    box = next(one for one in window.findChildren(QComboBox) if one.accessibleName() == name)
    box.setCurrentIndex(box.findData(data))


def cut(window: Window, normal: tuple[float, float, float] = (1, 0, 0), crinkle: bool = True) -> None:
    """Cut through the middle, by whole hexes or smoothly."""
    middle = tuple(window.session.document.now.mesh.points.mean(axis=0))
    window.session.view.set_clip(PlaneClip.at(normal, middle, crinkle=crinkle))


def set_method(window: Window, name: str, **limits: float) -> None:
    """Have a method at hand, with its defaults, and limits of its run."""
    window.session.order.choose(Stage(METHODS[name](), StoppingCriteria(**limits)))
    window.refresh()


def run(window: Window, method: str, **limits: float) -> None:
    """Run a method from what is shown to its end."""
    set_method(window, method, **limits)
    window.features["smooth"].panel.run_or_pause()
    until(lambda: window.session.smoothing.phase is Phase.FINISHED)
    window.refresh()


def click(window: Window, name: str) -> None:
    """Click on the button or the box of a name."""
    next(one for one in window.findChildren(QAbstractButton) if name in (one.accessibleName(), one.text())).click()
    window.refresh()
