"""Progress of `smooth`: a bar where somebody watches, lines on request, else nothing."""

import io
import sys
from types import SimpleNamespace

import pytest

import hexmend as hx
from hexmend.errors import ParameterError
from hexmend.mesh.hexahedron import UNIT_CUBE
from hexmend.run import progress

MESH = hx.gallery.make("cube", size=64, scramble=0.3)


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.fixture
def at_once(monkeypatch):
    """Let displays show every iteration."""
    for name in ("BAR_DELAY", "BAR_INTERVAL", "LINE_INTERVAL"):
        monkeypatch.setattr(progress, name, 0.0)


def smoothed(option=None, stream=None, watch=None):
    """Smooth with standard error replaced; return what was written to it."""
    stream = stream if stream is not None else io.StringIO()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, "stderr", stream)
        patch.setenv("COLUMNS", "60")
        patch.setenv("TERM", "xterm")
        result = hx.smooth(MESH, "laplacian", max_iterations=3, tolerance=0, progress=option, watch=watch)
    assert result.iterations == 3
    return stream.getvalue()


@pytest.mark.usefixtures("at_once")
def test_a_terminal_shows_a_bar_that_is_removed():
    written = smoothed(stream=Terminal())
    *bars, end = written.split("\r\x1b[2K")[1:]
    assert len(bars) == 3
    assert {len(bar) for bar in bars} == {59}  # less than the terminal is wide
    assert bars[0].startswith("[#######.............] laplacian: iteration 1 of at most 3")
    assert bars[2].startswith("[####################]")
    assert end == ""
    assert "\n" not in written


@pytest.mark.usefixtures("at_once")
def test_lines_are_written_on_request():
    lines = smoothed(True).splitlines()
    assert [line.split(",")[0] for line in lines] == [
        f"laplacian: iteration {number} of at most 3" for number in (1, 2, 3)
    ]
    assert all("0 invalid, q min 0." in line for line in lines)


def test_the_line_and_the_representations_count_hexes_that_are_invalid_between_positive_corners():
    x = UNIT_CUBE.copy()
    x[4:, :2] *= [-2.0, -0.5]  # det J is negative at half the height
    run = hx.iterate(hx.Mesh(x, [range(8)]), "laplacian")
    assert (run.last.inverted, run.last.invalid) == (0, 1)
    assert progress.describe_iteration(run).startswith("1 invalid, q min ")
    assert repr(run).endswith(", 1 invalid>")
    assert repr(run.result().mesh).endswith(", 1 invalid>")


@pytest.mark.usefixtures("at_once")
def test_a_dumb_terminal_shows_no_bar(monkeypatch):
    monkeypatch.setattr(progress, "redraws_lines", lambda: False)
    assert smoothed(stream=Terminal()) == ""


@pytest.mark.usefixtures("at_once")
def test_a_terminal_that_goes_away_stops_no_run():
    class Gone(Terminal):
        def write(self, text):
            raise OSError

    assert smoothed(stream=Gone()) == ""


def test_a_function_gets_each_iteration():
    seen = []
    assert smoothed(watch=seen.append) == ""
    assert [iteration.number for iteration in seen] == [1, 2, 3]
    assert all(isinstance(iteration, hx.Iteration) for iteration in seen)


@pytest.mark.usefixtures("at_once")
@pytest.mark.parametrize("term", ["xterm", "dumb"])
def test_the_bar_is_removed_when_the_run_is_interrupted(monkeypatch, term):
    monkeypatch.setenv("TERM", term)  # of the terminal that runs the tests, which does not matter
    stream = Terminal()

    def interrupt(iteration):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        smoothed(stream=stream, watch=interrupt)
    bar, end = stream.getvalue().split("\r\x1b[2K")[1:]
    assert "laplacian: iteration 1 of at most 3" in bar
    assert end == ""


@pytest.mark.usefixtures("at_once")
def test_a_notebook_shows_a_bar_that_changes_in_place(monkeypatch):
    shown, updated = [], []
    handle = SimpleNamespace(update=lambda data, raw: updated.append(data))
    shell = SimpleNamespace(kernel=object())
    display = SimpleNamespace(display=lambda data, raw, display_id: shown.append(data) or handle)
    monkeypatch.setitem(sys.modules, "IPython", SimpleNamespace(get_ipython=lambda: shell))
    monkeypatch.setitem(sys.modules, "IPython.display", display)
    assert smoothed(stream=Terminal()) == ""
    assert len(shown) == 1
    assert '<progress max="1" value="0.333"' in shown[0]["text/html"]
    assert shown[0]["text/plain"].startswith("laplacian: iteration 1 of at most 3")
    assert [data["text/plain"][:22] for data in updated] == ["laplacian: iteration 2", "laplacian: iteration 3", ""]


@pytest.mark.parametrize("option", [3, "bar", []])
def test_other_values_are_refused(option):
    with pytest.raises(ParameterError, match="expected True, False or None"):
        hx.smooth(MESH, progress=option)
