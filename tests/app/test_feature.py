"""Tracker of the values that a feature has shown."""

import numpy as np

from hexmend_app.feature import ChangeTracker


def test_a_new_value_is_changed_once():
    seen = ChangeTracker()
    assert seen.changed("size", 3, "hexes")
    assert not seen.changed("size", 3, "hexes")
    assert seen.changed("size", 4, "hexes")
    assert seen.changed("colour", 4, "hexes")
    assert seen.changed("size", 4)
    seen.forget()
    assert seen.changed("size", 4)


def test_none_and_no_values_count_as_values():
    seen = ChangeTracker()
    assert seen.changed("chosen", None)
    assert not seen.changed("chosen", None)
    assert seen.changed("nothing")
    assert not seen.changed("nothing")


def test_arrays_are_compared_by_identity():
    seen, pinned = ChangeTracker(), np.zeros(3, bool)
    assert seen.changed("pinned", None, 1)
    assert seen.changed("pinned", pinned, 1)
    assert not seen.changed("pinned", pinned, 1)
    assert seen.changed("pinned", pinned.copy(), 1)
    assert seen.changed("pinned", None, 1)


def test_numpy_scalars_are_compared_as_numbers():
    seen = ChangeTracker()
    assert seen.changed("hex", np.int64(4))
    assert not seen.changed("hex", 4)
