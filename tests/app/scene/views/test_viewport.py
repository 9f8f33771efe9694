"""Off-screen view of a mesh: the picture depends on points, quality and look."""

import numpy as np
import pytest

from hexmend_app.picture import Colours, Cut, CutStyle, LineStyle, Show
from hexmend_app.picture.appearance import Look
from hexmend_app.scene.camera.camera_controller import CameraController
from hexmend_app.scene.colour.colouring import INVERTED
from tests.app.scene.showing import MESH, show
from tests.core.grids import scrambled

INSIDE = Cut.at((0, 0, 1), (0, 0, 2), CutStyle.SMOOTH)


def magenta(image):
    """Count the pixels in the colour of inverted hexes, independent of shading."""
    share = image / np.maximum(image.max(axis=2, keepdims=True), 1)
    return int((np.abs(share - np.array(INVERTED) / max(INVERTED)).max(axis=2) < 0.1).sum())


def test_a_cut_through_nodes_is_closed(seen):
    viewport, pixels = seen
    show(viewport, look=Look(lines=LineStyle(edges=0.0)))
    whole = pixels()
    show(viewport, look=Look(cut=INSIDE, lines=LineStyle(edges=0.0)))
    middle = np.s_[60:90, 85:115]
    assert np.abs(pixels()[middle] - whole[middle]).max() <= 2  # q = 1 everywhere, lit alike


def test_faces_turned_inside_out_are_seen(seen):
    viewport, pixels = seen
    show(viewport, look=Look(lines=LineStyle(edges=0.0), show=Show(outline=False)))
    background = pixels()[0, 0]
    drawn = (pixels() != background).any(axis=2).sum()
    mirrored = MESH.with_points(MESH.points * [-1, 1, 1] + [4, 0, 0])
    show(viewport, mirrored)
    assert magenta(pixels()) > 0.9 * drawn


def test_the_same_picture_however_its_look_was_reached(seen):
    viewport, pixels = seen
    tangled = scrambled(MESH, 0.6)
    look = Look(cut=INSIDE, show=Show(quality=(0.3, 0.9)), colours=Colours(map="plasma"))
    show(viewport, look=look)
    show(viewport, tangled)
    moved = pixels()
    lower = Look(cut=Cut.at((0, 0, 1), (0, 0, 1)))
    show(viewport, look=lower)
    crinkle = pixels()
    assert np.abs(crinkle - moved).max() > 50
    show(viewport, look=look)
    np.testing.assert_array_equal(pixels(), moved)
    show(viewport, look=Look())
    show(viewport, look=lower)
    np.testing.assert_array_equal(pixels(), crinkle)


def white(image):
    """Count the pixels in the colour of the outlines of inverted hexes."""
    return int((image.min(axis=2) > 250).sum())


@pytest.mark.parametrize("edges", [True, False])
@pytest.mark.parametrize("cut", [Cut(), Cut.at((0, 0, 1), (0, 0, 2)), Cut.at((0, 0, 1), (0, 0, 2.2), CutStyle.SMOOTH)])
def test_inverted_elements_that_are_seen_are_outlined(seen, edges, cut):
    viewport, pixels = seen
    show(viewport, look=Look(cut=cut, lines=LineStyle(edges=None if edges else 0.0)))
    before = pixels()
    assert white(before) == magenta(before) == 0
    tangled = scrambled(MESH, 1.5)
    if not cut.active:  # the skin's own nodes are held; an element at its corner is turned over through one of them
        tangled = MESH.with_points(
            MESH.points + 1.5 * (MESH.points == MESH.points.max(axis=0)).all(axis=1)[:, None] * -1
        )
    show(viewport, tangled)
    assert min(white(pixels()), magenta(pixels())) > 30
    show(viewport, MESH)
    np.testing.assert_array_equal(pixels(), before)


def test_a_marked_hex_is_visible_through_the_mesh_and_its_values_if_it_is_large(seen):
    viewport, pixels = seen
    plain = pixels()
    inner = 21
    viewport.overlay_layers.selection.select(inner, False, None)
    marked = pixels()
    assert 0 < (np.abs(marked - plain).max(axis=2) > 40).sum() < 0.2 * plain[:, :, 0].size
    viewport.overlay_layers.selection.select(inner, True, None)
    np.testing.assert_array_equal(pixels(), marked)  # too small for figures
    controller = CameraController.of(viewport)
    controller.flight_to(MESH.points[MESH.hexes[[inner]]]).at(1.0)
    controller.reset_depth()
    centre = MESH.points[MESH.hexes[inner]].mean(axis=0)
    np.testing.assert_allclose(viewport.camera.GetFocalPoint(), centre)
    viewport.camera.Dolly(2.0)
    near = pixels()
    viewport.overlay_layers.selection.select(inner, False, None)
    assert (near != pixels()).any()


def test_a_large_skin_is_drawn_coarsely_while_the_camera_turns_and_finely_at_rest(seen, monkeypatch):
    viewport, pixels = seen
    monkeypatch.setattr("hexmend_app.scene.layers.mesh.MANY", 50)
    viewport.still()
    fine = pixels()
    viewport.turning()
    mapper = viewport.mesh_layer.skin.actor.GetMapper()
    rough = mapper.GetInput()
    assert 0 < rough.GetNumberOfCells() != viewport.mesh_layer.whole.GetNumberOfCells()
    turned = pixels()
    body = (fine != fine[0, 0]).any(axis=2)
    assert ((turned != turned[0, 0]).any(axis=2) == body).mean() > 0.98  # the same shape
    viewport.turning()
    assert mapper.GetInput() is rough  # made once
    h = viewport.pick(100, 75).hex
    assert (MESH.topology.face_neighbours[h] < 0).any()
    show(viewport, MESH)
    viewport.turning()
    assert mapper.GetInput() is viewport.mesh_layer.whole  # nodes that move are seen as they are
    viewport.still()
    np.testing.assert_array_equal(pixels(), fine)
