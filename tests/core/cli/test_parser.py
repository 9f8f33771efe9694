"""Mistakes in the words of a command: one line, which names the word, the nearest name, and where to read on."""

import pytest

from hexmend.cli.main import main


def complaint(words, capsys):
    assert main(words) == 2
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 1
    return lines[0]


@pytest.mark.parametrize(
    ("words", "problem"),
    [
        (["smooth", "a.vtu", "-o", "b.vtu", "--boundry", "slide"], "no option --boundry: did you mean --boundary?"),
        (["smooth", "a.vtu", "--outptu=b.vtu"], "there is no option --outptu: did you mean --output?"),
        (["smooth", "a.vtu", "-o", "b.vtu", "--boundary", "slid"], "--boundary slid is unknown: did you mean slide?"),
        (["smooth", "a.vtu", "-o", "b.vtu", "--xyzzy"], "there is no option --xyzzy."),
        (["smooth", "a.vtu"], "missing: -o OUT (the smoothed mesh to write)."),
        (["smooth"], "missing: MESH (the mesh file), and -o OUT (the smoothed mesh to write)."),
        (["smooth", "a.vtu", "b.vtu", "-o", "c.vtu"], "'b.vtu' is one word too many."),
        (["smooth", "a.vtu", "-o", "b.vtu", "--BOUNDARY", "slide"], "no option --BOUNDARY: did you mean --boundary?"),
        (["smooth", "a.vtu", "-o", "b.vtu", "--only"], "argument --only: expected one argument."),
    ],
)
def test_a_mistake_is_one_line_with_the_nearest_name(words, problem, capsys):
    line = complaint(words, capsys)
    assert problem in line
    assert line.startswith("hexmend smooth: ")
    assert line.endswith("hexmend smooth --help lists the options.")


def test_a_command_that_is_misspelt_is_named_right(capsys):
    assert "'smoth' is neither a command nor a file: did you mean hexmend smooth?" in complaint(["smoth", "a"], capsys)
    assert "did you mean" not in complaint(["xyzzy"], capsys)


def test_arguments_that_may_be_left_out_are_not_missing(capsys):
    assert "MESH (" not in complaint(["study"], capsys)
