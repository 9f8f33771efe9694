"""Messages of mend about hexes that fixed nodes lock."""

import numpy as np

from hexmend.quality import measure
from hexmend.smoothers.mend.inversion import inverted_corners, locked_corners
from hexmend.smoothers.mend.messages import freed_message
from tests.core.grids import grid


def with_two_locked_corners():
    """A grid of which two corners are inverted, and as it would be sound."""
    sound = grid(3)
    points, ends = sound.points.copy(), (0, len(sound.points) - 1)
    middle = points.mean(axis=0)
    for node in ends:
        points[node] += 0.5 * (middle - points[node])
    return sound.with_points(points), sound.points, ends


def message_after(mesh, points):
    """The message where the boundary has slid from where a mesh has it to other points."""
    inverted = inverted_corners(points, mesh.hexes, measure(points, mesh.hexes))
    return freed_message(locked_corners(mesh, measure(mesh.points, mesh.hexes)), inverted)


def test_what_sliding_has_freed_and_what_is_left_is_said():
    mesh, sound, (one, _) = with_two_locked_corners()
    assert np.count_nonzero(locked_corners(mesh, measure(mesh.points, mesh.hexes))) == 2
    had = "2 hexes had corners that fixed nodes keep inverted: sliding freed "
    assert message_after(mesh, sound) == had + "2, none is left."
    assert message_after(mesh, mesh.points) == had + "0, 2 are left."
    half = mesh.points.copy()
    half[one] = sound[one]
    assert message_after(mesh, half) == had + "1, 1 is left."
    assert message_after(mesh.with_points(sound), mesh.points) == ""
