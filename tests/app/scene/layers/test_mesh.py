"""Fine frames: their shading is computed once, and used until something else is drawn."""

import numpy as np
import pytest
import pyvista as pv

from hexmend import Cells, Mesh
from hexmend.quality import measure
from hexmend_app.picture import Colours, Cut, CutStyle, Page, Plane, Show
from hexmend_app.picture.appearance import Look, Structure
from hexmend_app.scene.colour.colouring import INVERTED, OPENED, OUTSIDE
from hexmend_app.scene.geometry import occlusion
from hexmend_app.scene.geometry.coloured_polygons import colours_of, hexes_of
from hexmend_app.scene.geometry.curved_edges import DIVISIONS, sharp_curved_edges
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.scene.layers.invalid_outline import outlines
from hexmend_app.state.mesh.structure import sharp_edges
from tests.app.scene.showing import MESH, frame_of
from tests.core.curved_shell import curved_shell
from tests.core.grids import grid, scrambled
from tests.core.solid_lattices import mixed

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


# Layers on meshes of second order: selection, sharp edges, marks and the outline of inverted hexes are curved.


SHELL = curved_shell(27, around=5, angle=1.5 * np.pi)


@pytest.fixture
def shell_viewport(off_screen):
    return off_screen(200, 150)


def draw_shell(shell_viewport, mesh=SHELL, original=None, **tables):
    look = Look(**tables)
    shell_viewport.draw(Frame(mesh, measure(mesh.points, mesh.hexes), look=look, original=original))
    shell_viewport.still()


def radii(points):
    return np.linalg.norm(np.asarray(points)[:, :2], axis=1)


def on_walls(points):
    """Return True for points near one of the circles of the wall; chords of flat hexes are 0.11 from them."""
    return np.minimum(np.abs(radii(points) - 1), np.abs(radii(points) - 2)) < 0.01


def test_edges_of_a_marked_hex_run_along_the_circles_and_move_with_it(shell_viewport):
    draw_shell(shell_viewport, show=Show(marked=frozenset({2})))
    edges = shell_viewport.overlay_layers.selection.highlight.edges
    assert edges.lines.n_cells == 12 * DIVISIONS
    along = np.isclose(np.asarray(edges.lines.points)[:, 2] % 1, 0)
    assert np.count_nonzero(on_walls(edges.lines.points) & along) >= 4 * (DIVISIONS + 1)
    moved = SHELL.with_points(SHELL.points * 2)
    draw_shell(shell_viewport, moved, show=Show(marked=frozenset({2})))
    assert radii(edges.lines.points).max() == pytest.approx(4, abs=0.02)
    draw_shell(shell_viewport, show=Show(marked=frozenset({2})), structure=Structure().without("curved"))
    assert edges.lines.n_cells == 12


def test_edges_between_smoothly_joined_faces_are_not_sharp(shell_viewport):
    boundary = SHELL.topology.boundary_faces
    assert len(sharp_edges(SHELL.points, boundary)) == 4 * 5 + 8 + 2 * 4  # turns of 54° along both walls
    assert len(sharp_curved_edges(SHELL)) == 4 * 5 + 8
    draw_shell(shell_viewport)
    outline = shell_viewport.overlay_layers.outline
    assert outline.poly.n_lines == 28 * DIVISIONS
    draw_shell(shell_viewport, cut=Cut(planes=(Plane((1, 0, 0), point=(0, 0, 0)),), style=CutStyle.SMOOTH))
    assert outline.actor.GetVisibility()
    assert radii(outline.poly.points).min() > 0.99
    draw_shell(shell_viewport, structure=Structure().without("curved"))
    assert outline.poly.n_lines == 4 * 5 + 8 + 2 * 4


def test_an_inverted_hex_is_outlined_along_its_curved_edges(shell_viewport):
    points = SHELL.points.copy()
    h = SHELL.hexes[2]
    points[h[6]] += 2 * (points[h].mean(axis=0) - points[h[6]])
    mesh = SHELL.with_points(points)
    draw_shell(shell_viewport, mesh)
    inverted = np.flatnonzero(measure(mesh.points, mesh.hexes).inverted)
    assert len(inverted)
    poly = shell_viewport.mesh_layer.skin.poly
    n = np.sqrt(poly.n_cells / len(shell_viewport.mesh_layer.faces.quads))
    edges = np.unique(np.sort(boundary_edges(mesh, inverted), axis=1), axis=0)
    assert len(outlines(poly, (colours_of(poly) == INVERTED).all(axis=1))[0]) == n * len(edges)


def boundary_edges(mesh, hexes):
    faces = mesh.topology.boundary_faces[np.isin(np.nonzero(mesh.topology.face_neighbours < 0)[0], hexes)]
    return np.stack([faces, np.roll(faces, 1, axis=1)], axis=-1).reshape(-1, 2)


def test_the_original_surface_is_curved(shell_viewport):
    moved = SHELL.with_points(SHELL.points * 0.9)
    draw_shell(shell_viewport, moved, original=SHELL.points, structure=Structure.of("original"))
    surface = shell_viewport.overlay_layers.optional["original"]
    outer = radii(surface.places) > 1.5
    assert radii(surface.places)[outer].max() == pytest.approx(2, abs=0.01)
    assert radii(surface.places).min() > 0.99
    draw_shell(shell_viewport, moved, original=SHELL.points, structure=Structure.of("original").without("curved"))
    assert len(surface.places) == len(np.unique(SHELL.topology.boundary_faces))


def test_all_kinds_of_cells_are_drawn_in_the_colours_of_their_quality(viewport):
    mesh = scrambled(mixed(3), 0.1)
    viewport.draw(frame_of(mesh, Look()))
    poly, colours = viewport.mesh_layer.whole, viewport.colours
    assert len(poly.faces) != 5 * poly.n_cells  # there are triangles
    np.testing.assert_array_equal(colours_of(poly), colours.of(hexes_of(poly)))
    assert len(np.unique(colours.of(slice(None)), axis=0)) > 4


def test_a_pyramid_beside_a_curved_hex_is_drawn_cut_and_marked(viewport):
    cube = grid(1)
    mids = np.full((1, 19), -1)
    mids[0, 0] = 9  # of the edge from (0, 0, 0) to (1, 0, 0), which bulges
    points = np.concatenate([cube.points, [[0.5, 0.5, 1.7]], [[0.5, -0.3, 0]]])
    pyramid = Cells("pyramid", [[*cube.hexes[0, 4:], 8]])
    mesh = Mesh(points, cube.hexes, mid_nodes=mids, cells=(pyramid,))
    viewport.draw(frame_of(mesh, Look()))
    assert set(hexes_of(viewport.mesh_layer.whole)) == {0, 1}
    viewport.overlay_layers.selection.select(1, True, None)
    assert viewport.overlay_layers.selection.highlight.edges.lines.n_cells == 8 * DIVISIONS
    half = Cut.at((1, 0, 0), (0.5, 0, 0), CutStyle.SMOOTH)
    viewport.draw(frame_of(mesh, Look(cut=half)))
    section = viewport.mesh_layer.section.poly
    of_pyramid = section.extract_cells(np.flatnonzero(hexes_of(section) == 1)).area
    assert of_pyramid == pytest.approx(0.35)
    assert section.area > 1.35
