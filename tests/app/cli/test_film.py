"""`hexmend film`."""

import numpy as np
import pytest
from PIL import Image

from hexmend import io
from hexmend.cli.main import main
from hexmend.run import memory
from tests.core.boundary.solids import ball, slid
from tests.core.smoothers.test_sliding_smoother import skin_of, write_stl


def test_a_run_becomes_an_animation(mesh_file, tmp_path, run_command):
    path = tmp_path / "run.gif"
    options = [
        "--method",
        "laplacian",
        "--max-iterations",
        "9",
        "--frames",
        "4",
        "--size",
        "320x240",
        "--clip",
        "x:0.5",
    ]
    assert "4 frames of 320 × 240 pixels" in run_command("film", mesh_file, "-o", path, *options).out
    with Image.open(path) as film:
        assert (film.n_frames, film.size) == (4, (320, 240))


WRONG_OPTIONS = [
    (["-o", "run.avi"], "Use .mp4, .gif, .png or .webp."),
    (["-o", "run.gif", "--frames", "1"], "--frames '1' cannot be used: expected a whole number from 2 to 1000"),
    (["-o", "run.gif", "--rate", "fast"], "--rate 'fast' cannot be used"),
    (["-o", "run.gif", "--arrows", "some"], "expected none, sight, all"),
    (["-o", "run.gif", "--since", "ever"], "expected opened, run, iteration"),
    (["-o", "run.gif", "--method", "lapalcian"], "lapalcian"),
]


@pytest.mark.parametrize(("options", "message"), WRONG_OPTIONS)
def test_wrong_options_are_reported_before_the_run(mesh_file, tmp_path, monkeypatch, capsys, options, message):
    monkeypatch.chdir(tmp_path)
    assert main(["film", str(mesh_file), *options]) != 0
    assert message in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_a_film_that_needs_too_much_memory_is_refused(mesh_file, tmp_path, monkeypatch, run_command):
    monkeypatch.setattr(memory, "available", lambda: 1000)
    said = run_command("film", mesh_file, "-o", tmp_path / "run.gif", "--method", "laplacian", status=3).err
    assert said.startswith("hexmend: Laplacian on ")
    assert not (tmp_path / "run.gif").exists()


@pytest.mark.slow
def test_an_mp4_film_plays(mesh_file, tmp_path):
    av = pytest.importorskip("av")
    path = tmp_path / "run.mp4"
    options = ["--method", "laplacian", "--max-iterations", "9", "--frames", "4", "--size", "401x241", "--rate", "12"]
    assert main(["film", str(mesh_file), "-o", str(path), *options, "--histogram", "--arrows", "sight"]) == 0
    with av.open(str(path)) as film:
        (stream,) = film.streams.video
        assert (stream.codec_context.name, stream.pix_fmt, stream.average_rate) == ("h264", "yuv420p", 12)
        frames = [frame.to_ndarray(format="rgb24").astype(int) for frame in film.decode(stream)]
    assert len(frames) == 8 + 2 + 8  # the first and the last frame are repeated
    assert {frame.shape for frame in frames} == {(242, 402, 3)}
    assert abs(frames[0] - frames[-1]).max() > 100
    assert abs(frames[0] - frames[5]).mean() < 1


def test_without_pyav_an_mp4_film_is_refused_before_the_run(mesh_file, tmp_path, monkeypatch, run_command):
    monkeypatch.setattr("hexmend_app.scene.film.film_files.find_spec", lambda name: None)
    printed = run_command("film", mesh_file, "-o", tmp_path / "run.mp4", "--method", "laplacian", status=3).err
    assert "pip install '.[film]'" in printed


def test_a_histogram_is_drawn_next_to_the_mesh(mesh_file, tmp_path):
    frames = []
    for options in ([], ["--histogram"]):
        path = tmp_path / "run.png"
        run = ["--method", "laplacian", "--max-iterations", "2", "--size", "640x400"]
        assert main(["film", str(mesh_file), "-o", str(path), *run, *options]) == 0
        with Image.open(path) as film:
            frames.append(np.asarray(film.convert("RGB")).astype(int))
    without, with_histogram = frames
    right = slice(640 - int(0.32 * 640), None)
    assert 0.3 < (with_histogram[60:340, right] == 255).all(axis=2).mean() < 0.95
    assert (without[60:340, right] == 255).all()


def _frames(path):
    """Return the frames of a film as (n, h, w, 3) int, and their durations in ms."""
    with Image.open(path) as film:
        frames, durations = [], []
        for number in range(film.n_frames):
            film.seek(number)
            frames.append(np.asarray(film.convert("RGB")).astype(int))
            durations.append(film.info["duration"])
    return np.array(frames), durations


@pytest.mark.slow
def test_the_mesh_before_the_run_stays_next_to_it(mesh_file, tmp_path):
    path = tmp_path / "run.png"
    run = ["--method", "laplacian", "--max-iterations", "3", "--size", "640x300", "--keep-last"]
    assert main(["film", str(mesh_file), "-o", str(path), *run, "--before", "--key", "axes.show=false"]) == 0
    frames, _ = _frames(path)
    left, right = frames[:, 20:260, :317], frames[:, 20:260, 322:639]
    assert abs(left - left[0]).mean() < 1
    assert abs(left[0] - right[0]).mean() < 1
    assert abs(left[-1] - right[-1]).max() > 100


@pytest.mark.slow
def test_a_film_can_begin_with_its_result(mesh_file, tmp_path, run_command):
    path = tmp_path / "run.gif"
    run = ["--method", "laplacian", "--max-iterations", "3", "--size", "640x300", "--rate", "10"]
    printed = run_command("film", mesh_file, "-o", path, *run, "--before", "--histogram", "--poster").out
    assert "4 frames of 640 × 300 pixels" in printed
    frames, durations = _frames(path)
    assert durations == [100, 800, 100, 100, 800]
    assert (frames[0] == frames[-1]).all()
    assert (frames[0] != frames[1]).any()


@pytest.mark.slow
def test_the_boundary_slides_on_the_surface_of_an_option(tmp_path, run_command):
    write_stl(tmp_path / "fine.stl", skin_of(ball(8)))
    io.write(tmp_path / "ball.vtu", slid(ball(3), 0.3))
    options = ["--method", "laplacian", "--max-iterations", "2", "--size", "320x240", "--frames", "2"]
    words = ["film", str(tmp_path / "ball.vtu"), "-o", str(tmp_path / "run.gif"), *options]
    assert "from fine.stl" in run_command(*words, "--surface", tmp_path / "fine.stl").out
