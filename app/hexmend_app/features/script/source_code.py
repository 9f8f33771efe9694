"""Values as the Python source that makes them."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from hexmend.doctor import repair
from hexmend.parameters import Parametrised, declared
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Recipe, Stage
from hexmend.smoothers import Smoother
from hexmend.terminal_text import printable

#: Letters of a line.
WIDTH = 110


def made(value: Parametrised | Recipe | Stage) -> str:
    """Return the source of a method, limits, a stage or a recipe; defaults are omitted.

    >>> made(StoppingCriteria(max_iterations=5)), made(StoppingCriteria())
    ('hx.StoppingCriteria(max_iterations=5)', 'hx.StoppingCriteria()')
    """
    if isinstance(value, Recipe):
        stages = ",\n    ".join(map(made, value.stages))
        own = Recipe.of(*value.stages).title
        return f"hx.Recipe.of(\n    {stages},\n{f'    title={value.title!r},{chr(10)}' if value.title != own else ''})"
    if isinstance(value, Stage):
        return f"hx.Stage({with_limits(value.smoother, value.stop)})"
    values = ", ".join(
        f"{one.name}={_simple(getattr(value, one.name))!r}"
        for one in declared(value)
        if getattr(value, one.name) != one.default
    )
    return f"hx.{type(value).__name__}({values})"


def with_limits(work: Smoother | Recipe, stop: StoppingCriteria | None) -> str:
    """Return the arguments for the method and its limits; default limits are omitted.

    >>> from hexmend.smoothers import METHODS
    >>> with_limits(METHODS["laplacian"](), StoppingCriteria())
    'hx.Laplacian()'
    """
    return made(work) if stop is None or stop == StoppingCriteria() else f"{made(work)}, {made(stop)}"


def called(mesh: str, change: Callable[..., Any], values: Sequence[Any]) -> str:
    """Return the source of a call of a core function that returns a mesh.

    >>> from hexmend.mesh.fixing import with_pinned
    >>> called("mesh_1", with_pinned, (3, False))
    'with_pinned(mesh_1, 3, False)'
    """
    words = ", ".join([mesh, *(repr(one) if isinstance(one, str | bool | tuple) else numbers(one) for one in values)])
    return f"{change.__name__}({words})" + "[0].keeping_surface()" * (change is repair)


def comment_of(text: str) -> str:
    r"""Return text that is safe within one line of a comment.

    >>> comment_of("a\nname\x0c\x00")
    'a name ?'
    """
    return printable(" ".join(text.split()))


def lines_of(text: str) -> str:
    """Return source of a string with several lines, readable where Python permits.

    >>> print(lines_of("a = 1"))
    \"\"\"\\
    a = 1\"\"\"
    """
    simple = '"""' not in text and "\\" not in text and not text.endswith('"')
    return f'"""\\\n{text}"""' if simple else repr(text)


def numbers(values: int | Sequence[int] | np.ndarray) -> str:
    """Return source of one integer or a list of integers, with ranges where shorter.

    >>> numbers(3), numbers([5, 3]), numbers([*range(100), 200])
    ('3', '[3, 5]', 'np.r_[0:100, 200]')
    """
    if np.ndim(values) == 0:
        return str(int(values))
    order = np.unique(np.asarray(values, dtype=np.int64))
    runs = np.split(order, np.flatnonzero(np.diff(order) != 1) + 1) if order.size else []
    if order.size <= 2 * len(runs) + 8:
        text = f"[{', '.join(map(str, order.tolist()))}]"
    else:
        text = ", ".join(str(run[0]) if run.size == 1 else f"{run[0]}:{run[-1] + 1}" for run in runs)
        text = f"np.r_[{text}]"
    return "\n    ".join(textwrap.wrap(text, WIDTH)) or "[]"


def _simple(value: object) -> object:
    return value.item() if isinstance(value, np.generic) else value
