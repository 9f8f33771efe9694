"""Which terminals get colours and lines that change in place: one answer for all that is printed."""

import sys

import pytest

from hexmend.terminal_text import redraws_lines, shows_colours


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
