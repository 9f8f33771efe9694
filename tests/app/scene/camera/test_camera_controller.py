"""Camera of views: fitting, directions, projections and flights."""

import numpy as np
import pytest
import pyvista as pv

from hexmend.quality import measure
from hexmend_app.picture import Cut, CutStyle, Isolate, Show
from hexmend_app.picture.appearance import Look
from hexmend_app.scene.camera.vtk_pose import pose_of
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.scene.render.stage import Stage
from hexmend_app.scene.views.panes import Panes
from hexmend_app.state.view.side_views import Wipe
from tests.core.grids import grid

MESH = grid(6)
FIGURES = measure(MESH.points, MESH.hexes)
CORNER = Look(show=Show(isolate=Isolate((0,), 1)))
LOOKS = [
    Look(),
    CORNER,
    Look(cut=Cut.at((1, 0, 0), (2.5, 3, 3))),
    Look(cut=Cut.at((1, 1, 0), (2, 2, 3), CutStyle.SMOOTH)),
    Look(show=Show(peel=2)),
]


@pytest.fixture
def panes():
    with Stage((300, 200)) as stage:
        panes = Panes(stage.window)
        panes.draw(Frame(MESH, FIGURES))
        yield panes


def seen(panes, places, aspect=1.5):
    """Return the positions of points in the picture, from -1 to 1, (k, 2)."""
    matrix = pv.array_from_vtkmatrix(
        panes.camera_controller.camera.GetCompositeProjectionTransformMatrix(aspect, -1, 1)
    )
    projected = np.column_stack([places, np.ones(len(places))]) @ matrix.T
    return projected[:, :2] / projected[:, 3:]


@pytest.mark.parametrize("parallel", [False, True])
@pytest.mark.parametrize("look", LOOKS)
def test_fit_fills_the_picture_with_the_shown_hexes(panes, look, parallel):
    panes.camera_controller.set_parallel(parallel)
    panes.draw(Frame(MESH, FIGURES, look=look))
    panes.camera_controller.fit()
    places = seen(panes, panes.first.places)
    ends = np.array([places.min(axis=0), places.max(axis=0)])
    assert np.abs(ends).max() == pytest.approx(0.96, abs=1e-3)
    tight = np.abs(ends).max(axis=0).argmax()
    np.testing.assert_allclose(ends[:, tight], [-0.96, 0.96], atol=1e-3)


@pytest.mark.parametrize("style", CutStyle)
@pytest.mark.parametrize("outline", [True, False])
def test_fit_includes_the_outline_of_the_part_that_a_cut_removes(panes, style, outline):
    cut = Cut.at((1, 0, 0), (1.5, 3, 3), style)
    panes.draw(Frame(MESH, FIGURES, look=Look(cut=cut, show=Show(outline=outline))))
    panes.camera_controller.fit()
    assert (np.abs(seen(panes, MESH.points)).max() <= 0.961) == outline


def test_the_first_view_of_a_mesh_is_fitted(panes):
    small = grid(2)
    panes.draw(Frame(small, measure(small.points, small.hexes)))
    assert np.abs(seen(panes, small.points)).max() == pytest.approx(0.96, abs=1e-3)
    assert panes.camera_controller.fitted


def test_a_look_or_moved_nodes_leave_the_camera(panes):
    before = pose_of(panes.camera_controller.camera)
    panes.draw(Frame(MESH, FIGURES, look=CORNER))
    moved = MESH.with_points(MESH.points * 1.1)
    panes.draw(Frame(moved, measure(moved.points, moved.hexes), look=CORNER))
    assert pose_of(panes.camera_controller.camera) == before


@pytest.mark.parametrize("wipe", [None, Wipe(0, 1, 0.4)])
def test_fit_includes_the_hexes_of_all_views(panes, wipe):
    wide = MESH.with_points(MESH.points * (2, 1, 1))
    panes.show([(wide, measure(wide.points, wide.hexes))], wipe)
    panes.camera_controller.fit()
    aspect = 1.5 if wipe else 0.75
    assert np.abs(seen(panes, wide.points, aspect)).max() == pytest.approx(0.96, abs=1e-3)
    assert np.abs(seen(panes, MESH.points, aspect)).max() < 0.96


def test_a_fitted_view_is_fitted_again_when_the_window_is_resized(panes):
    window = panes.first.layers[0].GetRenderWindow()
    window.Render()
    far = panes.camera_controller.camera.GetDistance()
    window.SetSize(150, 200)
    window.Render()
    assert panes.camera_controller.camera.GetDistance() > 1.2 * far
    panes.camera_controller.camera.Dolly(1.5)
    far = panes.camera_controller.camera.GetDistance()
    window.SetSize(300, 200)
    window.Render()
    assert panes.camera_controller.camera.GetDistance() == far  # the user has come nearer


def test_objects_keep_their_size_in_the_other_projection(panes):
    controller = panes.camera_controller
    controller.flight_to(MESH.points[MESH.hexes[[0]]]).at(1.0)
    focal, up = np.array(controller.camera.GetFocalPoint()), np.array(controller.camera.GetViewUp())
    places = np.array([focal, focal + 0.2 * up])
    before = seen(panes, places)
    controller.set_parallel(True)
    np.testing.assert_allclose(seen(panes, places), before, atol=0.01)
    controller.camera.SetParallelScale(2 * controller.camera.GetParallelScale())
    half = seen(panes, places)
    controller.set_parallel(False)
    np.testing.assert_allclose(seen(panes, places), half, atol=0.01)


@pytest.mark.parametrize("normal", [(1, 0, 0), (0, 0, -1), (1, 2, 3)])
def test_a_plane_is_viewed_from_the_removed_side(panes, normal):
    clip = Cut.at(normal, (3, 3, 3), CutStyle.SMOOTH)
    panes.draw(Frame(MESH, FIGURES, look=Look(cut=clip)))
    panes.camera_controller.flight_along(clip.planes[0].normal).at(1.0)
    ahead = np.array(panes.camera_controller.camera.GetDirectionOfProjection())
    np.testing.assert_allclose(ahead, -np.array(clip.planes[0].normal), atol=1e-9)
    assert np.abs(seen(panes, panes.first.places)).max() == pytest.approx(0.96, abs=1e-3)


@pytest.mark.parametrize("parallel", [False, True])
def test_a_flight_around_a_point_preserves_the_distance(panes, parallel):
    controller = panes.camera_controller
    controller.set_parallel(parallel)
    before, place = pose_of(controller.camera), np.array([6.0, 0.0, 6.0])
    controller.flight_around(place).at(1.0)
    after = pose_of(controller.camera)
    assert after.focal == tuple(place)
    assert after.distance == pytest.approx(before.distance)
    assert (after.scale, after.up, after.parallel) == (before.scale, before.up, parallel)
    np.testing.assert_allclose(
        np.subtract(after.focal, after.position), np.subtract(before.focal, before.position), atol=1e-9
    )


@pytest.mark.parametrize("parallel", [False, True])
def test_a_flight_to_a_hex_shows_its_neighbours(panes, parallel):
    panes.camera_controller.set_parallel(parallel)
    corners = MESH.points[MESH.hexes[[100]]]
    panes.camera_controller.flight_to(corners).at(1.0)
    places = seen(panes, corners.reshape(-1, 3))
    assert 0.2 < np.abs(places).max() < 0.6
