"""`hexmend bench --only collection`: a row for each mesh and program, failures included; nothing is run twice."""

import csv
import stat
import sys
from types import MappingProxyType

import pytest

from hexmend import io
from hexmend.cli.main import main
from hexmend.errors import FileError
from hexmend.gallery import make
from hexmend.quality import measure, objective, summarise
from hexmend.report.collection.documents import BEGIN, END
from hexmend.report.collection.record import CollectionRecord, Program
from hexmend.report.collection.remarks import remark
from hexmend.report.collection.tables import objective_table, programs_table
from hexmend.study.bench.collection import find_meshes
from tests.browsers import chromium

#: A program that smooths with a method of Hexmend, writes down each mesh, and fails on meshes of one size.
SMOOTHER = """
import sys
import hexmend as hx
mesh = hx.read(sys.argv[1])
with open({log!r}, "a") as file:
    print(mesh.n_hexes, file=file)
if mesh.n_hexes == 8:
    sys.exit("it does not like eight")
hx.write(sys.argv[2], hx.smooth(mesh, "mend", goal="shape").mesh)
"""


class Bench:
    """The command on a folder of meshes, with a script in place of another program."""

    def __init__(self, folder, patch):
        self.folder, self.meshes, self.out, self.log = folder, folder / "meshes", folder / "out", folder / "log"
        (self.meshes / "inner").mkdir(parents=True)
        io.write(self.meshes / "bridge.vtk", make("bridge-sharp", size=200, scramble=0.3, seed=1))
        io.write(self.meshes / "inner/cube.mesh", make("cube", size=8, scramble=0.2))
        (self.meshes / "torn.vtk").write_text("# vtk DataFile Version 3.0\n")
        (self.meshes / "notes.txt").write_text("no mesh\n")
        self.page = folder / "page.md"
        self.page.write_text(f"# Peers\n{BEGIN}\nold\n{END}\nThe end.\n", encoding="utf-8")
        self.install()
        patch.setenv("HEXMEND_HEXSMOOTHING", str(folder / "smoother"))
        patch.setenv("HEXMEND_PEERS", "/nowhere/python")
        patch.delenv("HEXMEND_MESQUITE", raising=False)

    def install(self, more=""):
        program = self.folder / "smoother"
        program.write_text(f"#!{sys.executable}\n{SMOOTHER.format(log=str(self.log))}{more}\n")
        program.chmod(program.stat().st_mode | stat.S_IXUSR)

    def run(self, *words):
        fixed = "bench", "--only", "collection", str(self.meshes), "-o", str(self.out), "--no-pictures"
        return main([*fixed, *words])

    @property
    def rows(self):
        with open(self.out / "collection.csv", newline="", encoding="utf-8") as file:
            return {(row["mesh"].rpartition("/")[2], row["method"]): row for row in csv.DictReader(file)}


@pytest.fixture(scope="module")
def bench(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patch:
        made = Bench(tmp_path_factory.mktemp("collection"), patch)
        made.status = made.run("--peers", "--page", str(made.page))
        yield made


@pytest.mark.slow
def test_every_mesh_has_a_row_for_each_program(bench):
    own = "mend-fixed", "mend-slide", "mend-p1"
    names = [(mesh, method) for mesh in ("bridge.vtk", "cube.mesh", "torn.vtk") for method in (*own, "hexsmoothing")]
    assert sorted(bench.rows) == sorted(names)
    assert bench.status == 3  # a mesh cannot be read
    status = {key: row["status"] for key, row in bench.rows.items()}
    assert {key for key, value in status.items() if value == "unreadable"} == {key for key in names if "torn" in key[0]}
    assert status["cube.mesh", "hexsmoothing"] == "failed"
    assert bench.rows["cube.mesh", "hexsmoothing"]["reason"] == "it does not like eight"


@pytest.mark.slow
def test_figures_are_measured_from_the_results(bench):
    given = summarise(make("bridge-sharp", size=200, scramble=0.3, seed=1))
    rows = [row for (mesh, _), row in bench.rows.items() if mesh == "bridge.vtk"]
    assert {int(row["inverted_before"]) for row in rows} == {given.inverted}
    assert given.inverted > 0
    for row in rows:
        assert float(row["scaled_jacobian_min_before"]) == pytest.approx(given.scaled_jacobian_min)
        assert int(row["inverted_after"]) == 0
        assert float(row["scaled_jacobian_min_after"]) > 0
        assert float(row["seconds"]) > 0
        assert int(row["threads"]) == 1
        assert (float(row["boundary_distance"]) > 1e-9) == (row["method"] == "mend-slide")
    # the optimum at p = 1 has the lowest objective at p = 1 with this boundary
    values = {row["method"]: float(row["objective_p1_after"]) for row in rows}
    assert values["mend-p1"] < min(values["mend-fixed"], values["hexsmoothing"])
    cube = make("cube", size=8, scramble=0.2)
    expected = objective(measure(cube.points, cube.hexes), p=1.0)
    assert float(bench.rows["cube.mesh", "mend-p1"]["objective_p1_before"]) == pytest.approx(expected)


@pytest.mark.slow
def test_the_page_names_failures_and_programs_that_are_not_installed(bench):
    text = (bench.out / "collection.md").read_text(encoding="utf-8")
    assert "| TMOP | not installed |" in text
    assert "Mesquite: msqshape: ShapeImprovementWrapper with its defaults. Not installed: there is no msqshape" in text
    assert "| cube.mesh | hexsmoothing | – | – | – | – | – | – | – | – | failed: it does not like eight |" in text
    torn = next(line for line in text.splitlines() if line.startswith("| torn.vtk | – "))
    assert "torn.vtk: " in torn
    html = (bench.out / "collection.html").read_text(encoding="utf-8")
    assert "http" not in html
    assert "it does not like eight" in html


@pytest.mark.slow
def test_tables_replace_what_is_between_the_marks_of_a_page(bench):
    text = bench.page.read_text(encoding="utf-8")
    assert text.startswith(f"# Peers\n{BEGIN}\n")
    assert text.endswith(f"{END}\nThe end.\n")
    assert "old" not in text.splitlines()
    assert "| bridge.vtk | " in text
    assert "All figures" not in text
    assert max(len(line) for line in text.splitlines() if not line.startswith("|")) <= 120


@pytest.mark.slow
def test_a_second_run_repeats_nothing_and_another_build_runs_again(bench, capsys):
    before = bench.log.read_text()
    assert len(before.split()) == 2
    stored = {path: path.stat().st_mtime_ns for path in (bench.out / "tasks").iterdir()}
    bench.run("--peers")
    assert bench.log.read_text() == before
    assert {path: path.stat().st_mtime_ns for path in (bench.out / "tasks").iterdir()} == stored
    bench.install("# another build")
    bench.run("--peers")
    assert bench.log.read_text() == 2 * before
    assert all((bench.out / "tasks" / path.name).stat().st_mtime_ns == time for path, time in stored.items())


OURS = Program("ours", "", own=True, shape=True)
SLIDING = Program("sliding", "", own=True, slides=True)
THEIRS = Program("theirs", "1.0", shape=True)
GIVEN = MappingProxyType({"hexes": 8, "inverted_before": 0, "locked_inverted_before": 0, "invalid_before": 0, "q_min_before": 0.5,
                          "q_mean_before": 0.8, "scaled_jacobian_min_before": 0.4,
                          "objective_p1_before": 12.0})  # fmt: skip
RESULT = MappingProxyType({"mesh": "a.vtk", "status": "done", "reason": "", "inverted_after": 0, "invalid_after": 0,
                           "q_min_after": 0.6, "q_mean_after": 0.9, "scaled_jacobian_min_after": 0.5, "objective_p1_after": 10.0,
                           "boundary_distance": 0.0, "seconds": 1.0})  # fmt: skip


def recorded(*rows):
    """A record of one mesh; a row is a program and what differs from `RESULT`."""
    found = [GIVEN | RESULT | {"case": program.title, **values} for program, values in rows]
    return CollectionRecord(found, [program for program, _ in rows], len(rows), {}, 60.0)


@pytest.mark.parametrize(("ours", "theirs", "expected"), [
    ({}, {}, ""),
    ({"q_mean_after": 0.79}, {}, "lower q mean: as given 0.8000, theirs 0.9000"),
    ({}, {"q_mean_after": 0.90001}, ""),  # the same as shown
    ({}, {"scaled_jacobian_min_after": 0.7, "q_min_after": 0.61},
     "lower scaled Jacobian min: theirs 0.7000; lower q min: theirs 0.6100"),
    ({}, {"scaled_jacobian_min_after": 0.7, "boundary_distance": 1.0}, ""),  # it moved the boundary
    ({}, {"scaled_jacobian_min_after": 0.7, "invalid_after": 1}, ""),  # it left a hex invalid
    ({"inverted_after": 2, "invalid_after": 2}, {"inverted_after": 1, "invalid_after": 2},
     "higher inverted: as given 0, theirs 1; higher invalid: as given 0"),
    ({"invalid_after": 2}, {"invalid_after": 1}, "higher invalid: as given 0, theirs 1"),
    ({}, {"objective_p1_after": 9.9}, "higher Σ η: theirs 9.9"),
    ({}, {"objective_p1_after": 9.999999}, ""),
    ({}, {"scaled_jacobian_min_after": 0.7, "status": "failed"}, ""),
])  # fmt: skip
def test_a_row_says_where_another_result_is_better(ours, theirs, expected):
    record = recorded((OURS, ours), (THEIRS, theirs))
    assert remark(record, "a.vtk", OURS) == expected
    assert remark(record, "a.vtk", THEIRS) == ""


def test_a_sliding_boundary_is_compared_with_every_result():
    record = recorded((SLIDING, {"boundary_distance": 1.0}), (THEIRS, {"q_min_after": 0.7, "boundary_distance": 1.0}))
    assert remark(record, "a.vtk", SLIDING) == "lower q min: theirs 0.7000"


def test_programs_are_counted_against_the_first():
    record = recorded((OURS, {}), (THEIRS, {"scaled_jacobian_min_after": 0.45, "invalid_before": 3}))
    (_, *ours), (_, *theirs) = programs_table(record).rows
    assert ours == ["1 of 1", "1", "0 of 0", "0.5000", "–", "–", "1"]
    assert theirs == ["1 of 1", "1", "1 of 1", "0.4500", "0 of 1", "1 of 1", "1"]


def test_objectives_are_listed_where_two_programs_end_without_inverted_hexes():
    rows = objective_table(recorded((OURS, {}), (THEIRS, {"objective_p1_after": 7044.164422}))).rows
    assert rows == [["a.vtk", "12", "10", "1.00", "7,044.1644", "1.00"]]
    assert not objective_table(recorded((OURS, {}), (THEIRS, {"objective_p1_after": None}))).rows


@pytest.mark.parametrize(("words", "message"), [
    (["--only", "collection"], "needs a folder of meshes"),
    (["--only", "collection", "--only", "kernels", "x"], "is run alone"),
    (["--only", "collection", "--json", "x.json", "x"], "--json: a collection is written"),
    (["--only", "collection", "--jobs", "0", "x"], "--jobs 0 is too small"),
    (["--only", "collection", "--max-seconds", "0", "x"], "--max-seconds 0: expected a number"),
    (["--only", "collection", "nowhere"], "nowhere: there is no such file or folder"),
    (["--only", "collection", "--page", "nowhere.md", "x"], "nowhere.md: cannot be read"),
    (["--only", "kernels", "x"], "x is for a collection"),
    (["--peers"], "--peers is for a collection"),
])  # fmt: skip
def test_wrong_use_is_one_line(words, message, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["bench", *words]) in (2, 3)
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_a_page_without_marks_is_refused_before_the_work(capsys, tmp_path):
    page = tmp_path / "page.md"
    page.write_text("# Page\n<!-- end -->\n<!-- collection -->\n")
    words = "bench", "--only", "collection", "--page", str(page), "-o", str(tmp_path / "out"), str(tmp_path)
    assert main(list(words)) == 3
    assert "page.md: has no place for the tables" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_meshes_are_found_in_subfolders_and_cases_are_one_mesh(tmp_path):
    cube = make("cube", size=8)
    (tmp_path / "b").mkdir()
    io.write(tmp_path / "b/cube.vtu", cube)
    io.write(tmp_path / "a.msh", cube)
    (tmp_path / ".hidden").mkdir()
    io.write(tmp_path / ".hidden/cube.vtu", cube)
    case = tmp_path / "case"
    (case / "constant/polyMesh").mkdir(parents=True)
    for name in ("points", "faces", "owner", "neighbour", "boundary"):
        (case / "constant/polyMesh" / name).touch()
    named = tmp_path / "a.msh"
    assert find_meshes([tmp_path, named]) == [tmp_path / "a.msh", tmp_path / "b/cube.vtu", case]
    (tmp_path / "empty").mkdir()
    with pytest.raises(FileError, match="no mesh is in this folder"):
        find_meshes([tmp_path / "empty"])


@pytest.mark.slow
def test_heads_sort(bench, tmp_path):
    with chromium(tmp_path) as browser:
        opened = browser("--no-sandbox")
        page = opened.new_page()
        errors = []
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.goto((bench.out / "collection.html").as_uri())
        table = page.locator("table").nth(1)
        hexes = table.locator("th button").nth(1)

        def names():
            return [text.split("\t")[0] for text in table.locator("tbody tr").all_inner_texts()]

        assert names() == ["bridge.vtk", "cube.mesh", "torn.vtk"]
        hexes.click()
        assert names() == ["cube.mesh", "bridge.vtk", "torn.vtk"]
        hexes.click()
        assert names() == ["bridge.vtk", "cube.mesh", "torn.vtk"]
        assert not errors
        opened.close()


def test_pieces_of_a_file_are_no_meshes_of_their_own(tmp_path):
    io.write(tmp_path / "whole.pvtu", make("cube", size=8))
    io.write(tmp_path / "whole" / "other.vtu", make("cube", size=8))
    (tmp_path / "torn.pvtu").write_text("<VTKFile")
    names = [str(path.relative_to(tmp_path)) for path in find_meshes([tmp_path])]
    assert names == ["torn.pvtu", "whole/other.vtu", "whole.pvtu"]
    assert find_meshes([tmp_path / "whole" / "whole_0.vtu"]) == [tmp_path / "whole" / "whole_0.vtu"]
