"""Python source of values."""

from __future__ import annotations

import sys
import textwrap
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

import hexmend
from hexmend.mesh.rules import MotionRules
from hexmend.parameters import Parametrised, declared
from hexmend.run.recipe import Recipe, Stage
from hexmend.terminal_text import printable

#: Maximum line length in characters.
WIDTH = 110


def value_source(value: Parametrised | Recipe | Stage) -> str:
    """Return the source of a method, limits, a stage or a recipe; defaults are omitted.

    >>> value_source(hexmend.StoppingCriteria(max_iterations=5)), value_source(hexmend.StoppingCriteria())
    ('hx.StoppingCriteria(max_iterations=5)', 'hx.StoppingCriteria()')
    """
    if isinstance(value, Recipe):
        arguments = [*map(value_source, value.stages), f"title={value.title!r}"]
        arguments += [f"rules=hx.MotionRules({keywords_source(value.rules)})"] if value.rules else []
        return f"hx.Recipe.of({', '.join(arguments)})"
    if isinstance(value, Stage):
        return f"hx.Stage({value_source(value.smoother)}, {value_source(value.stop)})"
    values = ((parameter, getattr(value, parameter.name)) for parameter in declared(value))
    keywords = (f"{one.name}={_to_python(it)!r}" for one, it in values if it != one.default)
    return f"hx.{type(value).__name__}({', '.join(keywords)})"


def keywords_source(rules: MotionRules) -> str:
    """Return the source of rules of motion as named arguments.

    >>> keywords_source(MotionRules(interfaces="slide", fix=("inlet",)))
    "interfaces='slide', fix=['inlet']"
    """
    return ", ".join(f"{name}={value!r}" for name, value in rules.values().items())


def literal_source(value: Any) -> str:
    """Return the source of a string, number, tuple or None, or of an array of integers."""
    return integers_source(value) if getattr(value, "ndim", 0) else repr(_to_python(value))


def integers_source(values: Sequence[int] | np.ndarray) -> str:
    """Return the source of integers as a sorted list, with ranges if that is shorter.

    >>> integers_source([5, 3]), integers_source([*range(100), 200])
    ('[3, 5]', 'np.r_[0:100, 200]')
    """
    unique = np.unique(np.asarray(values, dtype=np.int64))
    ranges = np.split(unique, np.flatnonzero(np.diff(unique) != 1) + 1) if unique.size else []
    if unique.size <= 2 * len(ranges) + 8:
        text = f"[{', '.join(map(str, unique.tolist()))}]"
    else:
        text = ", ".join(str(run[0]) if run.size == 1 else f"{run[0]}:{run[-1] + 1}" for run in ranges)
        text = f"np.r_[{text}]"
    return "\n    ".join(textwrap.wrap(text, WIDTH)) or "[]"


def import_of(function: Callable[..., Any]) -> tuple[str, str]:
    """Return the name of a function in a script, and the import that it needs, from the shortest path.

    >>> from hexmend.boundary.marking import with_curve
    >>> import_of(hexmend.fix), import_of(with_curve)
    (('hx.fix', 'import hexmend as hx'), ('with_curve', 'from hexmend.boundary.marking import with_curve'))
    """
    name, parts = function.__name__, function.__module__.split(".")
    if getattr(hexmend, name, None) is function:
        return f"hx.{name}", "import hexmend as hx"
    modules = (".".join(parts[:count]) for count in range(2, len(parts) + 1))
    module = next(one for one in modules if getattr(sys.modules[one], name, None) is function)
    return name, f"from {module} import {name}"


def comment_text(text: str) -> str:
    r"""Return `text` made printable and joined into one line, for a comment.

    >>> comment_text("a\nname\x0c\x00")
    'a name ?'
    """
    return printable(" ".join(text.split()))


def multiline_source(text: str) -> str:
    """Return the source of a string of several lines, triple-quoted if possible.

    >>> print(multiline_source("a = 1"))
    \"\"\"\\
    a = 1\"\"\"
    """
    quotable = '"""' not in text and "\\" not in text and not text.endswith('"')
    return f'"""\\\n{text}"""' if quotable else repr(text)


def _to_python(value: object) -> object:
    return value.item() if isinstance(value, np.generic) else value
