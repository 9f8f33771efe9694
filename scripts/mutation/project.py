"""The project under test, and copies of it in which faults are put."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

_LEFT_OUT = shutil.ignore_patterns(
    ".git", ".venv", "build", "dist", "__pycache__", ".hypothesis", ".*_cache", "*.png", "*.gif", "*.egg-info"
)
_SCRIPTS = Path(__file__).resolve().parents[1]

#: pytest's configuration in a copy: as the project's own, without the screen that tests of windows need.
_CONFIGURATION = """[pytest]
addopts = -q --tb=short --import-mode=importlib --doctest-modules
    -p no:xvfb -p no:pytest-qt -p no:xdist -p no:cacheprovider -p mutation.plugin
filterwarnings = error
markers = slow
"""


@dataclass(frozen=True)
class Project:
    """Where sources and tests are.

    Parameters
    ----------
    root : Path
    tests : tuple of str
        Folders of tests and of sources with doctests, from `root`.
    imports : tuple of str
        Folders from which packages are imported, from `root`.
    build : Path
        Where copies, caches and results are kept.
    """

    root: Path
    tests: tuple[str, ...]
    imports: tuple[str, ...]
    build: Path

    def read(self, path: str) -> str:
        return (self.root / path).read_text(encoding="utf-8")

    def sessions(self, tests: Iterable[str]) -> list[list[str]]:
        """Names of tests by the folder of `tests` that holds them, each in their order.

        Each group wants a process of its own: where pytest has collected the examples of a module, the package that
        holds it may no longer give a function of the same name.
        """
        groups: dict[str, list[str]] = {}
        for name in tests:
            groups.setdefault(next(folder for folder in self.tests if name.startswith(f"{folder}/")), []).append(name)
        return list(groups.values())

    def copy(self, name: str) -> Copy:
        """Make a fresh copy of the project in `build`, without pictures and what was built but the modules."""
        folder = self.build / name
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(self.root, folder, ignore=_LEFT_OUT, symlinks=True)
        (folder / "mutation.ini").write_text(_CONFIGURATION, encoding="utf-8")
        return Copy(self, folder)


class Copy:
    """A copy of the project; one process at a time uses it."""

    def __init__(self, project: Project, folder: Path):
        self.project, self.folder, self._time = project, folder, 0

    def write(self, path: str, text: str) -> None:
        """Write a file; it is newer than before, so that no compiled form of the old one is taken."""
        target = self.folder / path
        target.write_text(text, encoding="utf-8")
        self._time = max(self._time, int(target.stat().st_mtime)) + 2
        os.utime(target, (self._time, self._time))

    def pytest(self, *arguments: str) -> list[str]:
        """The command that runs pytest in the copy."""
        temporary = f"--basetemp={self.folder}-temporary"
        return [sys.executable, "-m", "pytest", "-c", "mutation.ini", "--rootdir=.", temporary, *arguments]

    def environment(self, **more: str) -> dict[str, str]:
        """Variables for `pytest`: real meshes are found."""
        folders = [*(self.folder / name for name in self.project.imports), _SCRIPTS]
        meshes = os.environ.get("HEXMEND_MESHES") or str(self.project.root.parent / "shared" / "meshes")
        own = {"PYTHONPATH": os.pathsep.join(map(str, folders)), "HEXMEND_MESHES": meshes}
        return {key: value for key, value in os.environ.items() if key != "PYTHONDONTWRITEBYTECODE"} | own | more
