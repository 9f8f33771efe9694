"""Non-hexahedral cells: their outer faces are drawn, but no faces that they share with other cells."""

import numpy as np

from hexmend import Cells, Mesh
from hexmend_app.picture.appearance import Look, Structure
from hexmend_app.picture.cut import Cut
from hexmend_app.scene.layers.optional.other_cells import FACES, outer_faces
from tests.app.scene.showing import frame_of
from tests.core.grids import grid

OFF = Look(structure=Structure(frozenset()))


def hybrid() -> Mesh:
    """Return a mesh of 2 × 2 hexes with a pyramid on two of them, and a tetrahedron between the pyramids."""
    bare = grid(2, 2, 1)
    top = bare.hexes[:2, 4:]
    tips = bare.points[top].mean(axis=1) + [0, 0, 1]
    a, b = bare.n_nodes, bare.n_nodes + 1
    ridge = np.intersect1d(top[0], top[1])
    tetra = np.array([[*ridge, a, b]])
    return Mesh(
        np.vstack([bare.points, tips]),
        bare.hexes,
        cells=(Cells("pyramid", np.column_stack([top, [a, b]])), Cells("tetra", tetra), Cells("line", tetra[:, :2])),
    )


def test_the_faces_of_each_cell_type_are_closed():
    for faces in FACES.values():
        edges = [frozenset(pair) for face in faces for pair in zip(face, (*face[1:], face[0]), strict=True)]
        assert all(edges.count(edge) == 2 for edge in edges)


def test_shared_faces_are_omitted():
    triangles, quads = outer_faces(hybrid())
    assert len(quads) == 0  # the pyramids stand on hexes
    assert len(triangles) == 2 * 4 + 4 - 2 * 2


def test_a_cut_removes_cells_by_their_centres():
    triangles, _ = outer_faces(hybrid(), Cut.at((1, 0, 0), (0.7, 0, 0)))
    assert len(triangles) == 4


def test_they_are_drawn_unless_switched_off(off_screen):
    mesh, viewport = hybrid(), off_screen(240, 180)
    layer = viewport.overlay_layers.optional["others"]
    viewport.draw(frame_of(mesh))
    viewport.view("iso")
    seen, poly = viewport.pixels(), layer.poly
    assert layer.shown
    assert viewport.places[:, 2].max() == 2
    viewport.draw(frame_of(mesh))
    assert layer.poly is poly
    viewport.draw(frame_of(mesh, OFF))
    without = viewport.pixels()
    assert not layer.shown
    assert np.abs(seen - without).sum(axis=2).astype(bool).sum() > 500
