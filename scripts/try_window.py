"""Do the tutorial in a real window by mouse and keys, and check what is seen.

Use: python scripts/try_window.py [FOLDER]

Starts a virtual screen with a window manager, `hexmend` on it, and goes through tutorial.md with xdotool: looks at
the demo, isolates the inverted hexes by a click on their bar, cuts, runs mend, undoes, compares and saves. What is seen
is judged by the pixels of screenshots, which are written to FOLDER. Needs the Debian packages xvfb, openbox, xdotool
and imagemagick. Returns 1 with a sentence at the first step that fails.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from PIL import Image

#: Size of the screen, and seconds until a step must have had its effect.
SIZE, PATIENCE = (1366, 768), 60.0

#: Programs that are needed, by their Debian packages.
_PROGRAMS = {"Xvfb": "xvfb", "openbox": "openbox", "xdotool": "xdotool", "import": "imagemagick"}

#: Part of the screen that the view takes, and the part of the histogram, as left, top, right, bottom.
VIEW, HISTOGRAM = (0.0, 0.08, 0.66, 0.87), (0.80, 0.60, 1.0, 0.92)


class Failed(Exception):
    """A step had not the effect that the tutorial tells of."""


class Screen:
    """A virtual screen with a window on it, and the hands and eyes of a user.

    Parameters
    ----------
    display : str
        Name of the display, such as ":7".
    folder : Path
        Gets the screenshots.
    """

    def __init__(self, display: str, folder: Path):
        self.environment = os.environ | {"DISPLAY": display}
        self.folder = folder

    def start(self, *words: str) -> subprocess.Popen[bytes]:
        """Start a program on the screen."""
        return subprocess.Popen(words, env=self.environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def do(self, *words: str) -> str:
        """Let xdotool do something; return what it prints."""
        return subprocess.run(["xdotool", *words], env=self.environment, capture_output=True, text=True).stdout

    def key(self, *keys: str) -> None:
        """Press keys one after another."""
        for name in keys:
            self.do("key", "--clearmodifiers", name)
            time.sleep(0.3)

    def click(self, x: int, y: int) -> None:
        """Click at a point of the screen."""
        self.do("mousemove", str(x), str(y))
        time.sleep(0.2)
        self.do("click", "1")
        time.sleep(0.3)

    def look(self, name: str) -> np.ndarray:
        """Take a screenshot, which gets a name, and return its pixels, (h, w, 3) int."""
        path = self.folder / f"{name}.png"
        subprocess.run(["import", "-window", "root", str(path)], env=self.environment, check=True)
        return np.asarray(Image.open(path).convert("RGB")).astype(int)

    def titles(self) -> list[str]:
        """List the titles of all windows."""
        ids = self.do("search", "--name", ".").split()
        return [self.do("getwindowname", one).strip() for one in ids]

    def wait_until(self, what: str, seen: Callable[[], bool]) -> None:
        """Wait until something is seen."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            if seen():
                return
            time.sleep(0.3)
        raise Failed(f"{what}: not seen within {PATIENCE:g} s")


def part(pixels: np.ndarray, box: tuple[float, float, float, float]) -> np.ndarray:
    """Return the pixels of a part of the screen."""
    height, width = pixels.shape[:2]
    left, top, right, bottom = box
    return pixels[round(top * height) : round(bottom * height), round(left * width) : round(right * width)]


def magenta(pixels: np.ndarray) -> np.ndarray:
    """Return True for pixels of inverted hexes and of their bar, (h, w) bool."""
    red, green, blue = (pixels[..., k] for k in range(3))
    return (red > 150) & (green < 110) & (blue > 70) & (red - green > 90) & (blue - green > 30)


def bar_of_inverted(pixels: np.ndarray) -> tuple[int, int]:
    """Return a point on the histogram's bar of inverted hexes."""
    height, width = pixels.shape[:2]
    red, green, blue = (part(pixels, HISTOGRAM)[..., k] for k in range(3))
    pink = (red > 200) & (red - green > 60) & (blue - green > 20)  # the bar is translucent
    rows, columns = np.nonzero(pink)
    if not rows.size:
        raise Failed("the bar of inverted hexes: not seen in the histogram")
    column = int(np.bincount(columns).argmax())
    row = int(np.median(rows[columns == column]))
    return round(HISTOGRAM[0] * width) + column, round(HISTOGRAM[1] * height) + row


def tutorial(screen: Screen, saved: Path) -> Iterator[str]:
    """Go through the tutorial; yield each step that has had its effect."""
    screen.wait_until("the demo", lambda: any(title.startswith("demo.vtu") for title in screen.titles()))
    time.sleep(8)  # panels are built, and the card goes
    opened = screen.look("1-opened")
    count = int(magenta(part(opened, VIEW)).sum())
    if count < 500:
        raise Failed(f"inverted hexes of the demo: {count} pixels of their colour, expected 500 or more")
    yield "the demo is open, its inverted hexes are seen"

    screen.click(*bar_of_inverted(opened))
    screen.wait_until("inverted hexes alone", lambda: _changed(screen.look("2-inverted"), opened) > 0.05)
    yield "a click on the bar isolates the inverted hexes"
    screen.do("mousemove", "400", "400")
    screen.key("Escape")
    screen.wait_until("the whole mesh", lambda: _changed(screen.look("2-whole"), opened) < 0.03)
    yield "Esc shows the whole mesh"

    screen.key("c")
    screen.wait_until("the cut", lambda: _changed(screen.look("3-cut"), opened) > 0.05)
    cut = int(magenta(part(screen.look("3-cut"), VIEW)).sum())
    if cut < 500:
        raise Failed(f"inverted hexes in the cut: {cut} pixels of their colour, expected 500 or more")
    screen.key("F5")
    screen.wait_until("a mended mesh", lambda: magenta(part(screen.look("3-mended"), VIEW)).sum() < 100)
    yield "C cuts the mesh, F5 mends it: no inverted hex is seen"
    screen.wait_until("changes in the title", lambda: any("demo.vtu*" in title for title in screen.titles()))

    screen.key("ctrl+s")
    screen.wait_until("the dialog that saves", lambda: any("Save" in title for title in screen.titles()))
    time.sleep(1)
    screen.key("ctrl+a")
    screen.do("type", "--delay", "20", str(saved))
    screen.key("Return")
    screen.wait_until("the saved mesh", saved.exists)
    yield "Ctrl+S saves the mended mesh"

    screen.key("ctrl+z")
    screen.wait_until("inverted hexes again", lambda: magenta(part(screen.look("4-undone"), VIEW)).sum() > 500)
    yield "Ctrl+Z undoes the run"
    undone = screen.look("4-undone")
    screen.key("F6")
    screen.wait_until("the table of methods", lambda: _changed(screen.look("4-compared"), undone, (0, 0, 1, 1)) > 0.1)
    yield "F6 compares methods"


def _changed(now: np.ndarray, before: np.ndarray, box: tuple[float, float, float, float] = VIEW) -> float:
    """Return the share of the pixels of a part that differ clearly."""
    return float((np.abs(part(now, box) - part(before, box)).sum(axis=2) > 60).mean())


@contextmanager
def virtual_screen(folder: Path) -> Iterator[Screen]:
    """Start a virtual screen with a window manager and `hexmend` on it, in a home of its own."""
    missing = [package for program, package in _PROGRAMS.items() if shutil.which(program) is None]
    if missing:
        raise Failed(f"programs of the Debian packages {', '.join(missing)}: not found; install them first")
    display = f":{os.getpid() % 500 + 90}"
    size = "x".join(map(str, SIZE))
    server = subprocess.Popen(["Xvfb", display, "-screen", "0", f"{size}x24"], stderr=subprocess.DEVNULL)
    time.sleep(1)
    with tempfile.TemporaryDirectory(prefix="hexmend-home-") as home:
        screen = Screen(display, folder)
        screen.environment |= {"HOME": home, "XDG_CONFIG_HOME": f"{home}/config"}
        started = [screen.start("openbox")]
        time.sleep(0.5)
        started.append(screen.start(str(Path(sys.executable).with_name("hexmend"))))
        try:
            screen.wait_until("a window", lambda: bool(screen.do("search", "--name", "demo.vtu").split()))
            window = screen.do("search", "--name", "demo.vtu").split()[-1]
            screen.do("windowmove", window, "0", "0")
            screen.do("windowsize", window, *map(str, SIZE))
            yield screen
        finally:
            for program in [*reversed(started), server]:
                program.terminate()
            for program in [*started, server]:
                program.wait()


def main(folder: Path) -> int:
    """Do the tutorial; return the exit status."""
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="hexmend-saved-") as place:
        try:
            with virtual_screen(folder) as screen:
                for step in tutorial(screen, Path(place) / "mended.vtu"):
                    print(f"ok: {step}", flush=True)
        except Failed as error:
            print(f"failed: {error}", file=sys.stderr)
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1] if len(sys.argv) > 1 else "build/window")))
