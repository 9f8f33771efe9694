"""What is typed finds what is meant, the best match first."""

import pytest

from hexmend_app.shell.palette.ranking import PaletteEntry, ranked

ENTRIES = [
    PaletteEntry(name=name, do=print, help=help, kind=kind)
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
    ("text", "found"),
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
def test_names_come_before_what_only_the_help_says(text, found):
    assert [one.name for one in ranked(ENTRIES, text)] == found


def test_nothing_typed_leaves_all_as_they_come():
    assert ranked(ENTRIES, " ") == ENTRIES
