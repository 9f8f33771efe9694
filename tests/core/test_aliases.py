"""Names of earlier versions go on being read."""

from __future__ import annotations

import importlib
import subprocess
import sys

import pytest

import hexmend as hx
from hexmend import aliases


@pytest.mark.parametrize(("old", "new"), aliases.MODULES.items())
def test_a_module_is_imported_by_its_old_name(old, new):
    assert importlib.import_module(old) is importlib.import_module(new)


@pytest.mark.parametrize(("old", "new"), aliases.NAMES.items())
def test_a_name_is_had_where_it_was(old, new):
    (home, _, name), (place, _, now) = old.rpartition("."), new.rpartition(".")
    found = getattr(importlib.import_module(home), name)
    assert found is getattr(importlib.import_module(place), now)
    assert name not in getattr(importlib.import_module(home), "__all__", ())  # read, but listed no more


def test_a_name_that_never_was_is_an_attribute_error():
    with pytest.raises(AttributeError, match="no attribute 'Sopt'"):
        hx.Sopt  # noqa: B018


def test_the_old_spelling_of_a_script_works_in_a_process_of_its_own():
    script = (
        "import hexmend as hx\n"
        "from hexmend.optimise import Stop\n"
        "from hexmend.fixing import with_pinned\n"
        "import hexmend.surface, hexmend.topology as t\n"
        "print(hx.Stop is Stop, hexmend.surface.Kind.__name__, t.Rows.__name__)\n"
    )
    ran = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60)
    assert (ran.stdout, ran.stderr) == ("True NodeClass CSR\n", "")


def test_renamed_keys_keep_the_new_value_where_both_are_there():
    assert aliases.renamed({"old": 1, "other": 2}, {"old": "new"}) == {"new": 1, "other": 2}
    assert aliases.renamed({"old": 1, "new": 3}, {"old": "new"}) == {"new": 3}
