"""Progress: quiet where there is nothing to say, on standard error only, and Ctrl-C loses nothing."""

import json
import signal
import subprocess
import sys

import pytest

from hexmend import gallery, io
from hexmend.cli.main import main
from hexmend.cli.output.progress import follow
from hexmend.quality import summarise
from hexmend.run import StoppingCriteria, iterate, progress
from tests.patience import PATIENCE

#: The program, which tells of every iteration, so that a test need not wait for the clock.
TALKATIVE = (
    "import sys; from hexmend.run import progress; progress.LINE_INTERVAL = 0.0; "
    "from hexmend.cli.main import main; sys.exit(main(sys.argv[1:]))"
)
#: Never ends by itself.
ENDLESS = ["--tolerance", "0", "--max-iterations", "1000000"]


@pytest.fixture
def mesh(tmp_path):
    path = tmp_path / "mesh.vtu"
    io.write(path, gallery.make("cube", size=125, scramble=0.3))
    return path


def interrupted(*words, at, number=signal.SIGINT):
    """Run the program, send it a signal at its first line that begins with `at`, and wait for its end."""
    program = subprocess.Popen(
        [sys.executable, "-c", TALKATIVE, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    with program:
        for line in program.stderr:
            if line.startswith(at):
                program.send_signal(number)
                break
        else:
            pytest.fail(f"the program ended before {at!r}")
        out, err = program.communicate(timeout=PATIENCE / 1000)
    assert "Traceback" not in err
    return program.returncode, out, err


def test_a_short_run_says_nothing_on_standard_error(mesh, tmp_path, capsys):
    assert main(["smooth", str(mesh), "-o", str(tmp_path / "out.vtu"), "--method", "laplacian"]) == 0
    assert main(["compare", str(mesh), "-o", str(tmp_path / "tables"), "--methods", "laplacian"]) == 0
    assert capsys.readouterr().err == ""


def test_a_long_run_tells_of_itself_in_whole_lines_and_on_standard_error_only(mesh, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(progress, "LINE_INTERVAL", 0.0)
    words = ["smooth", mesh, "-o", tmp_path / "out.vtu", "--method", "laplacian", "--max-iterations", "3"]
    assert main([*map(str, words), "--tolerance", "0"]) == 0
    said = capsys.readouterr()
    assert [line.split(",")[0] for line in said.err.splitlines()] == [
        f"laplacian: iteration {k} of at most 3" for k in (1, 2, 3)
    ]
    assert "of at most" not in said.out


def test_on_a_terminal_a_line_changes_and_vanishes(monkeypatch, capsys):
    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setattr(progress, "BAR_DELAY", 0.0)
    run = iterate(
        gallery.make("cube", size=64, scramble=0.3), "laplacian", StoppingCriteria(max_iterations=4, tolerance=0)
    )
    follow(run)
    said = capsys.readouterr()
    assert said.out == ""
    assert "laplacian" in said.err
    assert "\x1b[2K" in said.err  # the line is erased


def test_control_c_ends_smooth_and_the_mesh_is_written(mesh, tmp_path):
    out, report = tmp_path / "out.vtu", tmp_path / "report.json"
    words = ["smooth", mesh, "-o", out, "--method", "local-sd", "--json", report, *ENDLESS]
    status, said, err = interrupted(*words, at="local-sd: iteration")
    assert status == 0
    assert "Interrupted: the result so far is kept." in err
    assert f"Written to {out}" in said
    answer = json.loads(report.read_text())
    assert answer["outcome"] == "stopped"
    assert answer["iterations"] >= 1
    assert answer["after"] == summarise(io.read(out)).to_dict()
    assert answer["after"]["q_mean"] > answer["before"]["q_mean"]


def test_a_signal_ends_compare_with_a_table_of_what_was_done(mesh, tmp_path):
    number = signal.SIGTERM
    words = ["compare", mesh, "-o", tmp_path, "--methods", "laplacian,local-sd,smart-laplacian", "--tolerance", "0"]
    # Laplacian ends at its own limit; the second method is the one that is stopped.
    status, said, err = interrupted(*words, "--max-iterations", "3000", at="local-sd: iteration", number=number)
    assert status == 128 + number
    assert "Interrupted" in err
    assert "interrupted" in said
    record = json.loads((tmp_path / "comparison.json").read_text())
    assert record["interrupted"]
    assert [(row["method"], row["outcome"]) for row in record["rows"]] == [
        ("laplacian", "max-iterations"),
        ("local-sd", "stopped"),
    ]
    assert record["rows"][1]["iterations"] >= 1


@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_the_study_with_a_report(tmp_path, number):
    words = ["study", "thesis", "--quick", "--only", "4.5", "--only", "4.11", "-o", tmp_path]
    status, _, err = interrupted(*words, at="local-sd: iteration", number=number)
    assert status == 128 + number
    assert "Interrupted" in err
    study = json.loads((tmp_path / "study.json").read_text())
    assert study["interrupted"]
    assert [one["table"] for one in study["experiments"]] == ["4.5"]
    assert list(study["experiments"][0]["columns"]) == ["initial", "local-sd"]
    assert study["experiments"][0]["columns"]["local-sd"]["outcome"] == "stopped"
    assert "interrupted" in (tmp_path / "study.md").read_text()
