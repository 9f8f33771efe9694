"""Ranking of the entries of the command palette for a typed text."""

import pytest

from hexmend_app.shell.palette.ranking import PaletteEntry, ranked

ENTRIES = [
    PaletteEntry(name=name, run=print, help=help, kind=kind)
    for name, help, kind in (
        ("Reset", "Put all nodes back; undo takes that back too.", ""),
        ("Redo", "Do again what undo took back.", ""),
        ("Undo", "Take back the last change of the mesh.", ""),
        ("Run or pause", "Run the chosen method.", ""),
        ("Save mesh as…", "", ""),
        ("Mend", "Untangles.", "Method"),
        ("Smart Laplacian", "", "Method"),
        ("Recommended smoothing", "Mends.", ""),
        ("Scaled Jacobian", "", "Colour by"),
        ("Tolerance", "Where it stops.", "In Run"),
    )
]


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("undo", ["Undo", "Reset", "Redo"]),
        ("mend", ["Mend", "Recommended smoothing"]),
        ("lap", ["Smart Laplacian"]),
        ("jac colour", ["Scaled Jacobian"]),
        ("run", ["Run or pause", "Tolerance"]),
        ("as mesh", ["Save mesh as…", "Undo"]),
        ("method", ["Mend", "Smart Laplacian", "Run or pause"]),
        ("  UNDO ", ["Undo", "Reset", "Redo"]),
        ("nonsense", []),
    ],
)
def test_matches_in_names_rank_before_matches_in_help(text, names):
    assert [entry.name for entry in ranked(ENTRIES, text)] == names


def test_an_empty_text_keeps_the_order():
    assert ranked(ENTRIES, " ") == ENTRIES


def test_commands_that_cannot_be_run_now_come_last_and_only_for_a_text():
    film = PaletteEntry(name="Save film…", run=print, help="Save the run as an animation.", enabled=False)
    assert ranked([film, *ENTRIES], "") == ENTRIES
    assert ranked([film, *ENTRIES], "animation") == [film]
    assert [entry.name for entry in ranked([film, *ENTRIES], "save")] == ["Save mesh as…", "Save film…"]
