"""What a feature remembers of what it has shown."""

import numpy as np

from hexmend_app.feature import ChangeTracker


def test_something_is_another_once():
    seen = ChangeTracker()
    assert seen.changed("size", 3, "hexes")
    assert not seen.changed("size", 3, "hexes")
    assert seen.changed("size", 4, "hexes")
    assert seen.changed("colour", 4, "hexes")
    assert seen.changed("size", 4)
    seen.forget()
    assert seen.changed("size", 4)


def test_nothing_is_something_to_be_seen():
    seen = ChangeTracker()
    assert seen.changed("chosen", None)
    assert not seen.changed("chosen", None)
    assert seen.changed("nothing")
    assert not seen.changed("nothing")


def test_an_array_is_another_where_it_is_another_object():
    seen, pinned = ChangeTracker(), np.zeros(3, bool)
    assert seen.changed("pinned", None, 1)
    assert seen.changed("pinned", pinned, 1)
    assert not seen.changed("pinned", pinned, 1)
    assert seen.changed("pinned", pinned.copy(), 1)
    assert seen.changed("pinned", None, 1)


def test_a_number_of_numpy_is_compared_as_a_number():
    seen = ChangeTracker()
    assert seen.changed("hex", np.int64(4))
    assert not seen.changed("hex", 4)
