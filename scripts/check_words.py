#!/usr/bin/env python3
"""Check the words of core and app: identifiers, first words of docstrings, messages and texts. Part of make lint.

Each list maps a word that is out to what to write in its place. Strings that files or the command line rely on are not
identifiers. FILE... checks these alone.
"""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FOLDERS = "core/hexmend", "core/native", "app/hexmend_app"

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
    "raised": "increased, highest",
    "raising": "highest",
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

#: Words of the window's texts; options of the command and names by which something is found are none.
TEXTS = {"elements?": "hex", "clip(s|ped|ping)?": "cut"}


def misnamed(identifier: str) -> str:
    """Describe the word of an identifier that is out: `raiseLeast` is `raise` and `least`; "" without any."""
    parts = [word.lower() for word in re.findall(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])", identifier)]
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
        match node:
            case ast.ClassDef(name=name) | ast.FunctionDef(name=name) | ast.arg(arg=name):
                yield name, node.lineno
            case ast.Name(id=name, ctx=ast.Store()) | ast.Attribute(attr=name, ctx=ast.Store()):
                yield name, node.lineno


def faults_of_python(source: str, seen: bool) -> Iterator[str]:
    """List what is worded otherwise in a Python module, with lines; `seen` where its strings are the window's texts."""
    tree = ast.parse(source)
    yield from (f"{line} {fault}" for name, line in names_of(tree) if (fault := misnamed(name)))
    docstrings, keys = set(), set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef):
            fault = opening(ast.get_docstring(node) or "")
            if fault:
                yield f"{node.body[0].lineno} {fault}"
        if isinstance(node, ast.Expr):
            docstrings.add(node.value)
        elif isinstance(node, ast.Dict):
            keys.update(node.keys)
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == "get":
            keys.update(node.args)
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and node not in docstrings:
            fault = message(node.value)
            if seen and not fault and node not in keys:
                fault = misworded(re.sub(r"--[a-z-]+", "", node.value), TEXTS, r"(?i)\b{}\b")
            if fault:
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


def faults(path: Path) -> Iterator[str]:
    """List what is worded otherwise in a file, with its place."""
    source = path.read_text(encoding="utf-8")
    seen = "hexmend_app" in path.parts
    found = faults_of_python(source, seen) if path.suffix == ".py" else faults_of_cpp(source)
    if name := misnamed(path.stem):
        yield f"{path}: module {name}"
    yield from (f"{path}:{fault}" for fault in found)


if __name__ == "__main__":
    paths = [Path(name) for name in sys.argv[1:]] or [path for folder in FOLDERS for path in (ROOT / folder).rglob("*")]
    found = [fault for path in sorted(paths) if path.suffix in (".py", ".cpp", ".hpp") for fault in faults(path)]
    sys.exit("\n".join(found) or None)
