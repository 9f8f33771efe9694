"""Arrows of a node step: all of them downhill, none for rounding."""

import numpy as np
import pytest
from vtkmodules.util.numpy_support import vtk_to_numpy

from hexmend.smoothers import METHODS
from hexmend_app.scene.layers.selection.node_step import NodeStepMarks
from hexmend_app.scene.render.stage import Stage
from hexmend_app.scene.views.pane import Pane
from hexmend_app.state.node_step import explain
from hexmend_app.theme.palette import DESCENT, SEARCH
from tests.app.state.node_step.test_node_step import MIDDLE, sheared
from tests.core.grids import grid, scrambled


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
