"""`hexmend film`."""

import pytest
from PIL import Image

from hexmend.cli.main import main
from hexmend.run import memory


def test_a_run_becomes_an_animation(mesh_file, tmp_path, capsys):
    path = tmp_path / "run.gif"
    words = ["--method", "laplacian", "--max-iterations", "9", "--frames", "4", "--size", "320x240", "--clip", "x:0.5"]
    assert main(["film", str(mesh_file), "-o", str(path), *words]) == 0
    assert "4 frames of 320 × 240 pixels" in capsys.readouterr().out
    with Image.open(path) as film:
        assert (film.n_frames, film.size) == (4, (320, 240))


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["-o", "run.mp4"], "Use .gif, .png or .webp."),
        (["-o", "run.gif", "--frames", "1"], "--frames '1' cannot be used: expected a whole number from 2 to 1000"),
        (["-o", "run.gif", "--rate", "fast"], "--rate 'fast' cannot be used"),
        (["-o", "run.gif", "--method", "lapalcian"], "lapalcian"),
    ],
)
def test_what_cannot_be_filmed_is_said_before_the_run(mesh_file, tmp_path, monkeypatch, capsys, words, said):
    monkeypatch.chdir(tmp_path)
    assert main(["film", str(mesh_file), *words]) != 0
    assert said in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_a_film_for_which_memory_will_not_suffice_is_refused(mesh_file, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(memory, "available", lambda: 1000)
    assert main(["film", str(mesh_file), "-o", str(tmp_path / "run.gif"), "--method", "laplacian"]) == 3
    assert capsys.readouterr().err.startswith("hexmend: Laplacian on ")
    assert not (tmp_path / "run.gif").exists()
