"""Checkpoints of a run: when they are due, what they hold, and that they go once the result is there."""

import numpy as np
import pytest

from hexmend import ParameterError, read, write
from hexmend.cli.commands.smooth import checkpoint
from hexmend.cli.commands.smooth.checkpoint import Checkpoints
from hexmend.cli.main import main
from hexmend.gallery import make

MESH = make("cube", size=8)


def test_one_is_due_after_each_interval(tmp_path, monkeypatch):
    clock = [0.0]
    monkeypatch.setattr(checkpoint, "monotonic", lambda: clock[0])
    kept = Checkpoints(str(tmp_path / "out.vtu"), 2)
    for seconds, due in ((0, False), (119, False), (120, True)):
        clock[0] = seconds
        assert kept.due == due
    kept.write(lambda: MESH)
    assert not kept.due
    assert kept.path.name == "out.checkpoint.vtu"
    np.testing.assert_array_equal(read(kept.path).points, MESH.points)
    kept.remove()
    assert not kept.path.exists()


def test_none_is_due_without_minutes_and_a_file_of_another_run_stays(tmp_path):
    kept = Checkpoints(str(tmp_path / "out.vtu"), None)
    kept.path.write_text("of another run")
    kept.remove()
    assert not kept.due
    assert kept.path.exists()


@pytest.mark.parametrize("minutes", [0.0, -1.0, float("nan")])
def test_minutes_are_positive(minutes):
    with pytest.raises(ParameterError, match="is out of bounds: expected a number of minutes"):
        Checkpoints("out.vtu", minutes)


def test_a_run_of_one_process_writes_them_and_removes_the_last(tmp_path, monkeypatch, capsys):
    given, out, written = tmp_path / "given.vtu", tmp_path / "out.vtu", []
    write(given, make("five-side", size=200, scramble=0.2))
    monkeypatch.setattr(checkpoint, "write", lambda path, mesh: written.append(mesh) or write(path, mesh))
    assert main(["smooth", str(given), "-o", str(out), "--checkpoint", "1e-9"]) == 0
    assert len(written) > 3
    assert out.exists()
    assert not (tmp_path / "out.checkpoint.vtu").exists()


def test_a_file_that_is_there_already_is_never_overwritten_nor_removed(tmp_path):
    given, earlier = tmp_path / "out.checkpoint.vtu", tmp_path / "out.checkpoint-2.vtu"
    write(given, make("five-side", size=200, scramble=0.2))
    before = given.read_bytes()
    earlier.write_text("of another run")
    assert main(["smooth", str(given), "-o", str(tmp_path / "out.vtu"), "--checkpoint", "1e-9"]) == 0
    assert given.read_bytes() == before
    assert earlier.read_text() == "of another run"
    assert not (tmp_path / "out.checkpoint-3.vtu").exists()


def test_a_checkpoint_that_cannot_be_written_does_not_end_the_run(tmp_path, monkeypatch, run_command):
    given, out = tmp_path / "given.vtu", tmp_path / "out.vtu"
    write(given, make("five-side", size=200, scramble=0.2))

    def full(path, mesh):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(checkpoint, "write", full)
    assert (
        "no checkpoint was written, and the run continues"
        in run_command("smooth", given, "-o", out, "--checkpoint", "1e-9").err
    )
    assert out.exists()
