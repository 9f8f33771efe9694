"""Named sets of hexes, nodes and sides are added to a mesh and removed."""

import numpy as np
import pytest

from hexmend import Cells, MeshError, ParameterError, add_set, remove_set
from hexmend.mesh.rules.named_sets import set_names
from tests.core.grids import grid

MESH = grid(3)


def test_a_set_of_each_kind_is_added_and_removed():
    mesh = add_set(add_set(add_set(MESH, "a", hexes=[5, 2]), "b", nodes=[1]), "c", sides=[[0, 4]])
    assert (mesh.hex_sets["a"].tolist(), mesh.node_sets["b"].tolist(), mesh.side_sets["c"].tolist()) == (
        [5, 2],
        [1],
        [[0, 4]],
    )
    assert not MESH.hex_sets
    assert add_set(mesh, "a", hexes=[7]).hex_sets["a"].tolist() == [7]
    left = remove_set(mesh, "b")
    assert not left.node_sets
    assert list(left.hex_sets) == ["a"]
    both = add_set(mesh, "a", nodes=[3])
    assert not {"a"} & {*remove_set(both, "a").hex_sets, *remove_set(both, "a").node_sets}


def test_what_is_no_set_is_refused():
    for members in ({}, {"hexes": [0], "nodes": [0]}):
        with pytest.raises(ParameterError, match="set 'a': expected its members by one of hexes=, nodes= and sides="):
            add_set(MESH, "a", **members)
    with pytest.raises(MeshError, match="hex set 'a' has 27"):
        add_set(MESH, "a", hexes=[27])
    with pytest.raises(MeshError, match=r"there is no set 'inlt': did you mean inlet\? there are 'inlet'"):
        remove_set(add_set(MESH, "inlet", nodes=np.arange(4)), "inlt")


def test_a_set_of_other_cells_is_removed_too():
    quads = MESH.topology.boundary_faces[:4]
    mesh = MESH.replace(cells=(Cells("quad", quads, sets={"wall": [0, 1], "inlet": [2]}),))
    assert set_names(mesh) == ["wall", "inlet"]
    assert set_names(remove_set(mesh, "wall")) == ["inlet"]
    with pytest.raises(MeshError, match=r"no set 'wal': did you mean wall\? there are 'wall', 'inlet'"):
        remove_set(mesh, "wal")
