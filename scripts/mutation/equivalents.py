"""Faults that change no result, each with the reason: they are listed by hand."""

from __future__ import annotations

import tomllib
from pathlib import Path

from mutation.operators import Mutant


class Equivalents:
    """Reasons why faults change no result.

    Parameters
    ----------
    path : Path
        A TOML file of tables `[[mutant]]` with `file`, `before` and `after` (the changed lines, without the spaces at
        their ends) and `reason`.
    """

    def __init__(self, path: Path):
        tables = tomllib.loads(path.read_text(encoding="utf-8"))["mutant"] if path.exists() else []
        self._reasons = {(one["file"], one["before"].strip(), one["after"].strip()): one["reason"] for one in tables}

    def reason(self, mutant: Mutant) -> str | None:
        """Why the mutant does the same as the original; None where it is not listed."""
        return self._reasons.get((mutant.path, *mutant.texts))
