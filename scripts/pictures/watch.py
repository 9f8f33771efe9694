"""Take the pictures of docs/methods/watch.md, of gallery meshes.

Use: xvfb-run -s "-screen 0 1600x1000x24" python scripts/pictures/watch.py FOLDER
"""

from __future__ import annotations

import sys
from pathlib import Path

from screenshots import cut_mesh, run_method, set_method, take_screenshots, wait_until, zoom_out

from hexmend_app.picture.appearance import Arrows, Since, Traces
from hexmend_app.shell.window import Window
from hexmend_app.state.run.breakpoints import Breakpoints
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.theme.theme_choice import ThemeChoice, choose
from hexmend_app.widgets.section import Section


def cut_open(window: Window) -> None:
    """Cut through the middle, by whole hexes, without handles."""
    window.session.view.set_handles(False)
    cut_mesh(window)


def timeline(window: Window) -> None:
    """A run paused where a hex inverts; another view shows the iteration before, with the same cut and selected hex."""
    panel = window.features["smooth"].panel
    set_method(window, "laplacian", tolerance=0.0)
    next(section for section in panel.findChildren(Section) if section.isAncestorOf(panel.breakpoint_form)).expand()
    window.session.run.set_breakpoints(Breakpoints(inverts=True))
    window.features["smooth"].run_or_pause()
    wait_until(lambda: window.session.run.phase is Phase.PAUSED)
    window.session.timeline.step(-1)
    window.refresh()
    window.action("beside").trigger()
    window.session.timeline.go_to_newest()
    cut_open(window)


def convergence(window: Window) -> None:
    """Three runs, one of them a branch, and the selected iteration."""
    timeline = window.session.timeline
    window.show_panel("convergence")
    run_method(window, "mend", max_iterations=30)
    trunk = timeline.record
    timeline.go(trunk, 2)
    run_method(window, "local-sd", max_iterations=22)
    timeline.go(trunk, 0)
    run_method(window, "getme", max_iterations=26)
    timeline.choose(trunk)
    timeline.go(trunk, 4)
    cut_open(window)


def movement(window: Window) -> None:
    """Displacement since the mesh was opened, as colours and as arrows."""
    window.show_panel("movement")
    run_method(window, "mend", max_iterations=30)
    cut_open(window)
    window.session.view.change(movement=Traces(arrows=Arrows.SIGHT))
    window.session.view.colour_by("moved-most")
    window.refresh()
    window.canvas.look_along("+x")
    zoom_out(window, 0.8)


def change(window: Window) -> None:
    """Hexes that one iteration has improved, worsened, inverted and mended, in the dark theme."""
    choose(ThemeChoice.DARK)
    window.show_panel("movement")
    run_method(window, "laplacian", max_iterations=6)
    window.session.timeline.go(window.session.timeline.record, 1)
    window.session.view.change(movement=Traces(Since.ITERATION))
    window.session.view.colour_by("q-change")
    cut_open(window)


SCENES = (
    (timeline, "bridge-sharp", {"size": 4000}),
    (convergence, "bridge-sharp", {"size": 4000, "scramble": 0.4}),
    (movement, "bridge-sharp", {"size": 4000, "scramble": 0.4}),
    (change, "bridge-sharp", {"size": 4000, "scramble": 0.4}),
)


if __name__ == "__main__":
    take_screenshots(SCENES, Path(sys.argv[1]), "watch")
