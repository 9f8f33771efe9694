"""Numbers of a file: found again wherever they stand, kept where they can be."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.errors import FileError
from hexmend.io.base.content import Block
from hexmend.io.base.numbering import element_ids, find_ids, node_ids, runs, set_combinations

numbers = st.lists(st.integers(-(10**9), 10**9), min_size=1, max_size=20, unique=True)


@given(ids=numbers, data=st.data())
def test_places_are_where_the_numbers_stand(ids, data):
    wanted = np.array(data.draw(st.lists(st.sampled_from(ids), min_size=1)))
    assert (np.array(ids)[find_ids(Path("a"), np.array(ids), wanted, "node")] == wanted).all()


@pytest.mark.parametrize(
    ("ids", "words"), [([1, 2, 3], "node 9 is used"), ([4, 9, 4], "node 4 is given twice"), ([], "node 9 is used")]
)
def test_numbers_that_are_not_there_or_twice_are_named(ids, words):
    with pytest.raises(FileError, match=words):
        find_ids(Path("a"), np.array(ids, dtype=np.int64), np.array([9]), "node")


@pytest.mark.parametrize("ids", [[3, 3, 1], [0, 1, 2], [-1, 1, 2], [1, 2, 2**31], [0.5, 1.0, 2.0]])
def test_numbers_that_no_file_can_have_are_replaced(ids):
    assert node_ids({"id": np.array(ids)}, 3).tolist() == [1, 2, 3]


def test_elements_without_numbers_come_after_those_with_them():
    hexes = Block("hex", np.zeros((2, 8), int), {"id": np.array([9, 5])})
    quads = Block("quad", np.zeros((2, 4), int))
    assert [one.tolist() for one in element_ids([hexes, quads])] == [[9, 5], [10, 11]]
    assert [one.tolist() for one in element_ids([hexes, hexes])] == [[1, 2], [3, 4]]


@given(key=st.lists(st.integers(0, 2)))
def test_runs_go_through_all_in_order_and_are_each_of_one_kind(key):
    found = runs(np.array(key, dtype=np.int64))
    assert [value for part in found for value in key[part]] == key
    assert all(len(set(key[part])) == 1 for part in found)


@given(sets=st.dictionaries(st.sampled_from("abc"), st.sets(st.integers(0, 5))))
def test_combinations_are_the_sets_that_each_is_in(sets):
    found, which = set_combinations(
        {name: np.array(sorted(members), dtype=np.int64) for name, members in sets.items()}, 6
    )
    for k in range(6):
        assert set(found[which[k]]) == {name for name, members in sets.items() if k in members}
