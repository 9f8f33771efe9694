"""Puts small faults (mutants) into a copy of the core, by mutmut, and counts those that its quick tests find.

Use: python scripts/mutants.py [--count N] [--seed S]

A sample of the mutants is tried. For each of them, the tests run that call the function with the fault, the quickest
first, until one fails or they have taken 30 seconds. `[tool.mutmut]` in pyproject.toml names the sources and the tests.

The exit status is 1 where less than 90 % are found. A mutant that survives asks for a test of what it changes, or for
simpler code where it changes nothing; in build/mutants, `mutmut run NAME` tries it again. Where mutmut cannot collect
its statistics, a test fails without a fault: `python -m pytest tests/core` in build/mutants/mutants shows which.
"""

from __future__ import annotations

import argparse
import os
import random
import resource
import shutil
import sys
from collections import Counter
from contextlib import redirect_stdout
from pathlib import Path

from mutmut import __main__ as mutmut
from mutmut.mutation import mutators
from mutmut.state import state
from mutmut.utils.format_utils import mangled_name_from_mutant_name

#: Share of the mutants that tests must find.
WANTED = 0.9
#: Seconds of tests for each mutant, as they take without a fault; with it, they may take so many times as long.
SECONDS, TIMES = 30.0, 10
#: Memory limit of a process in bytes: a fault may allocate without limit.
MEMORY = 12 << 30

ROOT = Path(__file__).resolve().parents[1]
WORK = ROOT / "build" / "mutants"


def sample(count: int, seed: int) -> dict[str, Path]:
    """Write the sources with all mutants, and return the names of some with their files.

    The same seed chooses the same mutants of functions that have not changed.
    """
    # Texts are messages, mostly: a fault in them changes no result.
    mutators.mutation_operators[:] = [one for one in mutators.mutation_operators if one[1] != mutators.operator_string]
    with redirect_stdout(None):
        mutmut.copy_src_dir()
        mutmut.copy_also_copy_files()
        mutmut.setup_source_paths()
        mutmut.create_mutants(os.cpu_count() or 1)
    mutants, _ = mutmut.collect_source_file_mutation_data(mutant_names=[])
    files = {name: file.path for file, name, _ in mutants}
    drawn = sorted(files, key=lambda name: random.Random(f"{seed} {name}").random())
    return {name: files[name] for name in drawn[:count]}


def quickest_tests(mutant: str) -> list[str]:
    """Tests that call the function of a mutant, the quickest first, as many as the limit allows."""
    seconds = state().duration_by_test
    tests, left = [], SECONDS
    for test in sorted(state().tests_by_mangled_function_name[mangled_name_from_mutant_name(mutant)], key=seconds.get):
        left -= seconds[test]
        if tests and left < 0:
            break
        tests.append(test)
    return tests


def try_all(mutants: dict[str, Path]) -> dict[str, str]:
    """Run the tests of each mutant, and return what became of it."""
    runner = mutmut.get_mutant_runner(os.cpu_count() or 1)
    mutmut.collect_or_load_stats(runner)
    mutmut.set_mutant_under_test("")
    outcomes: dict[str, str] = {}

    def wait() -> None:
        result = runner.wait_for_result()
        outcomes[result.mutant_name] = mutmut.status_by_exit_code[result.exit_code]
        print(f"{len(outcomes):4} {outcomes[result.mutant_name]:10} {result.mutant_name}", flush=True)

    runner.startup()
    for mutant in mutants:
        while not runner.has_capacity():
            wait()
        tests = quickest_tests(mutant)
        usual = sum(state().duration_by_test[test] for test in tests)
        runner.submit(mutant, tests, int(TIMES * (SECONDS + usual)), usual)
    runner.signal_work_complete()
    while runner.pending_count():
        wait()
    runner.shutdown()
    return outcomes


def main() -> int:
    """Try a sample, print the survivors' diffs and the counts of each folder, and return the exit status."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=100, help="how many mutants (100)")
    parser.add_argument("--seed", type=int, default=7, help="of the choice (7)")
    asked = parser.parse_args()

    shutil.rmtree(WORK, ignore_errors=True)
    WORK.mkdir(parents=True)
    for source in ("core/hexmend", "tests", "benchmarks", "docs", "resources", "scripts", "pyproject.toml"):
        (WORK / Path(source).name).symlink_to(ROOT / source)
    os.chdir(WORK)
    resource.setrlimit(resource.RLIMIT_DATA, (MEMORY, MEMORY))

    mutants = sample(asked.count, asked.seed)
    outcomes = try_all(mutants)
    survivors = [name for name in mutants if outcomes[name] in ("survived", "no tests")]
    for name in survivors:
        print(f"\n{name}: {outcomes[name]}\n{mutmut.get_diff_for_mutant(name, path=mutants[name])}")
    tried = Counter(path.parent.as_posix() for path in mutants.values())
    survived = Counter(mutants[name].parent.as_posix() for name in survivors)
    print(f"\n{'folder':40}{'mutants':>10}{'found':>10}")
    for folder in sorted(tried):
        print(f"{folder:40}{tried[folder]:10}{tried[folder] - survived[folder]:10}")
    share = 1 - len(survivors) / len(mutants)
    print(f"{share:.0%} of {len(mutants)} mutants are found; {WANTED:.0%} are wanted")
    return int(share < WANTED)


if __name__ == "__main__":
    sys.exit(main())
