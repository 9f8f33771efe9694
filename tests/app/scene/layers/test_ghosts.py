"""Hexes around isolated hexes are drawn as ghosts, which do not hide them."""

from types import SimpleNamespace

import numpy as np
import pytest
from vtkmodules.vtkRenderingCore import vtkRenderer

from hexmend_app.picture.camera_pose import CameraPose
from hexmend_app.picture.cut import Cut
from hexmend_app.picture.visibility import Isolate, Show
from hexmend_app.scene.camera.vtk_pose import apply_pose
from hexmend_app.scene.layers.overlay_layers import Ghosts
from tests.app.scene.showing import frame_of
from tests.core.grids import grid

MESH = grid(5)
MIDDLE = 62


def frame(**look):
    return frame_of(MESH, **look)


@pytest.fixture
def viewport(off_screen):
    return off_screen(240, 180)


@pytest.mark.parametrize("rings", [0, 1, 2])
def test_rings_around_isolated_hexes_are_ghosts(viewport, rings):
    viewport.draw(frame(show=Show(isolate=Isolate((MIDDLE,), rings))))
    assert viewport.shown == 1
    assert set(viewport.mesh_layer.faces.hexes) == {MIDDLE}
    ghosts = viewport.filters.ghosts(viewport.frame)
    if not rings:
        assert ghosts is None
    else:
        assert ghosts.sum() == (2 * rings + 1) ** 3 - 1
        np.testing.assert_allclose(np.ptp(viewport.places, axis=0), 2 * rings + 1)


def test_hexes_dug_out_or_cut_away_are_no_ghosts(viewport):
    viewport.draw(
        frame(show=Show(isolate=Isolate((MIDDLE,), 1), hidden=frozenset({61})), cut=Cut.at((0, 0, 1), (0, 0, 3)))
    )
    ghosts = viewport.filters.ghosts(viewport.frame)
    assert ghosts.sum() == 18 - 2
    assert not ghosts[61]


def test_an_isolated_hex_is_visible_through_its_ghosts(viewport):
    viewport.draw(frame(show=Show(isolate=Isolate((MIDDLE,), 1), outline=False)))
    apply_pose(viewport.camera, CameraPose((7, -5, 7), (2.5, 2.5, 2.5), (0, 0, 1), False, 1.0, "z"))
    viewport.layers[0].ResetCameraClippingRange()
    ghostly = viewport.pixels()
    middle = ghostly[80:100, 110:130].reshape(-1, 3).mean(axis=0)
    assert middle[0] - middle[2] > 60  # yellow still: q is 1
    ground = ghostly[2, 2]
    pale = np.abs(ghostly - ground).sum(axis=2)
    assert ((pale > 15) & (pale < 150)).mean() > 0.1  # the ghosts around it


def test_ghosts_follow_the_nodes():
    ghosts, keep = Ghosts(SimpleNamespace(renderer=vtkRenderer())), np.zeros(MESH.n_hexes, bool)
    keep[MIDDLE] = True
    around = MESH.topology.hexes_around([MIDDLE], 1) & ~keep
    ghosts.draw(frame(), around, keep)
    assert ghosts.shown
    before = ghosts.places.copy()
    ghosts.move(frame_of(MESH.with_points(MESH.points + 1)))
    np.testing.assert_allclose(ghosts.places, before + 1)
    ghosts.draw(frame(), None, keep)
    assert not ghosts.shown
    assert ghosts.places.shape == (0, 3)
