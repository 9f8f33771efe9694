"""Write the pages of the reference that are generated from the program's declarations; a test compares.

In docs/reference, methods.md has every method with its parameters, commands.md every command with its options. Text
above the mark in these files is written by hand, or by scripts/tables.py.

Use: python scripts/write_reference.py
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

from tables import PARAMETER_HEAD, parameters, table

from hexmend.cli.command import Command
from hexmend.cli.main import commands
from hexmend.smoothers import METHODS

DOCS = Path(__file__).resolve().parents[1] / "docs" / "reference"
MARK = "<!-- written by make docs from here on -->\n"


Row = tuple[str, ...]


class Section(NamedTuple):
    """A section of a page: its texts, and the rows of its table."""

    name: str
    texts: Sequence[str]
    rows: Sequence[Row]


def page(sections: Sequence[Section], head: Row, common: str) -> Iterator[str]:
    """Texts of sections with their tables; rows of several sections stand once, in a section named `common`."""
    counts = Counter(row for section in sections for row in section.rows)
    often = {_name(row): row for row, count in reversed(counts.most_common()) if count > 1}  # one row of each name
    shared = [row for row in counts if often.get(_name(row)) == row]
    if shared:
        yield f"## {common}"
        yield table(head, shared)
    for section in sections:
        yield f"## {section.name}"
        yield from section.texts
        if own := [row for row in section.rows if row not in shared]:
            yield table(head, own)
        if names := [f"`{_name(row)}`" for row in section.rows if row in shared]:
            yield f"{common}: {', '.join(names)}."


def _name(row: Row) -> str:
    return row[0].split(" ")[0].strip("`,")


def methods() -> Iterator[str]:
    """A section for each method, the default first."""
    order = sorted(METHODS.values(), key=lambda method: method.name != "mend")
    sections = [Section(one.name, [f"{one.title}. Source: {one.source}."], parameters(one)) for one in order]
    return page(sections, PARAMETER_HEAD, "Common parameters")


def every_command() -> Iterator[str]:
    """A section for each command: what it does, and its options."""
    return page([_command(name, load()) for name, load in commands().items()], ("option", "what"), "Common options")


def _command(name: str, command: Command) -> Section:
    parser = argparse.ArgumentParser(prog=f"hexmend {name}", allow_abbrev=False, add_help=False)
    command.arguments(parser)
    shown = (one for one in parser._actions if one.help is not argparse.SUPPRESS)
    rows = [(_option(one), _help(one)) for one in shown]
    return Section(name, [command.help, f"```\n{_usage(parser)}\n```"], rows)


def _usage(parser: argparse.ArgumentParser) -> str:
    """Return the usage: required arguments, and [OPTION]... for the others."""
    needed = [one for one in parser._actions if one.required or not one.option_strings]
    words = [_word(one) for one in sorted(needed, key=lambda one: bool(one.option_strings))]
    optional = [] if len(needed) == len(parser._actions) else ["[OPTION]..."]
    return " ".join([parser.prog, *words, *optional])


def _word(one: argparse.Action) -> str:
    name = _value(one)
    if one.option_strings:
        return f"{one.option_strings[0]} {name}".strip()
    return {"?": f"[{name}]", "*": f"[{name}]...", "+": f"{name}..."}.get(str(one.nargs), name)


def _value(one: argparse.Action) -> str:
    if one.nargs == 0:
        return ""
    if one.choices is not None and one.metavar is None:
        return "{" + ",".join(map(str, one.choices)) + "}"
    if isinstance(one.metavar, tuple):  # of an option with several values
        return " ".join(one.metavar)
    return str(one.metavar or one.dest.upper())


def _option(one: argparse.Action) -> str:
    return ", ".join(f"`{f'{name} {_value(one)}'.strip()}`" for name in one.option_strings or ("",))


def _help(one: argparse.Action) -> str:
    text = (one.help or "").replace("%(default)s", str(one.default)).replace("%%", "%")
    again = isinstance(one, argparse._AppendAction) and "repeated" not in text and "again" not in text
    return text + ("; may be repeated" if again else "")


PAGES: dict[str, Callable[[], Iterator[str]]] = {
    "methods.md": methods,
    "commands.md": every_command,
}


def written(name: str, text: str) -> str:
    """A page's text with what is declared now.

    Raises
    ------
    ValueError
        Where the page lacks the mark.
    """
    if text.count(MARK) != 1:
        raise ValueError(f"{name} has {text.count(MARK)} marks: expected one line {MARK!r}")
    return text[: text.index(MARK)] + MARK + "\n" + "\n\n".join(PAGES[name]()) + "\n"


if __name__ == "__main__":
    for name in PAGES:
        path = DOCS / name
        path.write_text(written(name, path.read_text(encoding="utf-8")), encoding="utf-8")
