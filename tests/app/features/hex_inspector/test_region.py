"""Pinning all nodes outside the isolated hexes and the rings around them."""

import numpy as np
import pytest


@pytest.mark.slow
def test_only_the_isolated_region_is_free_until_undo(window):
    session = window.session
    mesh = session.document.now.mesh
    session.view.isolate([40], 1)
    window.refresh()
    assert window.window_actions["free_isolated"].isEnabled()
    window.window_actions["free_isolated"].trigger()
    expected = np.zeros(mesh.n_nodes, dtype=bool)
    expected[mesh.hexes[mesh.topology.hexes_around([40], 1)]] = True
    np.testing.assert_array_equal(session.document.now.mesh.free, expected & mesh.free)
    assert session.document.undo_title == "free a region"
    session.commands.undo()
    np.testing.assert_array_equal(session.document.now.mesh.free, mesh.free)
