"""`make mutants`, on a package of one function: a fault that its test finds, and one that it does not."""

import json
import signal
import sys
import tomllib
from pathlib import Path

import pytest

SCRIPTS = Path(__file__).resolve().parents[1] / "scripts"

SOURCE = '''"""A toy."""


def clipped(x: float, low: float) -> float:
    """The number, or `low` if it is less."""
    if x < low:
        return low
    return x
'''
TEST = """from toy.numbers import clipped


def test_a_number_below_is_clipped():
    assert (clipped(1, 2), clipped(3, 2)) == (2, 3)
"""


@pytest.fixture(scope="module")
def scripts():
    """The script and its parts, imported from their folder."""
    sys.path.insert(0, str(SCRIPTS))
    try:
        import mutants
        from mutation import operators, project

        yield mutants, operators, project
    finally:
        sys.path.remove(str(SCRIPTS))


@pytest.fixture
def toy(scripts, tmp_path):
    """A project of one package and one file of tests."""
    root = tmp_path / "project"
    files = {"core/toy/__init__.py": "", "core/toy/numbers.py": SOURCE, "tests/test_numbers.py": TEST}
    for path, text in files.items():
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_text(text)
    return scripts[2].Project(root=root, tests=("tests",), imports=("core",), build=tmp_path / "build")


@pytest.mark.slow
def test_a_fault_that_a_test_finds_and_one_that_survives_are_told_apart_and_kept(scripts, toy, capsys):
    script, operators, _ = scripts
    path = "core/toy/numbers.py"
    by_text = {mutant.texts[1]: mutant.id for mutant in operators.mutants(path, SOURCE)}
    found, survived = by_text["if x >= low:"], by_text["if x <= low:"]
    arguments = ["--again", found, "--again", survived, "--jobs", "1"]
    rows = {row.id: row for row in script.main(arguments, toy, [path])}
    assert rows[found].outcome == "found"
    assert rows[found].by == "tests/test_numbers.py::test_a_number_below_is_clipped"
    assert rows[survived].outcome == "survived"
    said = capsys.readouterr().out
    assert "-    if x < low:\n+    if x <= low:" in said
    assert "50.0 % found" in said
    assert (toy.root / path).read_text() == SOURCE
    kept = json.loads((toy.build / "results.json").read_text())
    assert {row["id"]: row["outcome"] for row in kept} == {found: "found", survived: "survived"}


@pytest.mark.slow
def test_a_fault_is_tried_again_when_the_test_that_found_it_has_changed(scripts, toy):
    script, operators, _ = scripts
    path = "core/toy/numbers.py"
    by_text = {mutant.texts[1]: mutant.id for mutant in operators.mutants(path, SOURCE)}
    arguments = ["--count", "3", "--jobs", "1", "--seed", "1"]
    before = {row.id: row for row in script.main(arguments, toy, [path])}
    assert before[by_text["if x >= low:"]].outcome == "found"
    (toy.root / "tests/test_numbers.py").write_text(TEST.replace("== (2, 3)", "is not None"))
    after = script.main(arguments, toy, [path])
    assert {row.outcome for row in after} == {"survived"}


@pytest.mark.slow
def test_a_fault_that_no_module_can_be_imported_with_is_found(scripts, toy):
    script, operators, _ = scripts
    path = "core/toy/numbers.py"
    source = SOURCE + "\n\nLOW = (1, 2)[1]\n"
    (toy.root / path).write_text(source)
    by_text = {mutant.texts[1]: mutant.id for mutant in operators.mutants(path, source)}
    arguments = ["--again", by_text["LOW = (1, 2)[2]"], "--jobs", "1"]
    (row,) = script.main(arguments, toy, [path])
    assert (row.outcome, row.by) == ("found", "tests/test_numbers.py")
    (toy.root / "tests/conftest.py").write_text("import toy.numbers\n")
    (row,) = script.main(arguments, toy, [path])
    assert row.outcome == "found"
    assert row.by.endswith("conftest.py")


@pytest.mark.parametrize(
    ("code", "report", "outcome"),
    [
        (0, {}, "survived"),
        (1, {"tests/a.py::x": {"outcome": "failed"}}, "found"),
        (2, {"tests/a.py": {"outcome": "failed"}}, "found"),
        (-signal.SIGSEGV, {}, "found"),
        (-signal.SIGPROF, {}, "timed out"),
        (-signal.SIGKILL, {}, "error"),
        (2, {}, "error"),
        (3, {}, "error"),
        (4, {}, "error"),
    ],
)
def test_a_fault_is_found_only_by_a_test_that_fails_or_a_crash(scripts, tmp_path, code, report, outcome):
    class Project:
        sessions = staticmethod(lambda tests: [list(tests)])

    class Copy:
        project, folder = Project, tmp_path / "copy"

    class Processes:
        pytest = staticmethod(lambda *values, **variables: (code, report))

    assert sys.modules["mutation.trial"].tried(Copy, Processes, {"tests/a.py::x": 1.0}).outcome == outcome


@pytest.mark.parametrize(
    ("outcomes", "status", "said"),
    [
        ({"found": 8, "timed out": 1, "survived": 1, "equivalent": 5}, 0, ""),
        ({"found": 8, "survived": 1}, 1, "Less than 90% are found"),
        ({"found": 9, "error": 1}, 1, "1 could not be tried"),
    ],
)
def test_the_exit_status_says_whether_enough_was_found(scripts, capsys, outcomes, status, said):
    campaign, table = sys.modules["mutation.campaign"], sys.modules["mutation.table"]
    rows = [
        campaign.Row(f"{outcome} {k}", "core/a.py", "f", "sign", 1, f"-{outcome}", outcome, "why", 1.0, "")
        for outcome, count in outcomes.items()
        for k in range(count)
    ]
    assert scripts[0].status(rows) == status
    assert said in capsys.readouterr().out
    assert ("-error" in table.as_text(rows)) == ("error" in outcomes)


def test_texts_messages_and_annotations_are_not_changed(scripts):
    source = '''"""Adds 1."""
from __future__ import annotations

def f(x: int = 3) -> tuple[int, 1]:
    """Adds 1 + 0."""
    if x:
        raise ValueError(f"{x + 1} is not 0")
    return None
'''
    changed = [mutant.texts for mutant in scripts[1].mutants("f.py", source)]
    assert changed == [("if x:", "if not x:")]


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("y = a < b", "y = a <= b"),
        ("y = a + b", "y = a - b"),
        ("y = np.minimum(a, b)", "y = np.maximum(a, b)"),
        ("y = a[0]", "y = a[1]"),
        ("y = 1.0", "y = 0.0"),
        ("y = a and b", "y = a or b"),
        ("y = not a", "y = a"),
        ("y = abs(a)", "y = a"),
        ("y = -a", "y = a"),
        ("y[2] = a", "pass"),
        ("f(a)", "pass"),
        ("y = np.where(a, b, c)", "y = np.where(a, c, b)"),
        ("y = 2 * (a - b)", "y = 2 * (a + b)"),
    ],
)
def test_each_kind_of_fault_is_made(scripts, before, after):
    assert (before, after) in [mutant.texts for mutant in scripts[1].mutants("a.py", f"{before}\n")]


def test_a_sample_is_spread_over_files_and_is_the_same_for_the_same_seed(scripts):
    sampling = sys.modules["mutation.sampling"]
    sources = {"a.py": "x = a + b\n" * 30, "b.py": "y = c < d\n" * 10}
    chosen = sampling.sample(sources, 8, 3)
    assert [mutant.path for mutant in chosen] == ["a.py"] * 6 + ["b.py"] * 2
    assert [mutant.first for mutant in chosen] == [mutant.first for mutant in sampling.sample(sources, 8, 3)]
    assert len({(mutant.path, mutant.first) for mutant in chosen}) == 8


def test_every_native_fault_has_its_place_in_the_sources():
    root = Path(__file__).resolve().parents[1]
    table = tomllib.loads((root / "scripts/mutants_native.toml").read_text(encoding="utf-8"))
    for one in table["mutant"]:
        assert (root / one["file"]).read_text(encoding="utf-8").count(one["before"]) == 1, one
