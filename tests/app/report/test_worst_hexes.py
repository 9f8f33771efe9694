"""Table of the worst hexes, and locked hexes."""

import numpy as np

from hexmend import gallery, measure
from hexmend_app.report.worst_hexes import Locked, reason, worst_table


def inverted_corner():
    """Return a grid with a hex that is inverted by boundary nodes alone, and the node that inverts it."""
    mesh = gallery.make("cube", size=27)
    points = mesh.points.copy()
    corner = int(np.argmin(points.sum(axis=1)))
    points[corner] += 0.9 * np.ptp(points, axis=0)
    return mesh.with_points(points), corner


def test_a_locked_hex_is_first_and_its_node_is_named():
    mesh, corner = inverted_corner()
    figures = measure(mesh.points, mesh.hexes)
    locked = Locked.of(mesh, figures)
    (hex,) = np.flatnonzero((mesh.hexes == corner).any(axis=1))
    assert locked.locked[hex]
    said = reason(mesh, figures, locked, int(hex))
    assert said.startswith("locked at node")
    assert "σ = -" in said
    assert str(corner) in said
    table = worst_table("now", mesh, figures, locked)
    assert table.rows[0][0] == str(hex)
    assert "locked" in locked.words()
    assert table.rows[0][1:3] == [f"{figures.q[hex]:.4f}", f"{figures.scaled_jacobian[hex]:.4f}"]


def test_a_valid_mesh_has_no_locked_hexes():
    mesh = gallery.make("cube", size=27)
    figures = measure(mesh.points, mesh.hexes)
    locked = Locked.of(mesh, figures)
    assert locked.words() == ""
    assert all(row[-1].startswith("valid") for row in worst_table("now", mesh, figures, locked).rows)
