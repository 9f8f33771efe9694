"""Take the README's pictures: open a mesh in the window, cut it, run the default method, pause, step.

Use: xvfb-run -s "-screen 0 1600x1000x24" python scripts/pictures/readme.py MESH FOLDER
"""

from __future__ import annotations

import sys
from pathlib import Path

from screenshots import close_window, cut_mesh, open_window, screenshot, set_method, wait_until

from hexmend_app.shell.window import Window
from hexmend_app.state.run.run_controller import Phase

_SIZE = (1240, 780)


def pause(window: Window) -> None:
    """Run the default method, and pause it after a few iterations."""
    set_method(window, "mend")
    smooth = window.features["smooth"]
    smooth.step()
    wait_until(lambda: window.session.run.phase in (Phase.PAUSED, Phase.FINISHED))
    for _ in range(3):
        if window.session.run.phase is Phase.PAUSED:
            window.refresh()
            smooth.step()
            wait_until(lambda: window.session.run.phase in (Phase.PAUSED, Phase.FINISHED))


def main(mesh: str, folder: Path) -> None:
    """Take all pictures."""
    window = open_window(mesh, _SIZE)
    window.show_panel("cut")
    cut_mesh(window)
    screenshot(window, folder / "window-cut.png")
    pause(window)
    window.session.view.set_handles(False)
    cut_mesh(window, crinkle=False)
    window.show_panel("run")
    screenshot(window, folder / "window-smoothing.png")
    close_window(window)


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]))
