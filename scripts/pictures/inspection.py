"""Take the pictures of docs/repair/inspect.md, of gallery meshes.

Use: xvfb-run -s "-screen 0 1600x1000x24" python scripts/pictures/inspection.py FOLDER
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from screenshots import (
    choose_entry,
    click,
    cut_mesh,
    resize_panels,
    run_method,
    take_screenshots,
    wait_until_drawn,
    zoom_out,
)

from hexmend_app.picture.appearance import Structure
from hexmend_app.picture.colours import Range
from hexmend_app.picture.cut import Cut, CutStyle
from hexmend_app.picture.cut_shapes import Box
from hexmend_app.shell.window import Window
from hexmend_app.theme.theme_choice import ThemeChoice, choose


def worst(window: Window) -> None:
    """The worst hex, isolated, with the quality at its corners; the list of the worst below the view."""
    window.show_panel("worst")
    choose_entry(window, "Worst by", "scaled-jacobian")
    click(window, "Corner qualities in the view")
    window.action("next_worst").trigger()
    wait_until_drawn(window)


def box(window: Window) -> None:
    """A box cut out, smoothly, in the colours of another metric."""
    points = window.session.document.now.mesh.points
    low, high = points.min(axis=0), points.max(axis=0)
    window.session.view.change(
        cut=Cut(box=Box(tuple((low + high) / 2 * (1, 0, 1)), tuple(high)), style=CutStyle.SMOOTH, notch=True),
        colours={"metric": "scaled-jacobian", "range": Range.FITTED},
    )
    window.show_panel("look")
    zoom_out(window)


def structure(window: Window) -> None:
    """Irregular edges seen through the mesh, fixed nodes on a cut mesh."""
    window.session.view.set_handles(False)
    cut_mesh(window, (1, -1, 0))
    window.session.view.change(structure=Structure.of("irregular", "sharp", "fixed", "free"))
    window.show_panel("show")


def inside(window: Window) -> None:
    """Two layers peeled, hexes shrunk, only those of medium quality."""
    window.session.view.change(show={"peel": 2, "shrink": 0.35, "quality": (0.2, 0.8)})
    window.show_panel("inside")
    zoom_out(window)


def compared(window: Window) -> None:
    """Three methods in one cumulative histogram, compared as in Figure 4.9 of the thesis."""
    resize_panels(window, 480, 460)
    window.features["histogram"].panel.head.cumulative.trigger()
    for method in ("laplacian", "getme", "mend"):
        run_method(window, method)
        click(window, "Keep")
        window.session.commands.reset()
    run_method(window, "mend")
    zoom_out(window)


def dark(window: Window) -> None:
    """Tags in the dark theme."""
    choose(ThemeChoice.DARK)
    figures = window.session.document.now.quality
    window.session.commands.tag("inverted", np.flatnonzero(figures.inverted))
    window.session.commands.tag("flat", np.flatnonzero(~figures.inverted & (figures.q < 0.3)))
    window.action("tags").trigger()
    cut_mesh(window)


SCENES = (
    (worst, "bridge-sharp", {"scramble": 0.25}),
    (box, "bridge-sharp", {"size": 12000, "scramble": 0.3}),
    (structure, "five-side", {"size": 2400}),
    (inside, "bridge-sharp", {"size": 4000, "scramble": 0.4}),
    (compared, "bridge-sharp", {"size": 9000, "scramble": 0.3}),
    (dark, "bridge-sharp", {"size": 12000, "scramble": 0.4}),
)


if __name__ == "__main__":
    take_screenshots(SCENES, Path(sys.argv[1]), "inspect")
