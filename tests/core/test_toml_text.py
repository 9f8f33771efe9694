"""TOML from anywhere: what a parser would take for ever over is refused beforehand, and nothing else."""

from __future__ import annotations

import pytest

from hexmend.errors import ParameterError
from hexmend.toml_text import MAX_KEY_PARTS, parse_toml

_DEEP = ".".join("a" * (MAX_KEY_PARTS + 3))
_QUOTED = "'''"


@pytest.mark.parametrize(
    "text",
    [
        f"{_DEEP} = 1",
        f"[{_DEEP}]",
        f"x = {{ {_DEEP} = 1 }}",
        f"x = [1, {{ b = 1, {_DEEP} = 1 }}]",
        f'"=".{_DEEP} = 1',
        f"'#'.{_DEEP} = 1",
        _DEEP.replace("a", '"a"') + " = 1",
        _DEEP.replace(".", "\t. ") + " = 1",
        f'x = "\\"" # "\n{_DEEP} = 1',
        f'x = """a"""""\n{_DEEP} = 1',
        f"x = {_QUOTED}a{_QUOTED}''\n{_DEEP} = 1",
    ],
)
def test_keys_of_too_many_parts_are_refused_wherever_they_stand(text):
    with pytest.raises(ParameterError, match=f"line {len(text.splitlines())} has a key of more than"):
        parse_toml(text, "a scene")


@pytest.mark.parametrize("value", [f'"{_DEEP}"', f"'{_DEEP}'", f'"""\n{_DEEP}"""', f'"\\"{_DEEP}"', f'"" # {_DEEP}'])
def test_texts_hold_as_many_dots_as_they_like(value):
    assert list(parse_toml(f"x = {value}\ny.z = 1", "a scene")) == ["x", "y"]


@pytest.mark.parametrize("text", ['x = """\\"""' * 100_000, 'x = "' + '\\"' * 400_000, "'" * 900_001, '"""\\'])
def test_strings_without_an_end_are_no_toml(text):
    with pytest.raises(ParameterError, match="is not TOML"):
        parse_toml(text, "a scene", 2_000_000)
