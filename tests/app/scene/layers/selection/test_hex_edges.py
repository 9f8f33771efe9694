"""Edges of marked hexes: visible ones white, hidden ones pale."""

import numpy as np
import pytest
from vtkmodules.util.numpy_support import vtk_to_numpy

from hexmend.mesh.hexahedron import EDGES
from hexmend.smoothers import METHODS
from hexmend_app.picture import LineStyle, Show
from hexmend_app.picture.appearance import Look
from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.layers.selection.node_step import NodeStepMarks
from hexmend_app.scene.render.stage import Stage
from hexmend_app.state.node_step import explain
from hexmend_app.theme.palette import DESCENT, SEARCH
from tests.app.scene.showing import show
from tests.app.state.node_step.test_node_step import MIDDLE, sheared
from tests.core.grids import grid, scrambled

MESH = grid(3)
CORNER = int((MESH.points[MESH.hexes].mean(axis=1) == 2.5).all(axis=1).nonzero()[0][0])
INSIDE = int((MESH.points[MESH.hexes].mean(axis=1) == 1.5).all(axis=1).nonzero()[0][0])


@pytest.fixture
def viewport(off_screen):
    viewport = off_screen(400, 400, axes=False)
    show(viewport, MESH, Look(lines=LineStyle(edges=0.0), show=Show(outline=False)))
    viewport.view((1.0, 0.8, 0.6))
    return viewport


def along_edges(viewport, h):
    """Return the darkest colour channel along each edge of a hex, (12, 60), without the ends of edges."""
    image, renderer = viewport.pixels()[::-1], viewport.layers[0]
    seen = []
    for a, b in MESH.points[MESH.hexes[h]][EDGES]:
        for t in np.linspace(0.15, 0.85, 60):
            renderer.SetWorldPoint(*(a + t * (b - a)), 1.0)
            renderer.WorldToDisplay()
            x, y, _ = renderer.GetDisplayPoint()
            seen.append(image[int(y), int(x)].min())
    return np.array(seen).reshape(12, 60)


def is_hidden(h):
    """Return True for the edges of a hex that the grid hides from a viewer at positive coordinates, (12,) bool."""
    ends = MESH.points[MESH.hexes[h]][EDGES]
    return ~((ends == 3).all(axis=1)).any(axis=1)


@pytest.mark.parametrize("fine", [True, False])
@pytest.mark.parametrize("h", [CORNER, INSIDE])
def test_visible_edges_are_white_and_hidden_ones_pale(viewport, h, fine):
    viewport.overlay_layers.selection.select(None, False, None)
    (viewport.still if fine else viewport.moving)()
    before = along_edges(viewport, h)
    viewport.overlay_layers.selection.select(h, False, None)
    after, hidden = along_edges(viewport, h), is_hidden(h)
    assert hidden.sum() == (3 if h == CORNER else 12)
    assert (after[~hidden] > 140).all()
    assert ((after[hidden] > before[hidden] + 40).mean(axis=1) > 0.9).all()
    assert (after[hidden] < 200).mean() > 0.8


def test_marked_hexes_of_a_look_are_drawn_until_the_look_has_none(viewport):
    bare = viewport.pixels()
    show(viewport, look=Look(lines=LineStyle(edges=0.0), show=Show(outline=False, marked=frozenset({CORNER, INSIDE}))))
    assert (along_edges(viewport, CORNER)[~is_hidden(CORNER)] > 140).all()
    show(viewport, look=Look(lines=LineStyle(edges=0.0), show=Show(outline=False)))
    np.testing.assert_array_equal(viewport.pixels(), bare)


# Arrows of a node step: all of them downhill, none for rounding.


def arrows(mesh, node, name):
    """Return the drawn directions of the step's arrows by role; None for arrows that are not drawn."""
    step = explain(mesh, METHODS[name](), node)
    with Stage((60, 60)) as stage:
        marks = NodeStepMarks(Pane(stage.window))
        marks.show(step, mesh.hexes[step.hexes], mesh.points)
        directions = {}
        for role, (_, solid) in marks.arrows.items():
            points = vtk_to_numpy(solid.GetMapper().GetInput().GetPoints().GetData()) if solid.GetVisibility() else None
            directions[role] = None if points is None else _tip(points, step.before) - step.before
    return step, directions


def _tip(points, start):
    return points[np.linalg.norm(points - start, axis=1).argmax()]


@pytest.mark.parametrize("name", ["local-sd", "local-nr", "global-sd", "laplacian"])
def test_the_arrow_of_the_gradient_points_downhill(name):
    mesh = scrambled(grid(3), 0.2, 5)
    step, drawn = arrows(mesh, int(np.flatnonzero(mesh.free)[3]), name)
    downhill = drawn[DESCENT]
    cosine = downhill @ -step.gradient / np.linalg.norm(downhill) / np.linalg.norm(step.gradient)
    assert cosine > 0.99
    assert drawn[SEARCH] is not None


@pytest.mark.parametrize("name", ["local-sd", "local-nr", "laplacian"])
def test_a_node_at_its_minimum_has_no_arrows(name):
    step, drawn = arrows(sheared(), MIDDLE, name)
    assert np.linalg.norm(step.gradient) > 0  # rounding
    assert drawn[DESCENT] is None
    assert drawn[SEARCH] is None
