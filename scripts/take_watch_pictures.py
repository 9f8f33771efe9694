"""Takes pictures of docs/watch.md, of meshes that the gallery makes.

Use: xvfb-run -s "-screen 0 1600x1000x24" python scripts/take_watch_pictures.py FOLDER
"""

from __future__ import annotations

import sys
from pathlib import Path

from take_screenshots import take, turn, until

from hexmend.run.breakpoints import Breakpoints
from hexmend_app.scene.palette import Choice
from hexmend_app.shell.window import Window
from hexmend_app.state.clip import PlaneClip
from hexmend_app.state.look import Arrows, Since, Traces
from hexmend_app.state.run import Phase
from hexmend_app.widgets.theming import choose


def run(window: Window, method: str, iterations: int) -> None:
    """Run a method from what is shown on."""
    window.features["smooth"].panel.set_method(method)
    window.features["smooth"].panel.stop_form.set_values({"max_iterations": iterations})
    window.features["smooth"].panel.run_or_pause()
    until(lambda: window.session.smoothing.phase is Phase.FINISHED)
    turn(0.2)


def cut(window: Window) -> None:
    """Cut through the middle, by whole elements, without handles."""
    window.session.view.set_handles(False)
    window.session.view.set_clip(PlaneClip.at((1, 0, 0), tuple(window.session.document.now.mesh.points.mean(axis=0))))


def timeline(window: Window) -> None:
    """Paused where an element inverts, the iteration before kept in a view, the cut and the chosen element in both."""
    panel = window.features["smooth"].panel
    panel.set_method("laplacian")
    panel.stop_form.set_values({"tolerance": 0.0})
    panel.show_break_points()
    panel.breakpoint_form.set_breakpoints(Breakpoints(inverts=True))
    panel.run_or_pause()
    until(lambda: window.session.smoothing.phase is Phase.PAUSED)
    window.session.timeline.step(-1)
    window.actions["beside"].trigger()
    window.session.timeline.go_to_newest()
    cut(window)


def convergence(window: Window) -> None:
    """Three runs, of which one is a branch, and the iteration gone to."""
    timeline = window.session.timeline
    window.show_panel("convergence")
    run(window, "mend", 30)
    trunk = timeline.record
    timeline.go(trunk, 2)
    run(window, "local-sd", 22)
    timeline.go(trunk, 0)
    run(window, "getme", 26)
    timeline.choose(trunk)
    timeline.go(trunk, 4)
    cut(window)


def movement(window: Window) -> None:
    """Displacement since the mesh was opened, as colours and as arrows."""
    window.show_panel("movement")
    run(window, "mend", 30)
    cut(window)
    window.session.view.change(traces=Traces(arrows=Arrows.SIGHT))
    window.features["look"].panel.choose_metric("moved-most")
    window.canvas.look_along("+x")


def change(window: Window) -> None:
    """What one iteration has made better, worse, inverted and mended; in the dark theme."""
    choose(Choice.DARK)
    window.show_panel("movement")
    run(window, "laplacian", 6)
    window.session.timeline.go(window.session.timeline.record, 1)
    window.session.view.change(traces=Traces(Since.ITERATION))
    window.features["look"].panel.choose_metric("q-change")
    cut(window)


SCENES = (
    (timeline, "bridge-sharp", {"size": 4000}),
    (convergence, "bridge-sharp", {"size": 4000, "scramble": 0.4}),
    (movement, "bridge-sharp", {"size": 4000, "scramble": 0.4}),
    (change, "bridge-sharp", {"size": 4000, "scramble": 0.4}),
)


if __name__ == "__main__":
    take(SCENES, Path(sys.argv[1]), "watch")
