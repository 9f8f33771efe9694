"""Choice of the node that is explained; the camera moves to it."""

import numpy as np
import pytest

from hexmend_app.features.node_step.feature import FeatureNode
from tests.app.hosting import PlainHost, action
from tests.core.grids import grid, scrambled


@pytest.fixture
def host(qtbot):
    host = PlainHost(scrambled(grid(4), 0.3))
    host.session.selection.listing = lambda: np.argsort(host.session.document.now.figures.q)
    host.visited = []
    host.session.selection.visited.connect(host.visited.append)
    yield host
    host.session.close()


@pytest.mark.parametrize("chosen", ["nothing", "a hex", "a free node"])
def test_the_camera_moves_to_the_explained_node(host, chosen):
    selection, mesh = host.session.selection, host.session.document.now.mesh
    free = int(np.flatnonzero(mesh.free)[0])
    around = int((mesh.hexes == free).any(axis=1).argmax())
    if chosen != "nothing":
        selection.choose(around, free if chosen == "a free node" else None)
    action(FeatureNode(host), "explain_node").handle()
    assert host.fronted == ["node"]
    assert host.visited == [(selection.hex,)]
    assert mesh.free[selection.node]
    assert selection.node in mesh.hexes[selection.hex]
    if chosen == "a free node":
        assert (selection.hex, selection.node) == (around, free)
    elif chosen == "a hex":
        assert selection.hex == around
