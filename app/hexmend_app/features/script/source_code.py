"""Python source of values."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from hexmend.doctor import repair
from hexmend.mesh.rules import MotionRules
from hexmend.padding import pad
from hexmend.parameters import Parametrised, declared
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Recipe, Stage
from hexmend.smoothers import Smoother
from hexmend.terminal_text import printable

#: Source of the mesh in the result of functions that return more than a mesh; it slides on its own boundary.
_MESH_OF = {repair: "[0].keeping_surface()", pad: ".mesh.keeping_surface()"}

#: Maximum line length in characters.
WIDTH = 110


def source_of(value: Parametrised | Recipe | Stage) -> str:
    """Return the source of a method, limits, a stage or a recipe; defaults are omitted.

    >>> source_of(StoppingCriteria(max_iterations=5)), source_of(StoppingCriteria())
    ('hx.StoppingCriteria(max_iterations=5)', 'hx.StoppingCriteria()')
    """
    if isinstance(value, Recipe):
        stages = ",\n    ".join(map(source_of, value.stages))
        default = Recipe.of(*value.stages).title
        title = f"    title={value.title!r},\n" if value.title != default else ""
        rules = f"    rules={rules_source(value.rules)},\n" if value.rules else ""
        return f"hx.Recipe.of(\n    {stages},\n{title}{rules})"
    if isinstance(value, Stage):
        return f"hx.Stage({arguments_source(value.smoother, value.stop)})"
    values = ", ".join(
        f"{parameter.name}={_to_python(getattr(value, parameter.name))!r}"
        for parameter in declared(value)
        if getattr(value, parameter.name) != parameter.default
    )
    return f"hx.{type(value).__name__}({values})"


def rules_source(rules: MotionRules) -> str:
    """Return the source of rules of motion.

    >>> rules_source(MotionRules(interfaces="slide", fix=("inlet",)))
    "hx.MotionRules(interfaces='slide', fix=['inlet'])"
    """
    return f"hx.MotionRules({settings_source(rules)})"


def settings_source(rules: MotionRules) -> str:
    """Return the source of rules of motion as named arguments; "" without rules."""
    return ", ".join(f"{name}={value!r}" for name, value in rules.values().items())


def arguments_source(work: Smoother | Recipe, stop: StoppingCriteria | None) -> str:
    """Return the source of a method and its limits as arguments; default limits are omitted.

    >>> from hexmend.smoothers import METHODS
    >>> arguments_source(METHODS["laplacian"](), StoppingCriteria())
    'hx.Laplacian()'
    """
    return source_of(work) if stop is None or stop == StoppingCriteria() else f"{source_of(work)}, {source_of(stop)}"


def mesh_call(name: str, change: Callable[..., Any], mesh: str, values: Sequence[Any]) -> str:
    """Return the source of a call of a core function that returns a mesh, which has a name in the script.

    >>> from hexmend.mesh.fixing import fix
    >>> mesh_call("hx.fix", fix, "mesh_1", (3,))
    'hx.fix(mesh_1, 3)'
    """
    literal = str | bool | tuple | float | None
    sources = (repr(value) if isinstance(value, literal) else integers_source(value) for value in values)
    return f"{name}({', '.join([mesh, *sources])})" + _MESH_OF.get(change, "")


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


def integers_source(values: int | Sequence[int] | np.ndarray) -> str:
    """Return the source of an integer, or of integers as a sorted list, with ranges if that is shorter.

    >>> integers_source(3), integers_source([5, 3]), integers_source([*range(100), 200])
    ('3', '[3, 5]', 'np.r_[0:100, 200]')
    """
    if np.ndim(values) == 0:
        return str(int(values))
    unique = np.unique(np.asarray(values, dtype=np.int64))
    ranges = np.split(unique, np.flatnonzero(np.diff(unique) != 1) + 1) if unique.size else []
    if unique.size <= 2 * len(ranges) + 8:
        text = f"[{', '.join(map(str, unique.tolist()))}]"
    else:
        text = ", ".join(str(run[0]) if run.size == 1 else f"{run[0]}:{run[-1] + 1}" for run in ranges)
        text = f"np.r_[{text}]"
    return "\n    ".join(textwrap.wrap(text, WIDTH)) or "[]"


def _to_python(value: object) -> object:
    return value.item() if isinstance(value, np.generic) else value
