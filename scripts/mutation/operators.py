"""The small faults that a Python source file can be given, each as a replacement of a piece of its text."""

from __future__ import annotations

import ast
import difflib
import hashlib
from collections.abc import Iterator
from dataclasses import dataclass

from mutation.rules import SILENT_CALLS, SILENT_FUNCTIONS, replacements


@dataclass(frozen=True)
class Mutant:
    """One fault in one source file.

    Parameters
    ----------
    path : str
        Of the file, from the project's root.
    function : str
        Qualified name of the function or class that holds it; empty at the module's level.
    operator : str
        The kind of the fault.
    first, last : int
        Lines that Python runs when it comes to the place, from 1.
    at_import : bool
        True where they run while the module is imported, not within a function.
    source, mutated : str
        The whole file before and after.
    """

    path: str
    function: str
    operator: str
    first: int
    last: int
    at_import: bool
    source: str
    mutated: str

    @property
    def diff(self) -> str:
        """The change as a unified diff with two lines of context."""
        before, after = self.source.splitlines(), self.mutated.splitlines()
        return "\n".join(difflib.unified_diff(before, after, self.path, self.path, n=2, lineterm=""))

    @property
    def texts(self) -> tuple[str, str]:
        """The changed lines before and after, without the spaces at their ends."""
        before, after = self.source.splitlines(), self.mutated.splitlines()
        while before and after and before[-1] == after[-1]:
            before.pop(), after.pop()
        same = next((k for k, pair in enumerate(zip(before, after, strict=False)) if pair[0] != pair[1]), 0)
        return tuple("\n".join(line.strip() for line in lines[same:]) for lines in (before, after))

    @property
    def id(self) -> str:
        """Eight letters and digits that stay while the lines and those before them in the function do."""
        return _hashed(self.path, self.function, *self.texts, _nth(self))


def mutants(path: str, source: str) -> list[Mutant]:
    """Return every fault that `source` can be given, in the order of the text, each different from the others."""
    found = {mutant.mutated: mutant for mutant in _Finder(path, source).mutants()}
    return list(found.values())


def statements(source: str) -> int:
    """Count the lines on which a statement begins, docstrings apart."""
    nodes = (node for node in ast.walk(ast.parse(source)) if isinstance(node, ast.stmt) and not _is_text(node))
    return len({node.lineno for node in nodes})


class _Finder:
    """Walks a syntax tree and yields mutants; skips texts, messages, annotations and declarations."""

    def __init__(self, path: str, source: str):
        self.path, self.source = path, source
        self.bytes, self.tree = source.encode(), ast.parse(source)
        self.dump = ast.dump(self.tree)
        self.starts = [0]
        for line in self.bytes.splitlines(keepends=True):
            self.starts.append(self.starts[-1] + len(line))

    def mutants(self) -> Iterator[Mutant]:
        return self._within(self.tree, (), None, at_import=True)

    def _within(
        self, node: ast.AST, names: tuple[str, ...], simple: ast.stmt | None, at_import: bool
    ) -> Iterator[Mutant]:
        """Mutants of a node; `simple` is the statement around it that has no body."""
        if _is_silent(node):
            return
        if isinstance(node, ast.stmt):
            simple = None if hasattr(node, "body") else node
        for operator, part, text in replacements(node):
            mutated = self._replaced(part, text)
            if mutated is not None:
                lines = (simple or part).lineno, (simple or part).end_lineno
                yield Mutant(self.path, ".".join(names), operator, *lines, at_import, self.source, mutated)
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            names = (*names, node.name)
        for child in _children(node):
            inside = isinstance(node, ast.FunctionDef | ast.Lambda) and child is not node.args
            yield from self._within(child, names, simple, at_import and not inside)

    def _replaced(self, node: ast.AST, text: str) -> str | None:
        """The file with another text in the place of a node; None where that is no Python or the same Python."""
        start = self.starts[node.lineno - 1] + node.col_offset
        end = self.starts[node.end_lineno - 1] + node.end_col_offset
        bare, bracketed = (
            (self.bytes[:start] + one.encode() + self.bytes[end:]).decode() for one in (text, f"({text})")
        )
        meant = _dump(bracketed if isinstance(node, ast.expr) else bare)
        if meant in ("", self.dump):
            return None
        return bare if _dump(bare) == meant else bracketed


def _dump(source: str) -> str:
    """A text's syntax tree; "" where it has none."""
    try:
        return ast.dump(ast.parse(source))
    except SyntaxError:
        return ""


def _is_silent(node: ast.AST) -> bool:
    match node:
        case ast.Raise() | ast.Assert() | ast.JoinedStr() | ast.Import() | ast.ImportFrom():
            return True
        case ast.FunctionDef(name=name):
            return name in SILENT_FUNCTIONS
        case ast.Call(func=ast.Name(id=name) | ast.Attribute(attr=name)):
            return name in SILENT_CALLS
        case ast.If(test=ast.Name(id=name) | ast.Attribute(attr=name)):
            return name == "TYPE_CHECKING"
        case ast.Assign(targets=[ast.Name(id=name)]):
            return name.startswith("__")
    return _is_text(node)


def _is_text(node: ast.AST) -> bool:
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)


def _children(node: ast.AST) -> Iterator[ast.AST]:
    """Parts of a node in the order of the text, without decorators and annotations."""
    left_out = {"decorator_list", "annotation", "returns", "type_params"}
    for name, value in ast.iter_fields(node):
        if name not in left_out:
            yield from (one for one in (value if isinstance(value, list) else [value]) if isinstance(one, ast.AST))


def _hashed(*words: str) -> str:
    return hashlib.sha256("\0".join(words).encode()).hexdigest()[:8]


def _nth(mutant: Mutant) -> str:
    """Number of the line that the mutant changes among equal lines of the file."""
    before = mutant.texts[0].splitlines()[0] if mutant.texts[0] else ""
    lines = [line.strip() for line in mutant.source.splitlines()[: mutant.last]]
    return str(lines.count(before))
