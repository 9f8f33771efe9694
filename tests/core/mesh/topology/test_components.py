"""Connected components of items and of cells."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from hexmend.mesh.topology.components import components, components_of_cells

graphs = st.integers(1, 12).flatmap(
    lambda n: st.tuples(st.just(n), st.lists(st.tuples(*[st.integers(0, n - 1)] * 2), max_size=20))
)


def of_scipy(n, links):
    graph = coo_array((np.ones(len(links), np.int8), links.T), (n, n))
    return connected_components(graph, directed=False)[1]


@given(graphs)
def test_components_are_numbered_in_the_order_of_their_lowest_items(graph):
    n, links = graph[0], np.array(graph[1], np.int64).reshape(-1, 2)
    np.testing.assert_array_equal(components(n, links), of_scipy(n, links))


def test_a_row_connects_all_its_items_and_nothing_connects_none():
    assert components(6, np.array([[5, 2, 4]])).tolist() == [0, 1, 2, 3, 2, 2]
    assert components(3).tolist() == [0, 1, 2]
    assert components(0, np.empty((0, 8), np.int32)).tolist() == []


def test_cells_are_numbered_in_the_order_of_their_first_and_connected_by_others():
    cells, others = np.array([[7, 8], [0, 1], [8, 9], [2, 3]]), np.array([[1, 4, 2]])
    assert components_of_cells(10, cells).tolist() == [0, 1, 0, 2]
    assert components_of_cells(10, cells, others).tolist() == [0, 1, 0, 1]
