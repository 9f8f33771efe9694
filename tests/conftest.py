"""What all tests share."""

import gc
import os
import signal
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from hypothesis import settings

from tests.guards import temporary_files_go, threads_end

os.environ.setdefault("QT_API", "pyside6")
os.environ.setdefault("PYQTGRAPH_QT_LIB", "PySide6")
if sys.platform == "linux":
    os.environ["QT_QPA_PLATFORM"] = "xcb"  # 3D needs a screen: pytest-xvfb makes one, and Wayland's is left alone

# A shell lets what it runs in the background ignore Ctrl-C, and so would the programs that tests start and end by it.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

# `make test` and `make test-slow` draw the same examples each time, however loaded the machine is; `make soak` draws others.
settings.register_profile("quick", deadline=None, database=None, derandomize=True, max_examples=10)
settings.register_profile("slow", settings.get_profile("quick"), max_examples=40)
settings.register_profile("soak", settings.get_profile("quick"), derandomize=False, max_examples=400, print_blob=True)
settings.load_profile("quick")

#: Seconds after which a slow test is ended; pyproject.toml has those of the others.
SLOW_TIMEOUT = 600

#: Objects more than were deleted from which on a test that is over looks for garbage.
GARBAGE = 20_000

_REAL = Path(os.environ.get("HEXMEND_MESHES") or Path(__file__).resolve().parents[2] / "shared" / "meshes")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Let slow tests take longer, where no other time is asked for."""
    for item in items:
        if item.get_closest_marker("slow") and config.getoption("timeout") is None:
            item.add_marker(pytest.mark.timeout(SLOW_TIMEOUT))


def pytest_collection_finish() -> None:
    """Look for garbage in what tests make alone: a look at modules and thousands of tests takes a third of a second."""
    gc.freeze()


@pytest.fixture(scope="session", autouse=True)
def terminal() -> Iterator[None]:
    """Let programs that tests start, and this one, find the same terminal wherever the tests are run."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("TERM", "xterm")
        for name in ("COLUMNS", "LINES", "NO_COLOR", "FORCE_COLOR"):
            patch.delenv(name, raising=False)
        yield


@pytest.fixture
def run_command(capsys) -> Callable[..., object]:
    """Run a command of `hexmend` in this process, which ends with `status`; what it printed since the last: `out` and `err`."""
    from hexmend.cli.main import main

    def run(*words: object, status: int = 0):
        assert main([str(word) for word in words]) == status
        return capsys.readouterr()

    return run


@pytest.fixture
def complaint(run_command) -> Callable[..., str]:
    """Run a command that is refused; the one line that it says of that."""

    def run(*words: object, status: int = 2) -> str:
        (line,) = run_command(*words, status=status).err.splitlines()
        return line

    return run


@pytest.fixture(scope="session")
def real_mesh() -> Callable[[str], Path]:
    """The path of one of the real meshes; the test is skipped where they are absent."""

    def find(name: str) -> Path:
        path = _REAL / name
        if not path.exists():
            pytest.skip(f"the real mesh {name} is not in {_REAL}; the variable HEXMEND_MESHES names another folder")
        return path

    return find


@pytest.fixture(scope="session")
def temporary_folder(tmp_path_factory) -> Iterator[Path]:
    """Where temporary files go that are not asked of pytest, by this process and those that it starts."""
    folder = tmp_path_factory.mktemp("temporary")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("TMPDIR", str(folder))
        patch.setattr(tempfile, "tempdir", None)
        patch.setenv("HEXMEND_STATE", str(tmp_path_factory.mktemp("state")))  # and what windows leave
        yield folder


@pytest.fixture(autouse=True)
def nothing_is_left_behind(temporary_folder) -> Iterator[None]:
    """A test that leaves a thread running or temporary files lying about fails."""
    with threads_end(), temporary_files_go(temporary_folder):
        yield
    # Where there are windows, which look for garbage themselves while they wait, Python does not.
    if not gc.isenabled() and gc.get_count()[0] > GARBAGE:
        gc.collect(1)
