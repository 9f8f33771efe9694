"""Film of a recorded run, off screen: for scripts that repeat what a window has drawn."""

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
    opened: Mesh | None = None,
    since: Mesh | None = None,
    since_name: str = "",
) -> None:
    """Draw iterations of a run and write them as a film.

    Parameters
    ----------
    path : path-like
        Its suffix is one of `hexmend_app.scene.film.film.FORMATS`.
    scene : Scene
        Its camera, cut, filters and colours.
    run : Record
        It knows where the nodes were at these iterations.
    mesh : Mesh
        Data of its iterations besides the points.
    numbers : sequence of int
        Of the iterations.
    size : (width, height)
        In pixels.
    rate : float
        Frames a second.
    histogram : bool
        Draw a histogram.
    opened, since, since_name
        As for `hexmend_app.scene.page.still_picture.write_picture`, where the scene shows a movement.

    Raises
    ------
    HexmendError
        If nothing can be drawn here, or the file cannot be written.
    """
    path = Path(path)
    format_of(path)
    prepare_off_screen()
    movement = None if since is None else movement_since(since, since_name, mesh, opened or mesh)
    camera = vtkCamera()
    aim(camera, scene.camera, mesh.points, size[0] / size[1])
    taken = film_frames(run, numbers, lambda number: State.of(mesh.with_points(run.points(number))))
    frames = pictures(taken, scene.look(mesh), size, camera=camera, movement=movement, chart=histogram)
    write_film(path, [*frames], rate)
