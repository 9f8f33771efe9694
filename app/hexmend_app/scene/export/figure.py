"""Pictures of several meshes side by side, or of two wiped over one another, as a paper compares methods."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from PIL import Image, ImageDraw
from vtkmodules.vtkRenderingCore import vtkCamera

from hexmend.mesh import Mesh
from hexmend.movement import Movement
from hexmend.quality import ElementQuality
from hexmend_app.scene.arrangement import columns
from hexmend_app.scene.export.picture import INK, colour_bar, letters, paper, pen_of, strip_height
from hexmend_app.scene.filters import Filters
from hexmend_app.scene.frame import Frame
from hexmend_app.scene.panes import Panes
from hexmend_app.scene.stage import Stage
from hexmend_app.state.look import Look
from hexmend_app.state.views import Wipe

#: Height of a row of captions, by that of the colour bar.
_CAPTION = 0.8


@dataclass(frozen=True, eq=False)
class Panel:
    """One mesh of several.

    Parameters
    ----------
    name : str
        What its caption calls it.
    mesh : Mesh
    figures : ElementQuality
        Of the mesh.
    """

    name: str
    mesh: Mesh
    figures: ElementQuality

    @property
    def said(self) -> str:
        """What its caption says beside the name."""
        inverted = self.figures.n_inverted
        return f"q min {self.figures.q.min():.4f}, {f'{inverted:,}' if inverted else 'none'} inverted"


def figure(
    panels: Sequence[Panel],
    look: Look,
    size: tuple[int, int],
    *,
    filters: Filters | None = None,
    movement: Movement | None = None,
    view: str | tuple[float, float, float] = "iso",
    camera: vtkCamera | None = None,
    wipe: Wipe | None = None,
    transparent: bool = False,
    bar: bool = True,
) -> Image.Image:
    """Draw meshes with one camera, one look and one range of colours, each under its name and figures.

    Parameters
    ----------
    panels : sequence of Panel
        Two to four.
    look : Look
    size, filters, view, camera, transparent, bar
        As for `hexmend_app.scene.export.picture.picture`.
    movement : Movement, optional
        Of the first; the others compare with the same moment.
    wipe : Wipe, optional
        Lays two of them over one another; None shows all side by side.
    """
    width, height = size
    unit = strip_height(size)
    strip, line = unit if bar and not look.neutral else 0, round(_CAPTION * unit)
    above = 0 if wipe is None else line  # views side by side leave room for captions themselves
    with Stage((width, height - strip - above)) as stage:
        panes = Panes(stage.window, filters, pen_of(size))
        panes.leave_heads(line)
        first, *others = panels
        panes.draw(Frame(first.mesh, first.figures, movement, look))
        panes.show([(other.mesh, other.figures) for other in others], wipe)
        panes.eye.look_along(view)
        if camera is not None:
            panes.eye.camera.DeepCopy(camera)
            panes.eye.reset_depth()
        panes.still()
        panes.shade()
        image = Image.fromarray(stage.picture(transparent))
    whole = paper(size, image.mode)
    whole.paste(image, (0, above))
    if line:
        _write(whole, panels, wipe, line, above + image.height)
    if strip:
        apart = [(name, None, colour) for name, _, colour in panes.first.colours.apart]
        whole.paste(colour_bar(panes.first.colouring, apart, (width, strip), image.mode), (0, height - strip))
    return whole


def _write(whole: Image.Image, panels: Sequence[Panel], wipe: Wipe | None, line: int, below: int) -> None:
    """Write the captions above the views, of a wipe on either side; the picture of the views ends at `below`."""
    draw = ImageDraw.Draw(whole)
    if wipe is not None:
        edge = round(wipe.at * whole.width)
        draw.line((edge, line, edge, below - 1), INK, max(1, line // 12))
        panels = [panels[wipe.left], panels[wipe.right]]
    across = columns(len(panels))
    rows = len(panels) // across
    for k, panel in enumerate(panels):
        row, at = divmod(k, across)
        top = round(row * below / rows)
        if at == 0:
            whole.paste(paper((whole.width, line), whole.mode), (0, top))
        _caption(draw, panel, at * whole.width / across, top, whole.width / across, line)


def _caption(draw: ImageDraw.ImageDraw, panel: Panel, left: float, top: float, room: float, line: int) -> None:
    gap = line / 3
    for share in np.linspace(0.5, 0.2, 7):  # smaller until it fits
        name, plain = letters(share * line, bold=True), letters(share * line)
        if 3 * gap + name.getlength(panel.name) + plain.getlength(panel.said) <= room:
            break
    draw.text((left + gap, top + line / 2), panel.name, INK, name, anchor="lm")
    draw.text((left + 2 * gap + name.getlength(panel.name), top + line / 2), panel.said, INK, plain, anchor="lm")
