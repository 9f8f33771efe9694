"""TOML files: read with what is wrong said by file, written as a whole."""

import pytest

from hexmend.errors import FileError, ParameterError
from hexmend.io.storage import parallel_map as maps
from hexmend.io.storage.parallel_map import parallel_map
from hexmend.io.storage.suffixes import suffix_for
from hexmend.io.storage.toml_files import read_toml, write_toml


def refuses(text):
    raise ParameterError(f"line 1 holds {text!r}")


def test_what_is_written_is_read(tmp_path):
    path = tmp_path / "one.toml"
    write_toml(path, "a recipe", "title = 'Größe'\n")
    assert read_toml(path, "a recipe", str.strip) == "title = 'Größe'"


def test_what_is_wrong_names_the_file_and_what_to_do(tmp_path):
    path = tmp_path / "one.toml"
    path.write_text("x")
    with pytest.raises(FileError, match=r"one\.toml: line 1 holds 'x'.*Correct the file"):
        read_toml(path, "a recipe", refuses)


def test_a_text_that_is_too_long_is_not_handed_on(tmp_path):
    path = tmp_path / "one.toml"
    path.write_text("x" * 11)
    with pytest.raises(FileError, match="expected a scene, of 10 at most"):
        read_toml(path, "a scene", refuses, largest=10)


def test_another_suffix_is_refused_before_anything_is_written(tmp_path):
    path = tmp_path / "one.json"
    with pytest.raises(FileError, match=r"a scene cannot be written as \.json"):
        write_toml(path, "a scene", "")
    assert not path.exists()


# What is written under a suffix that it cannot have is refused with those that it can.


@pytest.mark.parametrize("name", ["a.csv", "a.CSV", "b.md", "c.d.md"])
def test_a_suffix_that_there_is_is_told_in_small_letters(name):
    assert suffix_for(name, "a table", [".csv", ".md"]) == f".{name.rpartition('.')[2].lower()}"


def test_no_suffix_is_admitted_only_where_it_is_named():
    assert suffix_for("/dev/stdout", "a table", [".csv", ""]) == ""
    with pytest.raises(FileError, match=r"as a file without a suffix. Use \.csv\.$"):
        suffix_for("table", "a table", [".csv"])


# A function over many items in several threads: in their order, and the first error is raised.


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
