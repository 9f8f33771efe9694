"""Frames, and updates of a view, which draws only differences between frames."""

import dataclasses

import numpy as np
import pytest

from hexmend import Mesh, measure
from hexmend_app.picture.appearance import Look
from hexmend_app.picture.displacement import Displacement, ReferenceState
from hexmend_app.picture.page import LineStyle
from hexmend_app.scene.geometry.frame import Frame, same_hexes
from tests.core.grids import grid, scrambled

MESH = grid(4)
FIGURES = measure(MESH.points, MESH.hexes)
MOVED = scrambled(MESH, 0.2)
MOVED_FIGURES = measure(MOVED.points, MOVED.hexes)


@pytest.fixture
def watched(off_screen, monkeypatch):
    """A function that draws a frame and returns the names of the called methods, and the viewport."""
    viewport, done = off_screen(80, 60), []

    def watch(part, name):
        act = getattr(part, name)
        monkeypatch.setattr(part, name, lambda *what: (done.append(name), act(*what)))

    for part, name in (
        (viewport.mesh_layer, "set_mesh"),
        (viewport.mesh_layer, "rebuild"),
        (viewport.mesh_layer, "move"),
        (viewport.colours, "measure"),
    ):
        watch(part, name)

    def draw(frame):
        done.clear()
        viewport.draw(frame)
        return set(done)

    return draw, viewport


def test_the_same_frame_costs_nothing(watched):
    draw, viewport = watched
    frame = Frame(MESH, FIGURES)
    draw(frame)
    assert draw(frame) == set()
    assert draw(dataclasses.replace(frame, look=Look())) == set()  # another look that says the same
    assert viewport.frame is not frame


def test_moved_nodes_update_positions_only(watched):
    draw, viewport = watched
    draw(Frame(MESH, FIGURES))
    faces = viewport.mesh_layer.faces
    assert draw(Frame(MESH.with_points(MOVED.points), MOVED_FIGURES)) == {"move", "measure"}
    assert viewport.mesh_layer.faces is faces
    np.testing.assert_allclose(viewport.mesh_layer.whole.points, faces.places(MOVED.points), rtol=1e-6)


def test_equality_of_hexes_does_not_depend_on_positions():
    assert same_hexes(MESH, MOVED)
    assert same_hexes(MESH, Mesh(MOVED.points, MESH.hexes))
    assert not same_hexes(MESH, grid(3))
    assert Frame(MESH.with_points(MOVED.points), FIGURES).is_of(Frame(MESH, FIGURES))
    assert not Frame(Mesh(MESH.points, MESH.hexes), FIGURES).is_of(Frame(MESH, FIGURES))
    assert not Frame(MESH, FIGURES).is_of(None)


def test_a_matching_frame_has_the_same_look_and_reference_state():
    movement = Displacement(MESH, ReferenceState(MOVED.points, MOVED_FIGURES, "then"), MESH.points, FIGURES)
    first = Frame(MESH, FIGURES, movement, Look(lines=LineStyle(edges=0.0)))
    other = Frame(MESH.with_points(MESH.points * 2), FIGURES).matching(first)
    assert other.look is first.look
    assert other.movement.before is movement.before
    np.testing.assert_array_equal(other.movement.points, 2 * MESH.points)
    assert other.matching(dataclasses.replace(first, look=Look())).movement is other.movement  # measured once
    renamed = dataclasses.replace(movement, before=dataclasses.replace(movement.before, name="later"))
    assert other.matching(dataclasses.replace(first, movement=renamed)).movement.before.name == "later"
    small = grid(2)
    assert Frame(small, measure(small.points, small.hexes)).matching(first).movement is None
