"""Commands that change a mesh keep all else in a file of the same format, and say so."""

import numpy as np
import pytest

from hexmend import ParameterError, gallery, io, read, write
from hexmend.cli.commands.smooth import checkpoint
from hexmend.cli.commands.smooth.checkpoint import Checkpoints
from hexmend.cli.main import main
from hexmend.cli.output import mesh_output
from hexmend.io import files
from hexmend.io.coordinates.located import CoordinatesError

END = "*MATERIAL, NAME=Steel\n*STEP\n** the end\n*END STEP\n"


@pytest.fixture
def deck(tmp_path):
    path = tmp_path / "deck.inp"
    io.write(path, gallery.make("bridge-sharp", size=300, scramble=0.3, seed=1))
    path.write_text("** ours\n" + path.read_text() + END)
    return path


def smooth(deck, out, *words):
    return main(["smooth", str(deck), "-o", str(out), "--method", "local-sd", "--max-iterations", "3", *words])


def test_smooth_replaces_coordinates_and_says_so(deck, tmp_path, capsys):
    smooth(deck, tmp_path / "out.inp")
    said = capsys.readouterr()
    assert "Coordinates replaced in a copy of deck.inp; everything else is as it was." in said.out
    assert "cannot hold" not in said.err
    before, after = (path.read_text().split("\n") for path in (deck, tmp_path / "out.inp"))
    n_changed = sum(a != b for a, b in zip(before, after, strict=True))
    given, got = io.read(deck), io.read(tmp_path / "out.inp")
    assert n_changed == np.count_nonzero((given.points != got.points).any(axis=1)) > 0
    assert (given.points == got.points)[given.fixed].all()


def test_smooth_may_write_its_own_input(deck, capsys):
    smooth(deck, deck)
    assert f"Coordinates replaced in {deck}; everything else is as it was." in capsys.readouterr().out
    assert deck.read_text().endswith(END)


def test_another_format_warns_of_losses(deck, tmp_path, capsys):
    smooth(deck, tmp_path / "out.su2")
    said = capsys.readouterr()
    assert "cannot hold" in said.err
    assert "Coordinates replaced" not in said.out


def test_repair_keeps_a_file_of_which_it_changes_nothing_else(deck, tmp_path, capsys):
    assert main(["repair", str(deck), "-o", str(tmp_path / "out.inp")]) == 0
    assert (tmp_path / "out.inp").read_bytes() == deck.read_bytes()


def with_a_loose_node(deck):
    deck.write_text(deck.read_text().replace("*NODE\n", "*NODE\n999999, 0., 0., 77.\n"))


def test_repair_does_not_replace_a_deck_by_one_without_its_materials(deck, tmp_path, run_command):
    with_a_loose_node(deck)
    before = deck.read_bytes()
    said = run_command("repair", deck, "-o", deck, status=3)
    assert "deck.inp: would lose data other than the mesh: keywords that define no mesh (*MATERIAL" in said.err
    assert "the mesh has other nodes than deck.inp. Choose another name, or rewrite the file (--rewrite)." in said.err
    assert "Repaired" not in said.out
    assert deck.read_bytes() == before
    assert sorted(path.name for path in tmp_path.iterdir()) == ["deck.inp"]
    printed = run_command("repair", deck, "-o", tmp_path / "other.inp").err
    assert "other than the mesh: keywords that define no mesh (*MATERIAL, *STEP, *END STEP); comments." in printed
    assert deck.read_bytes() == before
    assert main(["repair", str(deck), "-o", str(deck), "--rewrite"]) == 0
    assert io.read(deck).n_nodes == io.read(tmp_path / "other.inp").n_nodes


PROPERTY = 'HFProp bool "marked"\n'


@pytest.mark.parametrize("command", ["smooth", "pad", "repair"])
def test_a_file_of_a_format_that_is_written_anew_keeps_what_was_not_read(command, tmp_path, capsys):
    path, spare = tmp_path / "a.ovm", tmp_path / "a-hexmend.ovm"
    io.write(path, gallery.make("cube", size=27, scramble=0.2))
    plain = path.read_text()
    path.write_text(plain + PROPERTY + "1\n" * 216)
    before = path.read_bytes()
    assert main([command, str(path), "-o", str(path)]) == 3
    words = "would lose data other than the mesh: the property 'marked' (HFProp bool). It has to be rewritten"
    assert words in capsys.readouterr().err
    assert path.read_bytes() == before
    assert spare.exists() == (command != "repair")
    path.write_text(plain)
    assert main([command, str(path), "-o", str(path)]) == 0


def test_a_result_beside_the_file_takes_the_name_of_no_other(deck, monkeypatch, capsys):
    def refuse(*arguments):
        raise CoordinatesError("its parts have moved differently")

    monkeypatch.setattr(files, "replace_coordinates", refuse)
    taken = deck.with_name("deck-hexmend.inp")
    taken.write_text("the only copy of something")
    for name in ("deck-hexmend-2.inp", "deck-hexmend-3.inp"):
        assert smooth(deck, deck) == 3
        assert f"The result was saved to {deck.with_name(name)}." in capsys.readouterr().err
        assert io.read(deck.with_name(name)).n_nodes == io.read(deck).n_nodes
    assert taken.read_text() == "the only copy of something"


def test_a_result_is_not_lost_where_the_input_has_changed_meanwhile(deck, monkeypatch, capsys):
    write = mesh_output.write_as_given

    def late(path, mesh, original):
        deck.write_text(deck.read_text().replace("*NODE\n", "*NODE\n999999, 0., 0., 77.\n"))
        return write(path, mesh, original)

    monkeypatch.setattr(mesh_output, "write_as_given", late)
    assert smooth(deck, deck) == 3
    assert "has changed since it was read" in capsys.readouterr().err
    assert "999999" in deck.read_text()
    assert io.read(deck.with_name("deck-hexmend.inp")).n_nodes == io.read(deck).n_nodes - 1


@pytest.mark.parametrize("words", [["smooth"], ["repair", "--rewrite"], ["pad"]])
def test_no_command_overwrites_a_file_that_the_deck_includes(deck, words, run_command):
    with_a_loose_node(deck)
    head, nodes, rest = deck.read_text().partition("*NODE\n")
    end = rest.index("*")
    deck.with_name("nodes.inp").write_text(nodes + rest[:end])
    deck.write_text(f"{head}*INCLUDE, INPUT=nodes.inp\n{rest[end:]}")
    before = {path.name: path.read_bytes() for path in deck.parent.iterdir()}
    command, *options = words
    printed = run_command(command, deck, "-o", deck.with_name("nodes.inp"), *options, status=3).err
    assert "nodes.inp: is included by deck.inp. Choose another name." in printed
    assert before == {path.name: path.read_bytes() for path in deck.parent.iterdir()}


def test_what_is_not_read_but_kept_in_the_copy_is_called_so(tmp_path, run_command):
    deck = tmp_path / "deck.inp"
    io.write(deck, gallery.make("cube", size=8))
    deck.write_text(deck.read_text() + "*MATERIAL, NAME=STEEL\n")
    for out, note in (("out.inp", "Kept without being read: "), ("out.vtu", "Not read: ")):
        printed = run_command("smooth", deck, "-o", tmp_path / out).err
        assert f"hexmend: {note}keywords that define no mesh (*MATERIAL)." in printed


# Checkpoints of a run: when they are due, what they hold, and that they go once the result is there.


MESH = gallery.make("cube", size=8)


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
    write(given, gallery.make("five-side", size=200, scramble=0.2))
    monkeypatch.setattr(checkpoint, "write", lambda path, mesh: written.append(mesh) or write(path, mesh))
    assert main(["smooth", str(given), "-o", str(out), "--checkpoint", "1e-9"]) == 0
    assert len(written) > 3
    assert out.exists()
    assert not (tmp_path / "out.checkpoint.vtu").exists()


def test_a_file_that_is_there_already_is_never_overwritten_nor_removed(tmp_path):
    given, earlier = tmp_path / "out.checkpoint.vtu", tmp_path / "out.checkpoint-2.vtu"
    write(given, gallery.make("five-side", size=200, scramble=0.2))
    before = given.read_bytes()
    earlier.write_text("of another run")
    assert main(["smooth", str(given), "-o", str(tmp_path / "out.vtu"), "--checkpoint", "1e-9"]) == 0
    assert given.read_bytes() == before
    assert earlier.read_text() == "of another run"
    assert not (tmp_path / "out.checkpoint-3.vtu").exists()


def test_a_checkpoint_that_cannot_be_written_does_not_end_the_run(tmp_path, monkeypatch, run_command):
    given, out = tmp_path / "given.vtu", tmp_path / "out.vtu"
    write(given, gallery.make("five-side", size=200, scramble=0.2))

    def full(path, mesh):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(checkpoint, "write", full)
    printed = run_command("smooth", given, "-o", out, "--checkpoint", "1e-9").err
    assert "no checkpoint was written, and the run continues" in printed
    assert out.exists()
