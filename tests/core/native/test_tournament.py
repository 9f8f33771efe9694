"""The priority queue of sequential GETMe against a heap."""

import heapq

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from tests.core.native.extension import extension

kernels = extension()


@given(st.lists(st.integers(0, 9), min_size=1, max_size=40), st.lists(st.tuples(st.integers(0, 39), st.integers(0, 9))))
def test_the_queue_gives_what_a_heap_gives(keys, changes):
    key = np.array(keys, dtype=float)
    members = np.arange(len(keys), dtype=np.int32)[::-1].copy()  # leaves need not be in the order of the hexes
    tree = kernels.tournament.tournament(key, members)
    leaf = np.argsort(members)
    for h, new in [(0, keys[0]), *((h % len(keys), new) for h, new in changes)]:
        key[h] = new
        kernels.tournament.replay(tree, key, leaf[h])
        heap = [(k, i) for i, k in enumerate(key)]
        heapq.heapify(heap)
        assert tree[1] == heap[0][1]
