"""Frames of a film of a run: pages of evenly spaced iterations."""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from contextlib import ExitStack
from dataclasses import replace

import numpy as np
from PIL import Image

from hexmend_app.picture import PicturePanel, Scene
from hexmend_app.picture.appearance import Since
from hexmend_app.picture.displacement import Displacement, ReferenceState
from hexmend_app.scene.page.layout import Layout
from hexmend_app.scene.page.page_mesh import PageMesh
from hexmend_app.scene.page.page_renderer import PageRenderer
from hexmend_app.scene.page.rasters import PageViews, page_views
from hexmend_app.state.mesh.document import MeasuredMesh
from hexmend_app.state.mesh.history import History
from hexmend_app.state.mesh.run_record import RunRecord


def chosen_iterations(history: History, record: RunRecord, frames: int) -> list[int]:
    """Return the numbers of at most `frames` recorded iterations, including the first and the last."""
    recorded = history.recorded_numbers(record)
    positions = np.linspace(0, len(recorded) - 1, min(frames, len(recorded)))
    return recorded[np.unique(positions.round().astype(int))].tolist()


def _place(record: RunRecord, number: int) -> str:
    return record.label(number) if record.holds_times else f"iteration {number} of {record.newest}"


def pictures(
    record: RunRecord,
    numbers: Sequence[int],
    state: Callable[[int], MeasuredMesh],
    scene: Scene,
    *,
    movement: Displacement | None = None,
    histogram: bool = False,
    before: bool = False,
    aspect: float = 0.0,
) -> Generator[Image.Image]:
    """Generate the pictures of iterations of a run: pages of a scene, drawn off screen with the same camera.

    Parameters
    ----------
    record : RunRecord
    numbers : sequence of int
        Numbers of the iterations.
    state : callable
        Returns the state of an iteration by its number; states differ in positions of nodes only.
    scene : Scene
        Its panels are replaced.
    movement : Displacement, optional
        Movement with the reference state of all frames, if the scene shows a movement; a movement since the last
        iteration refers to the last frame instead.
    histogram : bool
        Draw a histogram of the coloured values.
    before : bool
        Show the first frame on the left of all frames, and its distribution as a line in the histogram.
    aspect : float
        Width by height of the view whose pose the camera has: nothing is cropped at its sides.
    """
    scene = replace(scene, page=replace(scene.page, supersampling=1, crop=False))
    meshes: list[PageMesh] = []
    views: PageViews | None = None
    last: ReferenceState | None = None
    with ExitStack() as stack:
        for number in numbers:
            place, now = _place(record, number), state(number)
            mesh, quality = now.mesh, now.quality
            if movement is not None:
                current = ReferenceState(mesh.points, quality, "the last frame")
                start = last if scene.movement.since is Since.ITERATION else movement.before
                movement = Displacement(movement.mesh, start or current, mesh.points, quality)
                last = current
            shown = PageMesh(mesh, quality, movement, name=place if before else f"{record.title}, {place}")
            meshes = [*(meshes[:1] or [replace(shown, name="Before")]), shown] if before else [shown]
            panels = tuple(PicturePanel(mesh=at, caption=one.name) for at, one in enumerate(meshes, 1))
            layout = Layout.of(replace(scene, panels=panels), meshes, figures=True, histogram=histogram)
            if views is None:
                views = stack.enter_context(page_views(layout, aspect=aspect))
            else:
                views.show(len(meshes), shown)
            yield PageRenderer(layout, views.rasters(layout)).image()
