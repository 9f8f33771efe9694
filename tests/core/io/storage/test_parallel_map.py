"""A function over many items in several threads: in their order, and the first error is raised."""

import pytest

from hexmend.io.storage import parallel_map as maps
from hexmend.io.storage.parallel_map import parallel_map


@pytest.fixture(params=[1, 3])
def threads(request, monkeypatch):
    monkeypatch.setattr(maps, "threads", lambda: request.param)


def square(item):
    if item < 0:
        raise ValueError(f"{item} is negative")
    return item**2


@pytest.mark.usefixtures("threads")
def test_results_are_in_the_order_of_the_items_and_so_are_errors():
    assert list(parallel_map(square, range(10))) == [k**2 for k in range(10)]
    assert list(parallel_map(square, [])) == []
    with pytest.raises(ValueError, match="-1 is negative"):
        list(parallel_map(square, [1, 2, 3, -1, -2]))
