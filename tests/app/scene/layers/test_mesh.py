"""Fine frames: their shading is computed once, and used until something else is drawn."""

import numpy as np
import pytest
import pyvista as pv

from hexmend_app.picture import Colours, Cut, CutStyle, Page, Show
from hexmend_app.picture.appearance import Look
from hexmend_app.scene.colour.colouring import OPENED, OUTSIDE
from hexmend_app.scene.geometry import occlusion
from hexmend_app.scene.layers.surface import colours_of
from tests.app.scene.showing import MESH, frame_of

STEP = Look(
    show=Show(hidden=frozenset(int(h) for h in np.flatnonzero((MESH.points[MESH.hexes].mean(axis=1) > 2).all(axis=1))))
)


@pytest.fixture
def viewport(off_screen):
    return off_screen(200, 150)


def draw(viewport, look=STEP, mesh=MESH):
    viewport.draw(frame_of(mesh, look))
    viewport.still()


def drawn(viewport):
    """Return the polygons of the skin that are drawn."""
    return pv.wrap(viewport.mesh_layer.skin.actor.GetMapper().GetInput())


def shades(viewport):
    """Return the brightness of the drawn corners relative to the colours of their polygons."""
    poly = drawn(viewport)
    own = np.repeat(colours_of(poly), 4, axis=0).astype(float)
    return np.asarray(poly.point_data["shaded"]).astype(float).sum(axis=1) / own.sum(axis=1)


def test_the_inner_edge_of_a_step_is_darker_after_shading(viewport):
    draw(viewport)
    np.testing.assert_allclose(shades(viewport), 1)
    viewport.shade()
    within = (np.abs(drawn(viewport).points - 2) < 1e-9).sum(axis=1) >= 2
    np.testing.assert_allclose(shades(viewport).max(), 1, atol=0.02)
    assert shades(viewport)[within].min() < 0.85


def test_shading_that_is_known_or_switched_off_is_not_computed(viewport):
    assert viewport.mesh_layer.needs_shading is None  # nothing is drawn
    draw(viewport)
    assert viewport.mesh_layer.needs_shading is not None
    viewport.shade()
    assert viewport.mesh_layer.needs_shading is None
    draw(viewport, Look(show=Show(hidden=STEP.show.hidden), page=Page(shading=False)))
    assert viewport.mesh_layer.needs_shading is None
    np.testing.assert_allclose(shades(viewport), 1)


def test_shading_is_dropped_when_nodes_move(viewport):
    draw(viewport)
    viewport.shade()
    moved = MESH.with_points(MESH.points + 0.1 * MESH.free[:, None])
    draw(viewport, mesh=moved)
    assert viewport.mesh_layer.needs_shading is not None
    np.testing.assert_allclose(shades(viewport), 1)


def test_shading_of_an_outdated_scene_is_rejected(viewport):
    draw(viewport)
    polygons = viewport.mesh_layer.needs_shading
    light = occlusion.ambient_light(polygons)
    draw(viewport, Look())
    assert not viewport.mesh_layer.apply_shading(polygons, light)
    np.testing.assert_allclose(shades(viewport), 1)


def test_sections_of_a_smooth_cut_face_the_removed_side(viewport):
    draw(viewport, Look(cut=Cut.at((0, 0, 1), (0, 0, 2.5), CutStyle.SMOOTH)))
    section = pv.wrap(viewport.mesh_layer.section.actor.GetMapper().GetInput())
    np.testing.assert_allclose(section.point_normals, np.tile([0, 0, 1], (section.n_points, 1)), atol=1e-6)
    viewport.shade()
    assert viewport.mesh_layer.needs_shading is None


def test_a_neutral_look_can_be_switched_on_and_off(viewport):
    draw(viewport)
    coloured = colours_of(viewport.mesh_layer.whole).copy()
    draw(viewport, Look(show=Show(hidden=STEP.show.hidden), colours=Colours(neutral=True)))
    inside = (np.abs(viewport.mesh_layer.whole.cell_centers().points - 2) < 1e-9).any(axis=1)
    seen = colours_of(viewport.mesh_layer.whole)
    assert inside.any()
    assert (seen[inside] == OPENED).all()
    assert (seen[~inside] == OUTSIDE).all()
    draw(viewport)
    np.testing.assert_array_equal(colours_of(viewport.mesh_layer.whole), coloured)
