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


def test_none_no_values_and_numpy_scalars_count_as_values():
    seen = ChangeTracker()
    for name, values in (("chosen", (None,)), ("nothing", ())):
        assert seen.changed(name, *values)
        assert not seen.changed(name, *values)
    assert seen.changed("hex", np.int64(4))
    assert not seen.changed("hex", 4)


def test_arrays_are_compared_by_identity():
    seen, pinned = ChangeTracker(), np.zeros(3, bool)
    for value, changed in ((None, True), (pinned, True), (pinned, False), (pinned.copy(), True), (None, True)):
        assert seen.changed("pinned", value, 1) == changed
