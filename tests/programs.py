"""Programs in processes of their own."""

import os
import subprocess
import sys
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any


def run_python(
    *words: object, paths: Iterable[str | Path] = (), variables: Mapping[str, str] | None = None, **options: Any
) -> subprocess.CompletedProcess[str]:
    """Run Python with some words, folders before the others of its path, and additional variables."""
    path = os.pathsep.join(filter(None, [*map(str, paths), os.environ.get("PYTHONPATH", "")]))
    environment = os.environ | {"PYTHONPATH": path} | dict(variables or {})
    return subprocess.run(
        [sys.executable, *map(str, words)], env=environment, capture_output=True, text=True, **options
    )
