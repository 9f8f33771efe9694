"""Guards against leaks fail a test that leaves a thread, a file or a window."""

import ast
import threading
import tomllib

import pytest
from hypothesis import settings

from tests import guards
from tests.examples import ROOT
from tests.guards import temporary_files_go, threads_end, windows_close
from tests.patience import PATIENCE


def test_a_thread_that_is_left_running_is_an_error(monkeypatch):
    monkeypatch.setattr(guards, "GRACE", 0.05)
    over = threading.Event()
    with pytest.raises(pytest.fail.Exception, match="left alone"), threads_end():
        thread = threading.Thread(target=over.wait, name="left alone")
        thread.start()
    over.set()
    thread.join()


def test_a_file_that_is_left_is_an_error(tmp_path):
    with (
        pytest.raises(pytest.fail.Exception, match=r"temporary files are left: left\.txt"),
        temporary_files_go(tmp_path),
    ):
        (tmp_path / "left.txt").touch()
    assert not list(tmp_path.iterdir())


def test_a_window_that_is_left_open_is_an_error(qtbot):
    from PySide6.QtWidgets import QDialog

    with pytest.raises(pytest.fail.Exception, match="'Open still'"), windows_close():
        dialog = QDialog()
        dialog.setWindowTitle("Open still")
        dialog.show()
    qtbot.addWidget(dialog)


# No test asks how much time passes: each waits for an event, with one limit.


#: Methods of qtbot that wait for an event: those of `BLOCKS` do so where a block ends.
BLOCKS = "waitExposed", "waitActive", "waitSignal"
WAITING = "waitUntil", "waitSignals", "waitCallback", *BLOCKS
TREES = {path: ast.parse(path.read_text(encoding="utf-8")) for path in sorted((ROOT / "tests").rglob("*.py"))}


def calls(node):
    """Return calls of methods within a node, by name."""
    return [(one.func.attr, one) for one in ast.walk(node) if isinstance(one, ast.Call) and hasattr(one.func, "attr")]


def test_all_who_wait_for_an_event_of_qt_have_the_patience_of_the_fixture():
    hasty = []
    for path, tree in TREES.items():
        for name, call in calls(tree):
            if name in WAITING and any(one.arg == "timeout" for one in call.keywords):
                hasty.append(f"{path.relative_to(ROOT)}:{call.lineno}: {name}")
    assert hasty == []


def test_no_wait_is_without_a_block_and_none_is_for_time():
    wrong = []
    for path, tree in TREES.items():
        statements = [
            one.value for one in ast.walk(tree) if isinstance(one, ast.Expr) and isinstance(one.value, ast.Call)
        ]
        wrong += [(path, one) for one in statements if getattr(one.func, "attr", "") in BLOCKS]
        for name, call in calls(tree):
            if (name == "wait" and ast.unparse(call.func.value) == "qtbot") or any(
                one.arg == "wait" for one in call.keywords
            ):
                wrong.append((path, call))
    assert [f"{path.relative_to(ROOT)}:{call.lineno}: {ast.unparse(call)}" for path, call in wrong] == []


def test_a_test_that_waits_in_vain_fails_before_it_is_ended():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    assert project["tool"]["pytest"]["ini_options"]["timeout"] > PATIENCE / 1000


@pytest.mark.parametrize("name", ["quick", "slow"])
def test_examples_are_the_same_each_time(name):
    profile = settings.get_profile(name)
    assert profile.derandomize
    assert profile.database is None
