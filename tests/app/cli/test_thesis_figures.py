"""`hexmend figures plane --thesis`."""

from functools import partial
from importlib.resources import files

import pytest

from hexmend.cli import main as program
from hexmend.study.thesis import experiments
from hexmend_app.cli import figure_set


@pytest.mark.slow
def test_the_figures_of_the_thesis_are_drawn_by_one_command(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(program, "commands", lambda: {"figures": lambda: figure_set.command})
    whole = files("hexmend.study.thesis").joinpath("thesis.toml").read_text(encoding="utf-8")
    small = tmp_path / "small.toml"
    small.write_text(whole.replace("quick = 31760", "quick = 3000"), encoding="utf-8")
    monkeypatch.setattr(experiments, "load", partial(experiments.load, small))
    words = [
        "figures",
        "plane",
        "--thesis",
        "--quick",
        "--max-seconds",
        "1",
        "--format",
        "svg,pdf,png",
        "-o",
        str(tmp_path / "set"),
    ]
    assert program.main(words) == 0
    for suffix, head in (("png", b"\x89PNG"), ("pdf", b"%PDF"), ("svg", b"<?xml")):
        drawn = sorted((tmp_path / "set").glob(f"figure-*.{suffix}"))
        assert [path.name[:10] for path in drawn] == [f"figure-4.{number}" for number in range(5, 10)]
        assert all(path.read_bytes().startswith(head) for path in drawn)
    assert "figure-4.9-distributions.png" in (tmp_path / "set" / "captions.md").read_text()
    assert (
        "hexmend figures plane --format svg,pdf,png --max-seconds 1 --thesis --quick"
        in (tmp_path / "set" / "commands.sh").read_text()
    )


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--format", "gif"], "--format 'gif' cannot be used: expected names among png, pdf, svg"),
        (["--width-mm", "90"], "--width-mm '90' cannot be used: expected it without --thesis"),
        (["--only", "cut"], "--only 'cut' cannot be used: expected it without --thesis"),
    ],
)
def test_options_that_the_thesis_excludes_are_rejected_at_once(tmp_path, monkeypatch, capsys, words, said):
    monkeypatch.setattr(program, "commands", lambda: {"figures": lambda: figure_set.command})
    assert program.main(["figures", "plane", "--thesis", *words, "-o", str(tmp_path / "set")]) == 2
    assert said in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []
