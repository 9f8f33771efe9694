"""TOML files: read with what is wrong said by file, written as a whole."""

import pytest

from hexmend.errors import FileError, ParameterError
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
