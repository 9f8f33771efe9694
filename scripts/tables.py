"""Write tables of the program's declarations into docs, between their marks; a test compares.

Use: python scripts/tables.py
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import is_dataclass
from enum import StrEnum
from pathlib import Path
from types import NoneType, UnionType
from typing import Any, Union, get_args, get_origin

from api_names import API, names

from hexmend.io import FORMATS
from hexmend.io.base.format import Capability
from hexmend.parameters import declared
from hexmend.quality import METRICS, Metric
from hexmend.run.memory import format_bytes, needed
from hexmend.smoothers import METHODS
from hexmend.solver_checks import QUOTED, SOLVERS
from hexmend.solver_checks.solver import VALIDITY
from hexmend_app.codec.option import Option, options_of
from hexmend_app.picture import Scene
from hexmend_app.widgets.inputs.key_form import helps

ROOT = Path(__file__).resolve().parents[1]

#: Sizes of meshes for which memory is predicted.
_HEXES = 100_000, 1_000_000


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table in Markdown."""
    lines = [head, ["---"] * len(head), *([cell.replace("|", r"\|") for cell in row] for row in rows)]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines).replace("| --- ", "|---").replace("|--- |", "|---|")


PARAMETER_HEAD = "name", "default", "values", "what"


def parameters(of: type) -> list[tuple[str, ...]]:
    """Rows of the parameters that a class declares."""
    return [
        (f"`{one.name}`", f"`{_shown(one.default)}`", one.range + (one.unit and f" ({one.unit})"), one.help)
        for one in declared(of)
    ]


def methods() -> str:
    """The methods, the default first."""
    order = sorted(METHODS.values(), key=lambda method: method.name != "mend")
    return table(("name", "what"), ((f"`{one.name}`", one.help) for one in order))


def metrics() -> str:
    """The metrics, those of the thesis first."""
    which = {1: "higher", -1: "lower", 0: "–"}
    rows = (
        (f"`{one.name}`", one.formula, _range(one.full_range), _range(one.acceptable), which[one.better])
        for one in _metrics()
    )
    return table(("name", "formula", "range", "acceptable", "better"), rows)


def meanings() -> str:
    """The meaning of a bad value of each metric, and the sources."""
    sources: dict[str, list[str]] = {}
    for one in _metrics():
        sources.setdefault(one.source, []).append(f"`{one.name}`")
    lines = "\n".join(f"- {source}: {', '.join(which)}" for source, which in sources.items())
    rows = ((f"`{one.name}`", one.meaning) for one in _metrics())
    return f"{table(('name', 'meaning'), rows)}\n\nSources:\n\n{lines}"


def solvers() -> str:
    """The checks of every solver: limits, definitions, sources, and what is left out."""
    parts = []
    for solver in sorted(SOLVERS.values(), key=lambda one: one.title.lower()):
        checks = [one for one in solver.checks if one is not VALIDITY]
        sources = list(dict.fromkeys(_marked(one.source) for one in checks))
        rows: dict[str, tuple[str, ...]] = {}
        first: dict[str, str] = {}  # checks by their definitions
        for one in checks:
            number = str(1 + sources.index(_marked(one.source)))
            words = (one.limit_text, one.unit, f"({one.level.name.lower()})") if one.limit is not None else ("–",)
            limit = " ".join(filter(None, words))
            name = one.name.removesuffix(", errors")
            if name in rows:  # its second limit
                _, before, what, above = rows[name]
                number = above if number in above.split(", ") else f"{above}, {number}"
                rows[name] = name, f"{before}, {limit}", what, number
                continue
            known = first.setdefault(one.definition, name)
            rows[name] = name, limit, one.definition if known == name else f"as for {known}", number
        head = ("check", "limit", "definition", "source")
        numbered = "\n".join(f"{number}. {source}" for number, source in enumerate(sources, 1))
        parts += [f"## {solver.title}\n`--for {solver.name}`. {solver.tests_validity} {solver.omitted}"]
        parts += [table(head, rows.values()), f"Sources:\n\n{numbered}"]
    return "\n\n".join(parts)


def _marked(source: str) -> str:
    """A source with an asterisk in place of the reservation on its limits, which the page states once."""
    return source.replace(f" ({QUOTED})", r"\*")


def formats() -> str:
    """The formats, and what of a mesh those hold that are written: that across, so that a page is wide enough."""
    all_of_them = (
        (
            one.title,
            ", ".join(f"`{suffix}`" for suffix in one.suffixes),
            " or ".join(one.encodings) or ("copies alone" if one.locate else "not written"),
        )
        for one in FORMATS.values()
    )
    alike: dict[frozenset[Capability], list[str]] = {}
    for one in sorted(FORMATS.values(), key=lambda one: one.title.lower()):
        if one.write:
            alike.setdefault(frozenset(one.capabilities), []).append(one.title)
    held = (
        (thing.value, *("yes" if thing in capabilities else "no" for capabilities in alike)) for thing in Capability
    )
    first = table(("format", "suffix", "written as"), all_of_them)
    return f"{first}\n\n{table(('', *map(', '.join, alike.values())), held)}"


def memory() -> str:
    """The predicted memory of a run of each method, largest first."""
    order = sorted(METHODS.values(), key=lambda method: (-method.bytes_per_hex, method.name))
    rows = (
        (f"`{one.name}`", f"{one.bytes_per_hex:,}", *(format_bytes(needed(one(), hexes)) for hexes in _HEXES))
        for one in order
    )
    return table(("method", "bytes a hex", *(f"{hexes:,} hexes" for hexes in _HEXES)), rows)


def scene() -> str:
    """The keys of a scene file, table by table."""
    parts = []
    for one in options_of(Scene):
        help, kind = helps(Scene)[one.field], _table_of(one.kind)
        if kind is None:
            continue
        if one.name == "cameras":
            parts.append(f"### `[cameras.NAME]`\n{help} Its keys are those of `[camera]`.")
            continue
        several = {"panels": "[[panels]]"}.get(one.name, f"[{one.name}]")
        parts.append(f"### `{several}`\n{help}\n\n{_keys(kind)}")
    return "\n\n".join(parts)


def _keys(kind: type) -> str:
    """The keys of a table, and below each that is a table itself, its own; keys that are alike share a row."""
    rows = []
    for one in options_of(kind):
        rows.append((f"`{one.name}`", _values(one), helps(kind)[one.field] + _default(one)))
        inner = _table_of(one.kind)
        if inner is not None:
            rows += [(f"`{one.name}.{key.name}`", _values(key), helps(inner)[key.field] + _default(key))
                     for key in options_of(inner)]  # fmt: skip
    alike: dict[tuple[str, ...], list[str]] = {}
    for name, *rest in rows:
        alike.setdefault(tuple(rest), []).append(name)
    return table(("key", "values", "what"), ((", ".join(keys), *rest) for rest, keys in alike.items()))


def _table_of(kind: Any) -> type | None:
    """The table that a key's type holds, alone, in a list or by name."""
    if is_dataclass(kind):
        return kind
    return next((found for inner in get_args(kind) if (found := _table_of(inner)) is not None), None)


def _values(one: Option) -> str:
    """Describe the values that a key can have."""
    words = []
    for kind in get_args(one.kind) if get_origin(one.kind) in (UnionType, Union) else (one.kind,):
        inner = [part for part in get_args(kind) if part is not ...]
        if kind is NoneType:
            continue
        if _table_of(kind) is not None:
            words.append("tables" if get_origin(kind) is tuple else "a table")
        elif inner and inner[0] is str:
            words.append("a list of names")
        elif get_origin(kind) in (tuple, frozenset):
            whole = "whole " * (inner[0] is int)
            fixed = get_origin(kind) is tuple and ... not in get_args(kind)
            words.append(f"{len(inner)} {whole}numbers" if fixed else f"a list of {whole}numbers")
        elif issubclass(kind, StrEnum):
            words.append(", ".join(f'"{choice}"' for choice in kind))
        elif kind is str:
            words.append("text")
        else:
            known = {bool: "true or false", int: "a whole number", float: "a number"}[kind]
            words.append(known + (one.bounds if kind is not bool else ""))
    return " or ".join(words)


def _default(one: Option) -> str:
    """Describe the default of a key; nothing for one that is off or empty."""
    value = one.default
    if _table_of(one.kind) is not None or value in (None, False, "", (), frozenset()):
        return ""
    value = {tuple: list, frozenset: sorted}.get(type(value), lambda own: own)(value)
    shown = f'"{value}"' if isinstance(value, str) else value
    return f" Default {str(shown).lower()}."


def api() -> str:
    """The public names of `hexmend`, page by page."""
    pages: dict[str, list[str]] = {}
    for page, link, summary in names():
        pages.setdefault(page, []).append(f"- {link}: {summary}")
    titles = {page: (API / page).read_text(encoding="utf-8").split("\n")[0].removeprefix("# ") for page in pages}
    return "\n\n".join(f"## [{titles[page]}]({page})\n" + "\n".join(lines) for page, lines in sorted(pages.items()))


#: Tables by file.
TABLES: dict[str, tuple[str, Callable[[], str]]] = {
    "methods": ("docs/reference/methods.md", methods),
    "metrics": ("docs/reference/metrics.md", metrics),
    "meanings": ("docs/reference/metrics.md", meanings),
    "solvers": ("docs/reference/solvers.md", solvers),
    "formats": ("docs/reference/formats.md", formats),
    "scene": ("docs/reference/scene.md", scene),
    "memory": ("docs/measurements/performance-size.md", memory),
    "api": ("docs/api/index.md", api),
}


def written(name: str, text: str) -> str:
    """A file's text with one of `TABLES` as it is now.

    Raises
    ------
    ValueError
        Where the file has no place for it, `<!-- table: NAME -->` to `<!-- end -->`.
    """
    place = re.compile(rf"(<!-- table: {name} -->\n).*?(\n<!-- end -->)", re.DOTALL)
    if len(place.findall(text)) != 1:
        raise ValueError(f"there are {len(place.findall(text))} places for the table of {name}: expected one")
    return place.sub(lambda found: found[1] + TABLES[name][1]() + found[2], text)


def _metrics() -> list[Metric]:
    """Methods, those of the thesis first."""
    return sorted(METRICS.values(), key=lambda metric: ("q", "scaled-jacobian", metric.name).index(metric.name))


def _shown(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else f"{value:g}" if isinstance(value, float) else str(value)


def _range(ends: tuple[float, float]) -> str:
    return " to ".join(f"{end:g}".replace("inf", "∞").replace("-", "−") for end in ends)


if __name__ == "__main__":
    for name, (file, _) in TABLES.items():
        path = ROOT / file
        path.write_text(written(name, path.read_text(encoding="utf-8")), encoding="utf-8")
