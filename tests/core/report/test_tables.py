"""Tables parse back to what went in, whatever stands in their cells."""

import csv
import itertools
import json
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.errors import FileError
from hexmend.quantity import format_significant
from hexmend.report.comparison import LINES, comparison_table, record_table
from hexmend.report.documents import output_folder, write_documents
from hexmend.report.latex import latex
from hexmend.report.markdown import markdown
from hexmend.report.records import write_csv
from hexmend.report.tables import Table

AWKWARD = "a_b & 50 % of #1 {x} ~ $y$ ^ \\ | <i>*[z]*</i> `c`"
TABLE = Table(AWKWARD, ["", AWKWARD, "µ"], [[AWKWARD, "1", "–"], ["q min", "0.5", AWKWARD]], [AWKWARD])


def markdown_cells(text):
    """The cells of the pipes, unescaped."""
    rows = [line for line in text.splitlines() if line.startswith("|")]
    cells = [[cell.strip() for cell in re.split(r"(?<!\\)\|", row)[1:-1]] for row in rows]
    return [[re.sub(r"\\(.)", r"\1", cell) for cell in row] for row in [cells[0], *cells[2:]]]


def test_markdown_parses_back():
    cells = markdown_cells(markdown(TABLE))
    assert cells == [list(TABLE.head), *map(list, TABLE.rows)]


def test_latex_has_no_bare_special_letter():
    text = latex(TABLE)
    body = re.search(r"\\begin\{tabular\}\{l\|rr\}\n(.*)\\end\{tabular\}", text, re.DOTALL).group(1)
    lines = [line.removesuffix(r" \\") for line in body.splitlines() if line != r"\hline"]
    assert len(lines) == 3
    for line in lines:
        assert len(re.findall(r"(?<!\\)&", line)) == 2  # three cells
        bare = re.sub(
            r"\\(textbackslash|textasciicircum|textasciitilde)\{\}|\$(<|>|\||\\[a-z]+)\$|\\[{}$&%#_]", "", line
        )
        assert not re.search(r"[#$%_{}~^\\|<>]", bare), bare
    assert text.isascii()
    for kind in ("table", "tabular"):
        assert text.count(f"\\begin{{{kind}}}") == text.count(f"\\end{{{kind}}}") == 1


@given(st.floats(1e-6, 1e9))
def test_significant_keeps_four_figures_and_has_no_exponent(value):
    text = format_significant(value)
    assert "e" not in text
    assert float(text.replace(",", "")) == pytest.approx(value, rel=5.01e-4, abs=1e-10)


def record(outcome="converged", **figures):
    return {"method": "local-sd", "outcome": outcome, "message": "", "iterations": 7, "q_min": 0.5, **figures}


def test_a_missing_figure_is_a_dash():
    table = comparison_table("T", {"initial": {"q_min": 0.25}, "local-sd": record()})
    rows = {name: cells for name, *cells in table.rows}
    assert rows["q min"] == ["0.2500", "0.5000"]
    assert rows["time, s"] == ["–", "–"]
    assert [row[0] for row in table.rows] == [figure.label for figure in LINES]


def test_many_methods_turn_the_table_on_its_side_and_lose_nothing():
    columns = {f"method-{k}": record(q_min=k / 100) for k in range(9)}
    table = comparison_table("T", columns)
    assert [row[0] for row in table.rows] == list(columns)
    assert list(table.head[1:]) == [figure.label for figure in LINES]
    assert [row[table.head.index("q min")] for row in table.rows] == [f"{k / 100:.4f}" for k in range(9)]
    assert table.transposed.transposed == table


@given(st.integers(1, 60))
def test_parts_fit_and_hold_every_column_once(width):
    table = Table("T", ["", *"abcd"], [["row", "1", "22", "333", "4" * 12], ["another", "5", "6", "7", "8"]])
    parts = list(table.parts(width, gap=2))
    assert [head for part in parts for head in part.head[1:]] == list("abcd")
    for part in parts:
        assert [row[0] for row in part.rows] == ["row", "another"]
        wide = sum(2 + max(map(len, column)) for column in zip(part.head, *part.rows, strict=True))
        assert wide <= width or len(part.head) == 2
    cells = [list(itertools.chain(*(part.rows[k][1:] for part in parts))) for k in (0, 1)]
    assert cells == [row[1:] for row in table.rows]


@pytest.mark.parametrize(("outcome", "note"), [
    ("max-seconds", "stopped at the time limit"),
    ("max-iterations", "stopped at the iteration limit"),
    ("stopped", "ended by the user"),
    ("no-descent", "no step lowers the objective"),
])  # fmt: skip
def test_a_run_that_did_not_converge_is_said_below_the_table(outcome, note):
    assert any(note in sentence for sentence in comparison_table("T", {"a": record(outcome)}).notes)
    assert not any(note in sentence for sentence in comparison_table("T", {"a": record()}).notes)


def test_a_failure_and_locked_hexes_are_said():
    initial = {"hexes": 8, "free_nodes": 1, "locked_inverted": 3, "inverted": 4}
    failed = record("failed") | {"message": "Failed: singular"}
    table = record_table({"mesh": "m", "initial": initial, "interrupted": True, "rows": [failed]})
    said = " ".join(table.notes)
    for word in ("local-sd: Failed: singular", "3 of the inverted hexes are locked", "interrupted"):
        assert word in said


def test_documents_hold_the_same_table(tmp_path):
    rows = [{"method": "a", "q": 0.1 + 0.2, "parameters": {"p": 2.0}, "counts": [1]}, {"method": "b,\n", "time": None}]
    paths = write_documents(tmp_path, "t", TABLE, rows, {"rows": rows})
    assert [path.name for path in paths] == ["t.csv", "t.md", "t.tex", "t.json"]
    with open(paths[0], newline="", encoding="utf-8") as file:
        back = list(csv.DictReader(file))
    assert back == [
        {"method": "a", "q": repr(0.1 + 0.2), "parameters": "p=2.0", "time": ""},
        {"method": "b,\n", "q": "", "parameters": "", "time": ""},
    ]
    assert paths[1].read_text(encoding="utf-8") == markdown(TABLE)
    assert paths[2].read_text(encoding="utf-8") == latex(TABLE)
    assert json.loads(paths[3].read_text(encoding="utf-8")) == {"rows": rows}


def test_a_table_is_written_as_a_whole_or_not_at_all(tmp_path):
    path = tmp_path / "t.csv"
    write_csv(path, [{"a": 1}])
    before = path.read_bytes()

    class Unwritable:
        def __str__(self):
            raise RuntimeError

    with pytest.raises(RuntimeError):
        write_csv(path, [{"a": Unwritable()}])
    assert path.read_bytes() == before
    assert list(tmp_path.iterdir()) == [path]


def test_a_folder_that_cannot_be_is_said(tmp_path):
    (tmp_path / "file").write_text("")
    for path in (tmp_path / "file", tmp_path / "file" / "below"):
        with pytest.raises(FileError, match="Choose another folder"):
            output_folder(path)
