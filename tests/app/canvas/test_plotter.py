"""PyVista plotter of the 3D view: its actors are drawn and saved, and other props are not changed."""

from __future__ import annotations

import sys

import numpy as np
import pytest
import pyvista as pv

from hexmend import gallery
from hexmend.errors import HexmendError
from hexmend_app.canvas import plotter as module
from hexmend_app.picture import Page
from hexmend_app.scene.film.film import pictures
from hexmend_app.scene.film.film_frames import FilmFrame
from hexmend_app.state.mesh.document import State

MAGENTA = (255, 0, 255)


@pytest.fixture
def canvas(fresh_window):
    """The view of a window with a mesh."""
    return fresh_window.canvas


def _add(canvas, **options):
    """Add a sphere around the mesh, in a colour that nothing else has."""
    low, high = np.reshape(canvas.viewport.bounds, (3, 2)).T
    sphere = pv.Sphere(radius=np.linalg.norm(high - low), center=(low + high) / 2)
    return canvas.plotter.add_mesh(sphere, color=MAGENTA, lighting=False, **options)


def _magenta(pixels):
    return np.count_nonzero((np.asarray(pixels)[..., :3] == MAGENTA).all(axis=-1))


def _saved(canvas):
    return canvas.draw_page(canvas.scene(Page())).image().convert("RGB")


@pytest.mark.slow
def test_its_actors_are_on_the_screen_and_in_pictures(canvas):
    before = canvas.viewport.layers[0].GetViewProps().GetNumberOfItems()
    assert isinstance(canvas.plotter, pv.Plotter)
    assert canvas.plotter is canvas.plotter
    assert _magenta(_saved(canvas)) == 0
    pose = canvas.pose
    actor = _add(canvas)
    assert canvas.pose == pose  # adding a mesh moves no camera
    assert _magenta(canvas.plotter.screenshot()) > 1000
    assert _magenta(_saved(canvas)) > 1000
    canvas.plotter.remove_actor(actor)
    assert _magenta(canvas.plotter.screenshot()) == _magenta(_saved(canvas)) == 0
    assert canvas.viewport.layers[0].GetViewProps().GetNumberOfItems() == before


def test_its_actors_survive_changes_of_mesh_and_theme_and_clear_removes_only_them(fresh_window, canvas):
    _add(canvas, style="wireframe", line_width=3)
    before = canvas.viewport.layers[0].GetViewProps().GetNumberOfItems()
    fresh_window.session.document.replace(State.of(gallery.make("cube", size=64)), None)
    fresh_window.refresh()
    canvas.panes.set_dark(True)
    assert list(canvas.plotter.actors)
    assert canvas.viewport.layers[0].GetViewProps().GetNumberOfItems() == before
    canvas.plotter.add_points(np.eye(3), color="red")
    canvas.plotter.clear()
    assert not canvas.plotter.actors
    assert canvas.viewport.layers[0].GetViewProps().GetNumberOfItems() == before - 1
    assert canvas.viewport.frame is not None
    assert _magenta(_saved(canvas)) == 0


def test_both_cameras_are_synchronised(canvas):
    plotter, view = canvas.plotter, canvas.viewport.camera
    canvas.look_along("+x")
    assert np.allclose(plotter.camera.position, view.GetPosition())
    plotter.camera.position = 1.0, 2.0, 30.0
    assert np.allclose(view.GetPosition(), (1, 2, 30))
    plotter.view_xy()
    assert np.allclose(view.GetDirectionOfProjection(), (0, 0, -1))


def test_points_text_scalar_bars_and_textures_are_in_pictures(canvas):
    low, high = np.reshape(canvas.viewport.bounds, (3, 2)).T
    plane = pv.Plane(center=high + 1, i_size=5, j_size=5).texture_map_to_plane()
    canvas.plotter.add_mesh(plane, texture=pv.Texture(np.full((2, 2, 3), (0, 0, 255), dtype=np.uint8)))
    canvas.plotter.add_points(np.array([low, high]), scalars=[0.0, 1.0], render_points_as_spheres=True, point_size=30)
    without = np.asarray(_saved(canvas), int)
    canvas.plotter.add_text("Text", color="red", font_size=20)
    assert np.abs(np.asarray(_saved(canvas), int) - without).max() > 100


def test_its_actors_are_in_films(canvas):
    shown = canvas.viewport.frame
    frame = FilmFrame("run", "frame", State.of(shown.mesh))
    options = {"camera": canvas.viewport.camera, "props": canvas.plotter_props}
    (without,) = pictures([frame], shown.look, (400, 300), **options)
    _add(canvas)
    (picture,) = pictures([frame], shown.look, (400, 300), **options)
    assert _magenta(without) == 0
    assert _magenta(picture) > 1000


def test_closing_the_plotter_keeps_the_view_open(canvas):
    _add(canvas)
    canvas.plotter.close()
    assert canvas.plotter.render_window is None
    canvas.interactor.grabFramebuffer()
    assert not canvas.plotter.actors


def test_separate_windows_require_pyvistaqt(canvas, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyvistaqt", None)
    with pytest.raises(HexmendError, match="pip install"):
        module.open_window()
