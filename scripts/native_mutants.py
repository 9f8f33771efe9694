"""Builds faults into the kernels of a copy, one at a time, and tells which of them the tests find.

Use: python scripts/native_mutants.py

native_mutants.toml lists the faults with the tests that should find them. The exit status is 1 where less than 90 % are
found.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

#: Share of the faults that tests must find.
WANTED = 0.9
#: Seconds after which the tests of a fault are ended.
SECONDS = 600
#: The build of the kernels in which faults are made.
BUILD = "v3"

ROOT = Path(__file__).resolve().parents[1]
COPY, KERNELS = ROOT / "build/native-mutants/tree", ROOT / "build/native-mutants/kernels"


def build() -> None:
    """Build the kernels of the copy, of which ninja makes anew what has changed."""
    nanobind = subprocess.check_output([sys.executable, "-m", "nanobind", "--cmake_dir"], text=True).strip()
    options = ["-DHEXMEND_IN_PLACE=ON", f"-DPython_EXECUTABLE={sys.executable}", f"-Dnanobind_DIR={nanobind}"]
    for command in (
        ["cmake", "-S", str(COPY / "core/native"), "-B", str(KERNELS), "-G", "Ninja", *options],
        ["cmake", "--build", str(KERNELS), "--target", f"_{BUILD}"],
    ):
        subprocess.run([str(ROOT / "scripts/logged"), f"{KERNELS}.log", *command], check=True)


def pass_all(tests: list[str], output: int | None = subprocess.DEVNULL) -> bool:
    """Run tests in the copy, and return True if all pass in time; None shows their output."""
    command = [sys.executable, "-m", "pytest", "--exitfirst", "-p", "no:cacheprovider", *tests]
    own = {"PYTHONPATH": f"{COPY / 'core'}{os.pathsep}{COPY / 'app'}", "HEXMEND_KERNELS": BUILD}
    try:
        done = subprocess.run(command, cwd=COPY, env=os.environ | own, stdout=output, stderr=output, timeout=SECONDS)
    except subprocess.TimeoutExpired:
        return False
    return done.returncode == 0


def main() -> int:
    """Try every fault, print what became of it, and return the exit status."""
    os.environ["PATH"] = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    mutants = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))["mutant"]
    shutil.rmtree(COPY.parent, ignore_errors=True)
    for folder in ("core", "app", "tests", "benchmarks", "docs", "resources"):
        shutil.copytree(ROOT / folder, COPY / folder)
    shutil.copy(ROOT / "pyproject.toml", COPY)
    build()
    if not pass_all(sorted({test for mutant in mutants for test in mutant["tests"]}), output=None):
        sys.exit("tests of native_mutants.toml fail without a fault")

    found = 0
    for mutant in mutants:
        source = COPY / mutant["file"]
        text = source.read_text(encoding="utf-8")
        if text.count(mutant["before"]) != 1:
            sys.exit(f"native_mutants.toml: {mutant['file']} has {mutant['before']!r} not once: write its present text")
        source.write_text(text.replace(mutant["before"], mutant["after"]), encoding="utf-8")
        build()
        one = not pass_all(mutant["tests"])
        source.write_text(text, encoding="utf-8")
        found += one
        print(f"{'found' if one else 'survived':10}{mutant['file']}: {mutant['after']}", flush=True)
    print(f"{found / len(mutants):.0%} of {len(mutants)} faults of the kernels are found; {WANTED:.0%} are wanted")
    return int(found < WANTED * len(mutants))


if __name__ == "__main__":
    sys.exit(main())
