"""Which terminals get colours and lines that change in place: one answer for all that is printed."""

import sys

import pytest

from hexmend.errors import ParameterError
from hexmend.terminal_text import redraws_lines, shows_colours
from hexmend.toml_text import MAX_KEY_PARTS, parse_toml


class Stream:
    def __init__(self, is_terminal):
        self.isatty = lambda: is_terminal


@pytest.mark.parametrize(("is_terminal", "term", "variables", "coloured", "redrawn"), [
    (True, "xterm", {}, True, True),
    (True, None, {}, True, True),
    (True, "dumb", {}, False, False),
    (True, "unknown", {}, False, False),
    (True, "xterm", {"NO_COLOR": "1"}, False, True),
    (False, "xterm", {}, False, False),
    (False, "xterm", {"FORCE_COLOR": "1"}, True, True),
    (False, "dumb", {"FORCE_COLOR": "1"}, True, False),
    (True, "dumb", {"FORCE_COLOR": "1", "NO_COLOR": "1"}, False, False),
])  # fmt: skip
def test_a_dumb_terminal_gets_no_codes_unless_colours_are_forced(
    monkeypatch, is_terminal, term, variables, coloured, redrawn
):
    for name in ("TERM", "NO_COLOR", "FORCE_COLOR"):
        monkeypatch.delenv(name, raising=False)
    for name, value in {**variables, **({"TERM": term} if term else {})}.items():
        monkeypatch.setenv(name, value)
    monkeypatch.setattr(sys, "stdout", Stream(is_terminal))
    monkeypatch.setattr(sys, "stderr", Stream(is_terminal))
    assert (shows_colours(), redraws_lines()) == (coloured, redrawn)


# TOML from anywhere: what a parser would take for ever over is refused beforehand, and nothing else.


_DEEP = ".".join("a" * (MAX_KEY_PARTS + 3))
_QUOTED = "'''"


KEYS_OF_TOO_MANY_PARTS = [
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
]


@pytest.mark.parametrize("text", KEYS_OF_TOO_MANY_PARTS)
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
