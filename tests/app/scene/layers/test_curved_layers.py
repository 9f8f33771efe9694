"""Layers on meshes of second order: selection, sharp edges, marks and the outline of inverted hexes are curved."""

import numpy as np
import pytest
import pyvista as pv

from hexmend.quality import measure
from hexmend_app.picture import Cut, CutStyle, Plane, Show
from hexmend_app.picture.appearance import Look, Structure
from hexmend_app.scene.colour.colouring import INVERTED
from hexmend_app.scene.geometry.curved_edges import DIVISIONS, sharp_curved_edges
from hexmend_app.scene.layers.invalid_outline import outlines
from hexmend_app.scene.layers.surface import colours_of
from hexmend_app.scene.views.frame import Frame
from hexmend_app.state.mesh.structure import sharp_edges
from tests.core.curved_shell import curved_shell

MESH = curved_shell(27, around=5, angle=1.5 * np.pi)


@pytest.fixture
def viewport(off_screen):
    return off_screen(200, 150)


def draw(viewport, mesh=MESH, original=None, **tables):
    look = Look(**tables)
    viewport.draw(Frame(mesh, measure(mesh.points, mesh.hexes), look=look, original=original))
    viewport.still()


def radii(points):
    return np.linalg.norm(np.asarray(points)[:, :2], axis=1)


def on_walls(points):
    """Return True for points near one of the circles of the wall; chords of flat hexes are 0.11 from them."""
    return np.minimum(np.abs(radii(points) - 1), np.abs(radii(points) - 2)) < 0.01


def test_edges_of_a_marked_hex_run_along_the_circles_and_move_with_it(viewport):
    draw(viewport, show=Show(marked=frozenset({2})))
    edges = viewport.overlay_layers.selection.highlight.edges
    assert edges.lines.n_cells == 12 * DIVISIONS
    along = np.isclose(np.asarray(edges.lines.points)[:, 2] % 1, 0)
    assert np.count_nonzero(on_walls(edges.lines.points) & along) >= 4 * (DIVISIONS + 1)
    viewport.pixels()
    dashes = np.asarray(edges.dashes.points)
    across = np.unique(MESH.points[MESH.hexes[2]][:, :2], axis=0)
    rays = np.abs(dashes[:, :1] * across[:, 1] - dashes[:, 1:2] * across[:, 0]).min(axis=1) < 0.02
    assert (on_walls(dashes) | rays).all()
    moved = MESH.with_points(MESH.points * 2)
    draw(viewport, moved, show=Show(marked=frozenset({2})))
    assert radii(edges.lines.points).max() == pytest.approx(4, abs=0.02)
    draw(viewport, show=Show(marked=frozenset({2})), structure=Structure().without("curved"))
    assert edges.lines.n_cells == 12


def test_edges_between_smoothly_joined_faces_are_not_sharp(viewport):
    boundary = MESH.topology.boundary_faces
    assert len(sharp_edges(MESH.points, boundary)) == 4 * 5 + 8 + 2 * 4  # turns of 54° along both walls
    assert len(sharp_curved_edges(MESH)) == 4 * 5 + 8
    draw(viewport)
    outline = viewport.overlay_layers.outline
    assert outline.actor.GetMapper().GetInput().GetNumberOfLines() == 28 * DIVISIONS
    draw(viewport, cut=Cut(planes=(Plane((1, 0, 0), point=(0, 0, 0)),), style=CutStyle.SMOOTH))
    assert outline.actor.GetVisibility()
    assert radii(pv.wrap(outline.actor.GetMapper().GetInput()).points).min() > 0.99
    draw(viewport, structure=Structure().without("curved"))
    assert viewport.overlay_layers.outline is not outline


def test_an_inverted_hex_is_outlined_along_its_curved_edges(viewport):
    points = MESH.points.copy()
    h = MESH.hexes[2]
    points[h[6]] += 2 * (points[h].mean(axis=0) - points[h[6]])
    mesh = MESH.with_points(points)
    draw(viewport, mesh)
    inverted = np.flatnonzero(measure(mesh.points, mesh.hexes).inverted)
    assert len(inverted)
    poly = viewport.mesh_layer.skin.poly
    n = np.sqrt(poly.n_cells / len(viewport.mesh_layer.faces.quads))
    edges = np.unique(np.sort(boundary_edges(mesh, inverted), axis=1), axis=0)
    assert len(outlines(poly, (colours_of(poly) == INVERTED).all(axis=1))[0]) == n * len(edges)


def boundary_edges(mesh, hexes):
    faces = mesh.topology.boundary_faces[np.isin(np.nonzero(mesh.topology.face_neighbours < 0)[0], hexes)]
    return np.stack([faces, np.roll(faces, 1, axis=1)], axis=-1).reshape(-1, 2)


def test_the_original_surface_is_curved(viewport):
    moved = MESH.with_points(MESH.points * 0.9)
    draw(viewport, moved, original=MESH.points, structure=Structure.of("original"))
    surface = viewport.overlay_layers.optional["original"]
    outer = radii(surface.places) > 1.5
    assert radii(surface.places)[outer].max() == pytest.approx(2, abs=0.01)
    assert radii(surface.places).min() > 0.99
    draw(viewport, moved, original=MESH.points, structure=Structure.of("original").without("curved"))
    assert len(surface.places) == len(np.unique(MESH.topology.boundary_faces))
