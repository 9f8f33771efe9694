"""The worst hexes, and the texts on them."""

import numpy as np

from hexmend import gallery
from hexmend.quality import measure
from hexmend_app.report.worst import Locked, reason, worst_table


def tangled():
    """A grid of hexes, one corner of which is pushed through itself by nodes of the boundary alone."""
    mesh = gallery.make("cube", size=27)
    points = mesh.points.copy()
    corner = int(np.argmin(points.sum(axis=1)))
    points[corner] += 0.9 * np.ptp(points, axis=0)
    return mesh.with_points(points), corner


def test_a_locked_hex_is_first_and_its_node_is_named():
    mesh, corner = tangled()
    figures = measure(mesh.points, mesh.hexes)
    held = Locked.of(mesh, figures)
    (hex,) = np.flatnonzero((mesh.hexes == corner).any(axis=1))
    assert held.locked[hex]
    said = reason(mesh, figures, held, int(hex))
    assert said.startswith("locked at node")
    assert "σ = -" in said
    assert str(corner) in said
    table = worst_table("now", mesh, figures, held)
    assert table.rows[0][0] == str(hex)
    assert "locked" in held.words()
    assert table.rows[0][1:3] == [f"{figures.q[hex]:.4f}", f"{figures.scaled_jacobian[hex]:.4f}"]


def test_a_sound_mesh_has_nothing_locked():
    mesh = gallery.make("cube", size=27)
    figures = measure(mesh.points, mesh.hexes)
    held = Locked.of(mesh, figures)
    assert held.words() == ""
    assert all(row[-1].startswith("sound") for row in worst_table("now", mesh, figures, held).rows)
