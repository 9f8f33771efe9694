"""Faults of the C++ sources: listed by hand, each built into the kernels of a copy and tried there."""

from __future__ import annotations

import os
import subprocess
import sys
import tomllib
from collections.abc import Collection
from pathlib import Path

from mutation.campaign import Results, row_of, say
from mutation.operators import Mutant
from mutation.project import Copy, Project
from mutation.reach import Reach
from mutation.trial import tried
from mutation.workers import Processes, in_copies

#: The build in which faults are made, if the processor can run it.
_BUILD = "v3"


class NativeMutants:
    """Faults of the C++ sources.

    Parameters
    ----------
    project : Project
    path : Path
        A TOML file of tables `[[mutant]]` with `file`, `before` (a text that the file has once), `after` and `tests`
        (files that are run first). `left_out` names files of tests that compare builds with each other: only one has
        the fault.
    """

    def __init__(self, project: Project, path: Path):
        self._project = project
        content = tomllib.loads(path.read_text(encoding="utf-8"))
        self._left_out = set(content["left_out"])
        self._entries = content["mutant"]

    def try_all(self, reach: Reach, results: Results, only: Collection[str] | None) -> list[str]:
        """Build and try each whose result is not known, and return the ids of all, or of `only` some."""
        mutants = {mutant.id: (mutant, entry) for entry in self._entries if (mutant := self._mutant(entry))}
        ids = [name for name in mutants if not only or name in only]

        def work(name: str, copy: Copy, processes: Processes) -> None:
            mutant, entry = mutants[name]
            tests = self._tests(reach, entry)
            copy.write(mutant.path, mutant.mutated)
            try:
                self._build(copy)
                result = tried(copy, processes, tests, HEXMEND_KERNELS=_BUILD)
            finally:
                copy.write(mutant.path, mutant.source)
            row = row_of(mutant, result, reach.digest(tests))
            results.add(row)
            say(row)

        def known(name: str) -> bool:
            mutant, entry = mutants[name]
            return results.has(mutant, reach.digest(self._tests(reach, entry)))

        unknown = [name for name in ids if not known(name)]
        in_copies(self._project, 1, unknown, work, name="native")  # kernels are built in one folder
        return ids

    def _tests(self, reach: Reach, entry: dict) -> dict[str, float]:
        tests = reach.all_tests(entry["tests"]).items()
        return {name: seconds for name, seconds in tests if name.split("::")[0] not in self._left_out}

    def _mutant(self, entry: dict) -> Mutant:
        source = self._project.read(entry["file"])
        if source.count(entry["before"]) != 1:
            raise SystemExit(
                f"mutants_native.toml: {entry['file']} has {entry['before']!r} {source.count(entry['before'])} times; "
                "expected once: write its present text there"
            )
        line = source[: source.index(entry["before"])].count("\n") + 1
        mutated = source.replace(entry["before"], entry["after"])
        return Mutant(entry["file"], "", "by hand", line, line, False, source, mutated)

    def _build(self, copy: Copy) -> None:
        """Build the kernels of the copy, of which ninja makes anew what has changed."""
        folder = self._project.build / "native-build"
        environment = os.environ | {"PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"}
        nanobind = subprocess.check_output([sys.executable, "-m", "nanobind", "--cmake_dir"], text=True).strip()
        configure = ["cmake", "-S", str(copy.folder / "core/native"), "-B", str(folder), "-G", "Ninja"]
        configure += ["-DHEXMEND_IN_PLACE=ON", f"-DPython_EXECUTABLE={sys.executable}", f"-Dnanobind_DIR={nanobind}"]
        for command in (configure, ["cmake", "--build", str(folder), "--target", f"_{_BUILD}"]):
            done = subprocess.run(command, env=environment, capture_output=True, text=True)
            if done.returncode:
                raise SystemExit(
                    f"the kernels cannot be built with a fault:\n{done.stdout[-3000:]}{done.stderr[-2000:]}"
                )
