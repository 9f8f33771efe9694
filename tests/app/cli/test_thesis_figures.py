"""`hexmend figures plane --thesis`."""

from functools import partial
from importlib.resources import files

from hexmend.cli import main as program
from hexmend.study import experiments
from hexmend_app.cli import figure_set


def test_the_figures_of_the_thesis_are_drawn_by_one_command(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(program, "commands", lambda: {"figures": lambda: figure_set.command})
    whole = files("hexmend.study").joinpath("thesis.toml").read_text(encoding="utf-8")
    small = tmp_path / "small.toml"
    small.write_text(whole.replace("quick = 31760", "quick = 3000"), encoding="utf-8")
    monkeypatch.setattr(experiments, "load", partial(experiments.load, small))
    words = ["figures", "plane", "--thesis", "--quick", "--max-seconds", "1", "-o", str(tmp_path / "set")]
    assert program.main(words) == 0
    drawn = sorted(path.name[:10] for path in (tmp_path / "set").glob("figure-*.png"))
    assert drawn == [f"figure-4.{number}" for number in range(5, 10)]
    assert "figure-4.9-distributions.png" in (tmp_path / "set" / "captions.md").read_text()
    assert "hexmend figures plane --max-seconds 1 --thesis --quick" in (tmp_path / "set" / "commands.sh").read_text()
