"""Off-screen film of a recorded run, for scripts that reproduce films of a window."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from vtkmodules.vtkRenderingCore import vtkCamera

from hexmend.mesh.mesh import Mesh
from hexmend_app.picture import Scene
from hexmend_app.scene.film.film import format_of, pictures, write_film
from hexmend_app.scene.film.film_frames import film_frames
from hexmend_app.scene.page.still_picture import movement_since
from hexmend_app.scene.render.graphics import prepare_off_screen
from hexmend_app.scene.render.rasters import aim
from hexmend_app.state.mesh.document import State
from hexmend_app.state.mesh.run_record import RunRecord


def write_run_film(
    path: str | Path,
    scene: Scene,
    run: RunRecord,
    mesh: Mesh,
    numbers: Sequence[int],
    *,
    size: tuple[int, int],
    rate: float,
    histogram: bool = False,
    before: bool = False,
    opened: Mesh | None = None,
    since: Mesh | None = None,
    since_name: str = "",
) -> None:
    """Draw iterations of a run and write them as a film.

    Parameters
    ----------
    path : path-like
        Path with a suffix of `hexmend_app.scene.film.film.FORMATS`.
    scene : Scene
        Scene whose camera, cut, filters and colours are used.
    run : RunRecord
        Record of the positions of the nodes at these iterations.
    mesh : Mesh
        Mesh of the run; its points are replaced by those of the iterations.
    numbers : sequence of int
        Numbers of the iterations.
    size : (width, height)
        Size in pixels.
    rate : float
        Frames per second.
    histogram : bool
        Draw a histogram.
    before : bool
        Show the first iteration on the left of all frames.
    opened, since, since_name
        As for `hexmend_app.scene.page.still_picture.write_picture`, if the scene shows a movement.

    Raises
    ------
    HexmendError
        If drawing is impossible on this machine, or the file cannot be written.
    """
    path = Path(path)
    format_of(path)
    prepare_off_screen()
    movement = None if since is None else movement_since(since, since_name, mesh, opened or mesh)
    camera = vtkCamera()
    aim(camera, scene.camera, mesh.points, size[0] / size[1])
    frames = film_frames(run, numbers, lambda number: _state(run, mesh, number))
    look = scene.look(mesh)
    images = pictures(frames, look, size, camera=camera, movement=movement, chart=histogram, before=before)
    write_film(path, [*images], rate)


def _state(run: RunRecord, mesh: Mesh, number: int) -> State:
    """Return the mesh at an iteration; at a time of a case, its boundary is that of this time."""
    moved = mesh.with_points(run.points(number))
    return State.of(moved.moving_from(moved.points) if run.holds_times else moved)
