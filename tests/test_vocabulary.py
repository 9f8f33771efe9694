"""Identifiers, first words of docstrings and messages of core and app use the field's terms; words that are out are listed.

Each list maps a word to what to write in its place. Strings that files or the command line rely on are not identifiers.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping
from pathlib import Path

import pytest

from tests.examples import ROOT

#: Words that no identifier contains, alone or joined with others.
IDENTIFIERS = {
    "ailment": "problem",
    "allowance": "memory_budget",
    "apart": "deviation, distance",
    "beside": "extra, neighbour",
    "bends": "corners",
    "carried": "capabilities",
    "carry": "export, transfer",
    "further": "plugins, other",
    "grown": "partition",
    "how": "a noun",
    "leg": "stage_run",
    "legs": "stage_runs",
    "lifted": "released, increased",
    "mending": "repair",
    "raised": "increased, maxmin",
    "raising": "maxmin",
    "room": "band, space",
    "said": "message, output",
    "settle": "freeze, converge",
    "settled": "frozen, converged",
    "strayed": "infeasible",
    "surgery": "removal",
    "tangled": "inverted",
    "told": "text, message",
    "unturned": "rejected",
    "way": "direction, path",
    "ways": "directions, paths",
    "what": "a noun",
    "who": "a noun",
    "why": "reason",
}

#: Identifiers that are out alone; as words of others they are in use: `off_diagonal`.
ALONE = {"held": "fixed, rejected", "off": "deviation, off_diagonal", "plain": "scalar, text"}

#: Consecutive words that no identifier contains.
PHRASES = {
    "brought_near": "recentre",
    "go_on": "completed, continue",
    "goes_on": "completed, continues",
    "put_back": "project",
    "stand_in": "proxy",
}

#: First words of docstrings: a docstring begins with what the thing is or does.
OPENINGS = {
    **dict.fromkeys(("What", "Where", "Which", "Who", "How", "Whose", "Whether"), "the noun, or Return True if"),
    **dict.fromkeys(("Those", "That", "One's", "Such"), "the noun"),
    "As": "the thing itself",
}

#: Words of messages, which are strings of three words or more.
MESSAGES = {
    "ailments?": "problem",
    "beside": "next to, with",
    "go(es)? on with": "continue with",
    "put back": "projected, restored",
    "surgery": "removal",
    "told": "reported, written",
    "the same again": "a second one",
}


def packages(folder: Path) -> dict[str, list[Path]]:
    """Sources by folder of the top level; those of the top level itself by the name of the whole."""
    found: dict[str, list[Path]] = {}
    for path in sorted(path for path in folder.rglob("*") if path.suffix in (".py", ".cpp", ".hpp")):
        parts = path.relative_to(folder.parent).parts[:-1]
        found.setdefault("/".join(parts[:2]), []).append(path)
    return found


PACKAGES = packages(ROOT / "core/hexmend") | packages(ROOT / "core/native") | packages(ROOT / "app/hexmend_app")


def words(identifier: str) -> list[str]:
    """Split an identifier at underscores and capitals: `raiseLeast` is `raise` and `least`."""
    return [word.lower() for word in re.findall(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])", identifier)]


def misnamed(identifier: str) -> str:
    """Describe the word of an identifier that is out; "" where all of them are in use."""
    parts = words(identifier)
    out = IDENTIFIERS | ALONE if len(parts) == 1 else IDENTIFIERS
    for word in parts:
        if word in out:
            return f"{identifier}: not {word!r}; write {out[word]}"
    joined = f"_{'_'.join(parts)}_"
    found = (phrase for phrase in PHRASES if f"_{phrase}_" in joined)
    return next((f"{identifier}: not {phrase!r}; write {PHRASES[phrase]}" for phrase in found), "")


def misworded(text: str, table: Mapping[str, str], pattern: str) -> str:
    """Describe the first entry of a table that `text` has at the place of a pattern; "" where there is none."""
    for word, instead in table.items():
        if re.search(pattern.format(word), text):
            return f"{text.splitlines()[0][:80]!r}: not {word!r}; write {instead}"
    return ""


def opening(text: str) -> str:
    """Describe the first word of a docstring if it is out."""
    return misworded(text, OPENINGS, r"^\s*{}\b")


def message(text: str) -> str:
    """Describe the word of a message that is out."""
    return misworded(text, MESSAGES, r"(?i)\b{}\b") if len(text.split()) > 2 else ""


def names_of(tree: ast.AST) -> Iterator[tuple[str, int]]:
    """List the identifiers that a module defines, with lines."""
    for node in ast.walk(tree):
        if isinstance(node, ast.ClassDef | ast.FunctionDef):
            yield node.name, node.lineno
        elif isinstance(node, ast.arg):
            yield node.arg, node.lineno
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id, node.lineno
        elif isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
            yield node.attr, node.lineno


def faults_of_python(source: str) -> Iterator[str]:
    """List what is worded otherwise in a Python module, with lines."""
    tree = ast.parse(source)
    yield from (f"{line} {fault}" for name, line in names_of(tree) if (fault := misnamed(name)))
    docstrings = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef) and (text := ast.get_docstring(node)):
            docstrings.add(id(node.body[0].value))
            if fault := opening(text):
                yield f"{node.body[0].lineno} {fault}"
    for node in ast.walk(tree):
        text = node.value if isinstance(node, ast.Constant) and id(node) not in docstrings else None
        if isinstance(text, str) and (fault := message(text)):
            yield f"{node.lineno} {fault}"


def faults_of_cpp(source: str) -> Iterator[str]:
    """List what is worded otherwise in a C++ file, with lines."""
    commented = False
    for number, line in enumerate(source.splitlines(), 1):
        code, _, comment = line.partition("//")
        clause = re.match(r" (Where|As|That)\b", comment)  # in a comment these may begin a whole sentence
        if not commented and not clause and (fault := opening(comment)):
            yield f"{number} {fault}"
        commented = bool(comment)
        strings = re.findall(r'"((?:[^"\\]|\\.)*)"', code)
        yield from (f"{number} {fault}" for text in strings if (fault := message(text)))
        names = re.findall(r"\b[A-Za-z_]\w*", re.sub(r'"(?:[^"\\]|\\.)*"', "", code))
        yield from (f"{number} {fault}" for name in names if (fault := misnamed(name)))


def faults(path: Path) -> list[str]:
    """List what is worded otherwise in a file, with its place."""
    of = faults_of_python if path.suffix == ".py" else faults_of_cpp
    found = [f"{path.relative_to(ROOT)}:{fault}" for fault in of(path.read_text(encoding="utf-8"))]
    name = misnamed(path.stem)
    return [f"{path.relative_to(ROOT)}: module {name}", *found] if name else found


@pytest.mark.parametrize("package", PACKAGES)
def test_words_that_are_out_are_in_no(package):
    found = [fault for path in PACKAGES[package] for fault in faults(path)]
    assert not found, "\n" + "\n".join(found)


@pytest.mark.parametrize(("source", "count"), [
    ("def put_back(points): pass", 1),
    ("class Room: pass", 1),
    ("class Bedroom: pass", 0),
    ("self.raised_limits = wayTo = 1", 2),
    ("for way in paths: pass", 1),
    ("def f(what, *, way=1): return np.off", 2),
    ("off = off_diagonal = cut_off = 1", 1),
    ('def f():\n    """What an iterate is kept for."""', 1),
    ('def f():\n    """Return what is kept."""\n    x = "goes on with the next one"', 1),
    ('x = {"told": 1}', 0),
    ('raise ValueError(f"{n} hexes are told to move")', 1),
])  # fmt: skip
def test_a_word_that_is_out_is_seen_in_python(source, count):
    assert len(list(faults_of_python(source))) == count


@pytest.mark.parametrize(("source", "count"), [
    ("double put_back(int way);", 2),
    ("// What a node is.\n// What follows.\nint x;", 1),
    ("// Where corners are one node, the first counts.\nint x;", 0),
    ('throw std::invalid_argument("hexes are told to move");', 1),
    ('int x = index("told");  // way', 0),
])  # fmt: skip
def test_a_word_that_is_out_is_seen_in_cpp(source, count):
    assert len(list(faults_of_cpp(source))) == count
