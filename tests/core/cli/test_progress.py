"""Progress: quiet where there is nothing to say, on standard error only, and Ctrl-C loses nothing."""

from hexmend import gallery
from hexmend.cli.main import main
from hexmend.cli.output.progress import follow
from hexmend.run import StoppingCriteria, iterate, progress


def test_a_short_run_says_nothing_on_standard_error(mesh, tmp_path, run_command):
    assert main(["smooth", str(mesh), "-o", str(tmp_path / "out.vtu"), "--method", "laplacian"]) == 0
    assert run_command("compare", mesh, "-o", tmp_path / "tables", "--methods", "laplacian").err == ""


def test_a_long_run_tells_of_itself_in_whole_lines_and_on_standard_error_only(mesh, tmp_path, run_command, monkeypatch):
    monkeypatch.setattr(progress, "LINE_INTERVAL", 0.0)
    words = ["smooth", mesh, "-o", tmp_path / "out.vtu", "--method", "laplacian", "--max-iterations", "3"]
    said = run_command(*words, "--tolerance", "0")
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
