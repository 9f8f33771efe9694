"""Commands that change a mesh keep all else in a file of the same format, and say so."""

import numpy as np
import pytest

from hexmend import io
from hexmend.cli.main import main
from hexmend.cli.output import mesh_output
from hexmend.gallery import make
from hexmend.io import files
from hexmend.io.coordinates.located import CoordinatesError

END = "*MATERIAL, NAME=Steel\n*STEP\n** the end\n*END STEP\n"


@pytest.fixture
def deck(tmp_path):
    path = tmp_path / "deck.inp"
    io.write(path, make("bridge-sharp", size=300, scramble=0.3, seed=1))
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
    assert (
        "other than the mesh: keywords that define no mesh (*MATERIAL, *STEP, *END STEP); comments."
        in run_command("repair", deck, "-o", tmp_path / "other.inp").err
    )
    assert deck.read_bytes() == before
    assert main(["repair", str(deck), "-o", str(deck), "--rewrite"]) == 0
    assert io.read(deck).n_nodes == io.read(tmp_path / "other.inp").n_nodes


PROPERTY = 'HFProp bool "marked"\n'


@pytest.mark.parametrize("command", ["smooth", "pad", "repair"])
def test_a_file_of_a_format_that_is_written_anew_keeps_what_was_not_read(command, tmp_path, capsys):
    path, spare = tmp_path / "a.ovm", tmp_path / "a-hexmend.ovm"
    io.write(path, make("cube", size=27, scramble=0.2))
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
    assert (
        "nodes.inp: is included by deck.inp. Choose another name."
        in run_command(command, deck, "-o", deck.with_name("nodes.inp"), *options, status=3).err
    )
    assert before == {path.name: path.read_bytes() for path in deck.parent.iterdir()}


def test_what_is_not_read_but_kept_in_the_copy_is_called_so(tmp_path, run_command):
    deck = tmp_path / "deck.inp"
    io.write(deck, make("cube", size=8))
    deck.write_text(deck.read_text() + "*MATERIAL, NAME=STEEL\n")
    for out, note in (("out.inp", "Kept without being read: "), ("out.vtu", "Not read: ")):
        assert (
            f"hexmend: {note}keywords that define no mesh (*MATERIAL)."
            in run_command("smooth", deck, "-o", tmp_path / out).err
        )
