"""Layers of the mesh structure: colours, filters and moving nodes."""

import numpy as np
import pytest

from hexmend import Mesh, measure
from hexmend.boundary import NodeClass
from hexmend.gallery.gallery_mesh import extrude
from hexmend.gallery.pentagon import fan, subdivide
from hexmend_app.picture import Box, Cut, CutStyle, LineStyle, Show
from hexmend_app.picture.appearance import Look, Structure
from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.scene.layers.optional.interfaces import InterfaceLayer
from hexmend_app.scene.layers.optional.structure import BOUNDARY, FREE, IRREGULAR_NODE, KINDS, LOCKED, PINNED, VALENCES
from hexmend_app.scene.layers.silhouette import form_lines
from hexmend_app.scene.render.stage import Stage
from hexmend_app.state.mesh.structure import sharp_edges
from hexmend_app.state.tasks.boundary_classifier import LEFT, WHISKER, classify_boundary
from tests.app.features.structure.layers import count
from tests.app.scene.showing import MESH, frame_of
from tests.app.state.mesh.test_structure import tetrahedron
from tests.core.grids import displaced, grid


def five_blocks(segments, layers):
    """Return a pentagonal prism of height 1.5 with five blocks around its axis."""
    plane, quads = subdivide(*fan(), segments)
    height = np.repeat(np.linspace(0, 1.5, layers + 1), len(plane))
    points = np.column_stack([np.tile(plane, (layers + 1, 1)), height])
    return Mesh(points, extrude(quads, len(plane), layers))


FIVE = five_blocks(3, 11)
NO_CUT, BELOW = Cut(), Cut.at((0, 0, 1), (0, 0, 0.7))


@pytest.fixture
def draw(off_screen):
    """A function that draws a mesh with a look and returns its pixels; its attribute `viewport` is the view."""
    viewport = off_screen(400, 300)

    def drawn(mesh, structure, cut=NO_CUT, shrink=0.0):
        show = Show(shrink=shrink, outline=False)
        look = Look(structure=structure, cut=cut, lines=LineStyle(edges=0.0), show=show)
        viewport.draw(frame_of(mesh, look))
        viewport.view("iso")
        viewport.moving()
        return viewport.pixels()

    drawn.viewport = viewport
    return drawn


def test_irregular_edges_are_visible_through_the_mesh_in_the_colour_of_their_valence(draw):
    assert count(draw(FIVE, Structure()), VALENCES[5]) == 0
    image = draw(FIVE, Structure.of("irregular"))
    assert count(image, VALENCES[5]) > 100
    assert count(image, VALENCES[3]) == 0
    image = draw(tetrahedron(), Structure.of("irregular"))
    assert count(image, VALENCES[3]) > 20
    assert count(image, VALENCES[5]) == 0
    assert count(image, IRREGULAR_NODE) > 5


def test_nodes_have_the_colour_of_their_kind(draw):
    mesh = grid(4)
    pinned = np.zeros(mesh.n_nodes, bool)
    pinned[[62, 0]] = True  # the centre, and a corner, which is on the boundary anyway
    mesh = mesh.replace(pinned=pinned)
    half = Cut.at((0, 0, 1), (0, 0, 2))
    image = draw(mesh, Structure.of("fixed", "free"), cut=half)
    assert count(image, PINNED) in range(4, 40)
    assert count(image, FREE) > 4 * count(image, PINNED)
    assert count(image, BOUNDARY) > 4 * count(image, PINNED)
    image = draw(mesh, Structure.of("free"), cut=half)
    assert count(image, BOUNDARY) == count(image, PINNED) == 0 < count(image, FREE)
    image = draw(mesh, Structure.of("free"))
    assert count(image, FREE) == 0  # none is in sight


def test_nodes_of_locked_hexes_are_marked(draw):
    mesh = grid(3)
    points = mesh.points.copy()
    assert count(draw(mesh, Structure.of("locked")), LOCKED) == 0
    points[15] = points[15] + [-1.5, 0, 0]  # of an edge of the box, past its neighbour on the boundary
    locked = Mesh(points, mesh.hexes)
    assert count(draw(locked, Structure.of("locked")), LOCKED) > 20
    draw.viewport.draw(frame_of(mesh, draw.viewport.frame.look))
    assert count(draw.viewport.pixels(), LOCKED) == 0


CUTS = [
    BELOW,
    Cut.at((0, 0, 1), (0, 0, 0.7), CutStyle.SMOOTH),
    Cut((*BELOW.planes, *BELOW.planes), style=CutStyle.SMOOTH, notch=True),
    Cut(box=Box((-2, -2, -2), (2, 2, 0.7)), style=CutStyle.SMOOTH),
    Cut(box=Box((-2, -2, 0.7), (2, 2, 2)), style=CutStyle.SMOOTH, notch=True),
]


@pytest.mark.parametrize("cut", CUTS)
def test_only_shown_hexes_have_marks(draw, cut):
    wanted = Structure.of("irregular", "sharp", "fixed")
    draw(FIVE, wanted, cut=cut)
    layers = draw.viewport.overlay_layers.structure
    assert layers.irregular.count == 5  # of the eleven, those below the plane
    for marks in (layers.irregular, layers.sharp, layers.nodes):
        assert marks.poly.points[:, 2].max() <= 0.75
    draw.viewport.draw(frame_of(FIVE, structure=wanted, show=Show(hidden=frozenset(range(FIVE.n_hexes)))))
    assert not layers.irregular.shown
    assert not layers.nodes.shown


def test_marks_move_with_the_nodes_and_with_shrunk_hexes(draw):
    draw(FIVE, Structure.of("irregular", "fixed"), shrink=0.3)
    moved = FIVE.points * [1, 1, 0.5]
    draw.viewport.draw(frame_of(FIVE.with_points(moved), draw.viewport.frame.look))
    layers = draw.viewport.overlay_layers.structure
    axis = layers.irregular.poly.points
    assert axis[:, 2].max() == pytest.approx(0.75)
    corners = moved[FIVE.hexes]
    shrunk = (corners + 0.3 * (corners.mean(axis=1, keepdims=True) - corners)).reshape(-1, 3)
    for point in layers.nodes.poly.points[::50]:
        assert np.abs(shrunk - point).max(axis=1).min() < 1e-6


def test_boundary_nodes_have_the_colour_of_their_class(draw):
    mesh = grid(3)
    image = draw(mesh, Structure.of("kinds"))
    assert count(image, KINDS[NodeClass.CORNER]) > 100
    assert count(image, KINDS[NodeClass.CURVE]) > count(image, KINDS[NodeClass.CORNER])
    assert count(image, KINDS[NodeClass.PATCH]) > 100
    assert count(image, KINDS[WHISKER]) == count(image, PINNED) == 0
    pinned = np.zeros(mesh.n_nodes, bool)
    pinned[np.flatnonzero((mesh.points[:, 2] == 3) & (mesh.points[:, 0] == 1))] = True
    assert count(draw(mesh.replace(pinned=pinned), Structure.of("kinds")), PINNED) > 20
    assert count(draw(mesh, Structure.of("kinds", "fixed")), BOUNDARY) == 0


def test_nodes_that_were_moved_off_the_boundary_have_a_colour_of_their_own(draw):
    mesh = grid(3).keeping_surface()
    moved = displaced(mesh, (mesh.points == [3, 3, 3]).all(axis=1), 0.2)
    assert count(draw(moved, Structure.of("kinds")), KINDS[LEFT]) > 10
    assert count(draw(grid(3), Structure.of("kinds")), KINDS[LEFT]) == 0


def test_a_view_beside_the_first_does_not_mark_nodes_that_have_not_moved_there():
    mesh = grid(3).keeping_surface()
    moved = displaced(mesh, (mesh.points == [3, 3, 3]).all(axis=1), 0.2)
    figures = measure(moved.points, moved.hexes)
    classes = classify_boundary(moved, figures, 40.0)
    first = Frame(moved, figures, kinds=classes.kinds, original_kinds=classes.original_kinds)
    assert classes.count(LEFT) == 1
    other = frame_of(mesh).matching(first)
    assert not (other.kinds == LEFT).any()
    assert Frame(moved, figures).matching(first).kinds is classes.kinds


# Layer of the interfaces between materials.


ONE = grid(4)
LOW = ONE.points[ONE.hexes].mean(axis=1)[:, 0] < 2
TWO = ONE.replace(hex_sets={"low": np.flatnonzero(LOW), "high": np.flatnonzero(~LOW)})


@pytest.fixture
def layer():
    with Stage((120, 90)) as stage:
        yield InterfaceLayer(Pane(stage.window))


def test_interfaces_are_the_faces_between_materials_at_shown_hexes(layer):
    layer.draw(frame_of(TWO), None)
    assert layer.shown
    assert layer.poly.n_cells == 16
    assert (layer.places[:, 0] == 2).all()
    layer.draw(frame_of(TWO), TWO.points[TWO.hexes].mean(axis=1)[:, 2] < 1)
    assert layer.poly.n_cells == 4
    layer.draw(frame_of(ONE), None)
    assert not layer.shown


def test_an_unchanged_interface_is_not_built_again_and_moves_with_its_nodes(layer):
    layer.draw(frame_of(TWO), None)
    poly = layer.poly
    layer.draw(frame_of(TWO), None)
    assert layer.poly is poly
    layer.draw(frame_of(TWO.with_points(TWO.points + 1)), None)
    assert (layer.places[:, 0] == 3).all()


# Original surface: visible where the boundary of the mesh has moved, and nowhere else.


ON, OFF = Look(structure=Structure.of("original")), Look()


def frame(points, look=ON):
    mesh = MESH.with_points(points)
    return Frame(mesh, measure(points, MESH.hexes), look=look, original=MESH.points)


@pytest.fixture
def drawn(off_screen):
    """A function that draws a frame and returns its pixels; its attribute `surface` is the layer."""
    viewport = off_screen(240, 180)
    viewport.draw(frame(MESH.points))
    viewport.view("iso")

    def draw(one):
        viewport.draw(one)
        viewport.moving()
        return viewport.pixels()

    draw.surface = viewport.overlay_layers.optional["original"]
    return draw


def differ(one, other):
    return int((np.abs(one - other).sum(axis=2) > 20).sum())


def test_it_is_hidden_where_the_boundary_is_unchanged(drawn):
    assert differ(drawn(frame(MESH.points, OFF)), drawn(frame(MESH.points))) < 40  # a rim


def test_it_is_visible_around_a_shrunk_mesh(drawn):
    centre = MESH.points.mean(axis=0)
    shrunk = centre + 0.7 * (MESH.points - centre)
    without, seen = drawn(frame(shrunk, OFF)), drawn(frame(shrunk))
    assert differ(without, seen) > 2000
    assert drawn.surface.shown
    np.testing.assert_array_equal(np.ptp(drawn.surface.places, axis=0), 4)


def test_faces_of_hidden_hexes_are_not_drawn(drawn):
    half = Look(cut=Cut.at((0, 0, 1), (2, 2, 1.9)), structure=Structure.of("original"))
    drawn(frame(MESH.points))
    assert len(drawn.surface.places) == MESH.topology.boundary.sum()
    drawn(frame(MESH.points, half))
    assert 0 < np.ptp(drawn.surface.places, axis=0)[2] < 3
    drawn(frame(MESH.points, Look(structure=Structure.of("original"), show=Show(peel=1))))
    assert not drawn.surface.shown
    drawn(frame(MESH.points))
    assert drawn.surface.shown


# Sharp edges, and the decision whether they show the shape of a body.


def test_sharp_edges_depend_on_the_angle():
    mesh = grid(2, 1, 1)
    points = mesh.points.copy()
    points[points[:, 0] == 2, 2] += np.tan(np.radians(40))
    faces = mesh.topology.boundary_faces
    assert len(sharp_edges(points, faces, 39)) == len(sharp_edges(points, faces, 41)) + 2


def test_sharp_edges_of_a_cube_form_lines_and_those_of_a_ball_do_not():
    mesh = grid(6)
    assert form_lines(sharp_edges(mesh.points, mesh.topology.boundary_faces))
    p = mesh.points / 3 - 1
    size = np.linalg.norm(p, axis=1, keepdims=True)
    ball = p * np.abs(p).max(axis=1, keepdims=True) / np.maximum(size, 1e-9)
    assert not form_lines(sharp_edges(ball, mesh.topology.boundary_faces))
