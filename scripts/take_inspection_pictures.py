"""Takes the pictures of docs/inspect.md, of meshes that the gallery makes.

Use: xvfb-run -s "-screen 0 1600x1000x24" python scripts/take_inspection_pictures.py FOLDER
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from take_screenshots import take, turn, until

from hexmend_app.scene.palette import Choice
from hexmend_app.shell.window import Window
from hexmend_app.state.clip import BoxClip, PlaneClip
from hexmend_app.state.look import ColourScale, RangeMode, Structure, ValueRange
from hexmend_app.state.run import Phase
from hexmend_app.widgets.theming import choose


def worst(window: Window) -> None:
    """The worst element, isolated, with the quality at its corners; the list beside the histogram."""
    window.features["inspect"].panel._in_view.click()
    window.features["inspect"].worst_list.next()
    window.show_panel("worst")
    turn(1)


def box(window: Window) -> None:
    """A box cut out, smoothly, in the colours of another metric."""
    low, high = window.session.document.now.mesh.points.min(axis=0), window.session.document.now.mesh.points.max(axis=0)
    window.session.view.change(
        clip=BoxClip(tuple((low + high) / 2 * (1, 0, 1)), tuple(high), crinkle=False, notch=True),
        scale=ColourScale("scaled-jacobian", mode=RangeMode.FITTED),
    )


def structure(window: Window) -> None:
    """Irregular edges seen through the mesh, fixed nodes on what a cut has left."""
    middle = tuple(window.session.document.now.mesh.points.mean(axis=0))
    window.session.view.set_handles(False)
    window.session.view.change(
        clip=PlaneClip.at((1, -1, 0), middle), structure=Structure(irregular=True, sharp=True, fixed=True, free=True)
    )


def inside(window: Window) -> None:
    """Two layers peeled, elements shrunk, only those of middling quality."""
    window.session.view.change(peel=2, shrink=0.35, quality_range=ValueRange("q", 0.2, 0.8))


def compared(window: Window) -> None:
    """Three methods in one histogram, as the thesis's Figure 4.9 compares them; as shares up to each quality."""
    window.features["histogram"].panel.head.cumulative.trigger()
    for method in ("laplacian", "getme", "mend"):
        window.features["smooth"].panel.set_method(method)
        window.features["smooth"].panel.run_or_pause()
        until(lambda: window.session.smoothing.phase is Phase.FINISHED)
        window.features["histogram"].panel.keep_requested.emit()
        window.session.commands.reset()
    window.features["smooth"].panel.run_or_pause()
    until(lambda: window.session.smoothing.phase is Phase.FINISHED)


def dark(window: Window) -> None:
    """Tags in the dark theme."""
    choose(Choice.DARK)
    figures = window.session.document.now.figures
    window.session.commands.tag("inverted", np.flatnonzero(figures.inverted))
    window.session.commands.tag("flat", np.flatnonzero(~figures.inverted & (figures.q < 0.3)))
    window.show_panel("tags")
    window.session.view.change(
        clip=PlaneClip.at((1, 0, 0), tuple(window.session.document.now.mesh.points.mean(axis=0)))
    )


SCENES = (
    (worst, "bridge-sharp", {"scramble": 0.25}),
    (box, "bridge-sharp", {"size": 12000, "scramble": 0.3}),
    (structure, "five-side", {"size": 2400}),
    (inside, "bridge-sharp", {"size": 4000, "scramble": 0.4}),
    (compared, "bridge-sharp", {"size": 9000, "scramble": 0.3}),
    (dark, "bridge-sharp", {"size": 12000, "scramble": 0.4}),
)


if __name__ == "__main__":
    take(SCENES, Path(sys.argv[1]), "inspect")
