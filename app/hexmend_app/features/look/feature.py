"""How the mesh is looked at: the lines between the look, the panels that change it, and the view that shows it."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from hexmend_app.features.cut.clip_panel import ClipPanel
from hexmend_app.features.cut.inside_panel import InsidePanel
from hexmend_app.features.look.colour_panel import ColourPanel
from hexmend_app.features.structure.structure_panel import StructurePanel
from hexmend_app.scene.frame import Frame
from hexmend_app.state.document import State
from hexmend_app.state.look import Arrows, Look
from hexmend_app.state.movement import MOVEMENTS, Movement
from hexmend_app.state.session import Session

if TYPE_CHECKING:
    from hexmend_app.canvas.canvas import Canvas


class Looking:
    """Carries the user's wishes to the look, and the look to whatever shows it.

    Parameters
    ----------
    session : Session
        The window's state.
    colour_panel, clip_panel, inside_panel, structure_panel
        The widgets that change the look.
    """

    def __init__(
        self,
        session: Session,
        colour_panel: ColourPanel,
        clip_panel: ClipPanel,
        inside_panel: InsidePanel,
        structure_panel: StructurePanel,
    ):
        view = self._view = session.view
        self._document, self._finder = session.document, session.finder
        self._colours = colour_panel
        self._clip = clip_panel
        self._inside = inside_panel
        self._structure = structure_panel
        self._canvas: Canvas | None = None
        self._references = session.references
        self._drawn: State | None = None  # the document's start, of the mesh that the view has
        view.look_changed.connect(self._on_look_changed)
        colour_panel.scale_changed.connect(lambda scale: view.change(scale=scale))
        clip_panel.clip_changed.connect(view.set_clip)
        clip_panel.plane_chosen.connect(view.choose_plane)
        clip_panel.handles_changed.connect(view.set_handles)
        clip_panel.snap_changed.connect(view.set_snap)
        inside_panel.peel_changed.connect(lambda layers: view.change(peel=layers))
        inside_panel.shrink_changed.connect(lambda share: view.change(shrink=share))
        inside_panel.outline_changed.connect(lambda on: view.change(outline=on))
        inside_panel.rings_changed.connect(view.set_rings)
        inside_panel.all_requested.connect(view.end_isolation)
        inside_panel.undo_requested.connect(view.undig_last)
        inside_panel.put_back_requested.connect(view.undig_all)
        structure_panel.structure_changed.connect(lambda structure: view.change(structure=structure))
        session.finder.found.connect(self._on_found)

    def set_canvas(self, canvas: Canvas) -> None:
        """Take the 3D view, which comes later than the rest."""
        self._canvas = canvas
        canvas.plane_dragged.connect(self._view.drag_plane)
        canvas.box_dragged.connect(self._view.drag_box)
        self._draw()

    def handlers(self) -> dict[str, Callable]:
        """What its actions do, by id."""
        directions = {"view_iso": "iso", "view_x": "+x", "view_y": "+y", "view_z": "+z"}
        return {
            "fit": lambda: self._canvas.fit(),
            "parallel": lambda on: self._canvas.set_parallel(on),
            "edges": lambda on: self._view.change(edges=on),
            "clip": self._switch_clip,
            **{id: lambda along=along: self._canvas.look_along(along) for id, along in directions.items()},
            **{f"show_{name}": lambda on, name=name: self._switch(name, on) for name in self._structure.offered()},
        }

    def offered(self) -> dict[str, bool]:
        """Which of its actions can be done now."""
        return {f"show_{name}": on for name, on in self._structure.offered().items()}

    def checked(self) -> dict[str, bool]:
        """Which of its actions are on."""
        look = self._view.look
        layers = {f"show_{name}": on for name, on in dataclasses.asdict(look.structure).items()}
        return {"edges": look.edges, "clip": look.clip is not None, **layers}

    def show_another(self) -> None:
        """Take another mesh, of which nothing is hidden."""
        now = self._document.now
        self._view.show_another()
        self._structure.set_found(self._finder.structure)
        self._inside.set_layers(int(now.mesh.topology.layers.max()))
        points = now.mesh.points[now.mesh.topology.used]
        low, high = points.min(axis=0), points.max(axis=0)
        self._clip.set_bounds(tuple(float(c) for pair in zip(low, high, strict=True) for c in pair))
        if self._canvas is not None:
            self._canvas.show()
            self._drawn = self._document.start
            self._draw()

    def move(self, live: bool) -> None:
        """Show the nodes where they are now; `live` where they go on moving."""
        self._draw(live)

    def refresh(self) -> None:
        """Say what is shown, and what the colours stand for."""
        if self._canvas is not None and self._document.is_open:
            self._colours.set_ends(self._canvas.colouring.low, self._canvas.colouring.high)
            self._inside.set_shown(self._canvas.viewport.shown, self._document.now.mesh.n_hexes)
        if self._document.is_open:
            self._count_nodes()

    def set_enabled(self, on: bool) -> None:
        """Let the user change the look, or not."""
        for panel in (self._colours, self._clip, self._inside, self._structure):
            panel.setEnabled(on)

    def _on_look_changed(self) -> None:
        look = self._view.look
        self._colours.set_scale(look.scale)
        self._clip.set_clip(look.clip, self._view.plane_at)
        self._clip.set_handles(self._view.handles)
        self._inside.set_look(look, self._view.rings)
        self._structure.set_structure(look.structure)
        self._draw()
        self.refresh()

    def _draw(self, live: bool = False) -> None:
        if self._canvas is not None and self._document.is_open and self._drawn is self._document.start:
            now = self._document.now
            self._canvas.show_handles(self._view.handles, self._view.plane_at)
            self._canvas.draw(Frame(now.mesh, now.figures, self._movement(), self._drawable()), live)

    def _movement(self) -> Movement | None:
        """What the view shows of a movement, if anything."""
        look = self._view.look
        wanted = look.scale.metric in MOVEMENTS or look.traces.arrows is not Arrows.NONE
        return self._references.movement(look.traces.since) if wanted else None

    def _on_found(self) -> None:
        self._structure.set_found(self._finder.structure)
        self._draw()

    def _drawable(self) -> Look:
        """The look, but for edges that are still being found: the view would wait for them."""
        look = self._view.look
        known = self._finder.structure is not None
        return look if known else dataclasses.replace(look, structure=look.structure.without_edges())

    def _switch(self, layer: str, on: bool) -> None:
        self._view.change(structure=dataclasses.replace(self._view.look.structure, **{layer: on}))

    def _count_nodes(self) -> None:
        now = self._document.now
        mesh, boundary = now.mesh, now.mesh.topology.boundary
        pinned = 0 if mesh.pinned is None else np.count_nonzero(mesh.pinned & mesh.topology.used & ~boundary)
        self._structure.set_nodes(
            np.count_nonzero(boundary), pinned, now.summary.free_nodes, now.summary.locked_inverted
        )  # fmt: skip

    def _switch_clip(self, on: bool) -> None:
        if on != (self._view.look.clip is not None):
            self._view.set_clip(self._clip.proposal() if on else None)
