"""What a feature remembers of what it has shown."""

import numpy as np

from hexmend_app.feature import Seen


def test_something_is_another_once():
    seen = Seen()
    assert seen.another("size", 3, "hexes")
    assert not seen.another("size", 3, "hexes")
    assert seen.another("size", 4, "hexes")
    assert seen.another("colour", 4, "hexes")
    assert seen.another("size", 4)
    seen.forget()
    assert seen.another("size", 4)


def test_nothing_is_something_to_be_seen():
    seen = Seen()
    assert seen.another("chosen", None)
    assert not seen.another("chosen", None)
    assert seen.another("nothing")
    assert not seen.another("nothing")


def test_an_array_is_another_where_it_is_another_object():
    seen, pinned = Seen(), np.zeros(3, bool)
    assert seen.another("pinned", None, 1)
    assert seen.another("pinned", pinned, 1)
    assert not seen.another("pinned", pinned, 1)
    assert seen.another("pinned", pinned.copy(), 1)
    assert seen.another("pinned", None, 1)


def test_a_number_of_numpy_is_compared_as_a_number():
    seen = Seen()
    assert seen.another("hex", np.int64(4))
    assert not seen.another("hex", 4)
