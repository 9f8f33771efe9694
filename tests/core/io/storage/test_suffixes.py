"""What is written under a suffix that it cannot have is refused with those that it can."""

import pytest

from hexmend.errors import FileError
from hexmend.io.storage.suffixes import suffix_for


@pytest.mark.parametrize("name", ["a.csv", "a.CSV", "b.md", "c.d.md"])
def test_a_suffix_that_there_is_is_told_in_small_letters(name):
    assert suffix_for(name, "a table", [".csv", ".md"]) == f".{name.rpartition('.')[2].lower()}"


def test_no_suffix_is_admitted_only_where_it_is_named():
    assert suffix_for("/dev/stdout", "a table", [".csv", ""]) == ""
    with pytest.raises(FileError, match=r"as a file without a suffix. Use \.csv\.$"):
        suffix_for("table", "a table", [".csv"])
