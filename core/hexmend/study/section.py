"""What a part of the benchmark is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Section:
    """A part of the benchmark.

    Parameters
    ----------
    name, title : str
    measure : callable
        Returns figures that JSON can hold.
    lines : callable
        The figures as lines to read.
    """

    name: str
    title: str
    measure: Callable[[], dict[str, Any]]
    lines: Callable[[dict[str, Any]], list[str]]
