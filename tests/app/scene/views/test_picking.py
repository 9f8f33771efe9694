"""Picking of hexes and nodes."""

import numpy as np
import pytest

from hexmend.mesh.solid_cells import SOLID_KINDS, kinds_of
from hexmend_app.picture.cut import Cut, CutStyle
from tests.app.scene.showing import frame_of
from tests.core.grids import grid
from tests.core.solid_lattices import mixed

MESH = grid(5)


@pytest.fixture
def seen(off_screen):
    """A viewport that looks at a grid from above."""
    viewport = off_screen(200, 200)
    viewport.draw(frame_of(MESH))
    viewport.view("+z")
    viewport.pixels()
    return viewport


@pytest.mark.parametrize("place", [(100, 100), (60, 130), (150, 45)])
def test_a_hit_lies_on_its_hex_and_its_node_is_the_nearest(seen, place):
    hit = seen.pick(*place)
    corners = MESH.points[MESH.hexes[hit.hex]]
    assert (corners.min(axis=0) - 1e-6 <= hit.place).all()
    assert (hit.place <= corners.max(axis=0) + 1e-6).all()
    assert hit.place[2] == pytest.approx(5)
    away = np.linalg.norm(MESH.points - hit.place, axis=1)
    assert hit.node == away.argmin()


def test_nothing_is_picked_outside_the_mesh(seen):
    assert seen.pick(1, 1) is None


def test_the_picked_point_on_a_section_lies_on_the_plane(seen):
    seen.draw(frame_of(MESH, cut=Cut.at((0, 0, 1), (2.5, 2.5, 2.3), CutStyle.SMOOTH)))
    hit = seen.pick(100, 100)
    assert hit.place[2] == pytest.approx(2.3, abs=1e-6)
    assert MESH.points[MESH.hexes[hit.hex]][:, 2].tolist().count(2.0) == 4


def test_a_tetrahedron_is_picked_by_its_triangle(off_screen):
    mesh, viewport = mixed(3), off_screen(200, 200)
    viewport.draw(frame_of(mesh))
    viewport.view("+z")
    viewport.pixels()
    hits = [viewport.pick(x, y) for x in range(40, 160, 10) for y in range(45, 160, 10)]
    seen = {SOLID_KINDS[kinds_of(mesh.elements[[hit.hex]])[0]].name for hit in hits if hit is not None}
    assert seen == {"tetrahedron", "wedge"}  # on top of the box
    for hit in filter(None, hits):
        nodes = mesh.elements[hit.hex]
        away = np.linalg.norm(mesh.points[nodes] - hit.place, axis=1)
        assert hit.node == nodes[away.argmin()]
