"""Takes the README's pictures: opens a mesh in the window, cuts it, runs the default method, pauses, steps.

Use: xvfb-run -s "-screen 0 1600x1000x24" python scripts/take_screenshots.py MESH FOLDER
"""

from __future__ import annotations

import sys
from pathlib import Path

from photographs import cut, opened, set_method, shoot, shut, until

from hexmend_app.shell.window import Window
from hexmend_app.state.run import Phase

_SIZE = (1240, 780)


def pause(window: Window) -> None:
    """Run the default method, and hold it after a few iterations."""
    set_method(window, "mend")
    panel = window.features["smooth"].panel
    panel.step()
    until(lambda: window.session.smoothing.phase in (Phase.PAUSED, Phase.FINISHED))
    for _ in range(3):
        if window.session.smoothing.phase is Phase.PAUSED:
            window.refresh()
            panel.step()
            until(lambda: window.session.smoothing.phase in (Phase.PAUSED, Phase.FINISHED))


def main(mesh: str, folder: Path) -> None:
    """Go through the scenes."""
    window = opened(mesh, _SIZE)
    window.show_panel("cut")
    cut(window)
    shoot(window, folder / "window-cut.png")
    pause(window)
    window.session.view.set_handles(False)
    cut(window, crinkle=False)
    window.show_panel("run")
    shoot(window, folder / "window-smoothing.png")
    shut(window)


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]))
