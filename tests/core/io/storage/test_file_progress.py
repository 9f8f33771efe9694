"""Progress of files: each format tells what it has done, nobody pays who does not watch, and a watcher can end it."""

import contextlib
from pathlib import Path

import numpy as np
import pytest

from hexmend.errors import FileError
from hexmend.gallery import make
from hexmend.io import FORMATS, read, write
from hexmend.io.storage import file_progress
from hexmend.io.storage.file_progress import (
    FileAction,
    FileProgress,
    advance,
    file_operation,
    report,
    stage,
    watch_files,
)

LARGE = [
    (".vtu", "binary"), (".vtu", "ascii"), (".vtkhdf", "binary"), (".vtk", "binary"), (".vtk", "ascii"),
    (".mesh", "ascii"), (".meshb", "binary"), (".msh", "binary"), (".msh", "ascii"), (".exo", "binary"),
]  # fmt: skip


class Cancelled(Exception):
    pass


@pytest.fixture(autouse=True)
def each_report(monkeypatch):
    monkeypatch.setattr(file_progress, "_INTERVAL", 0.0)


@pytest.fixture(scope="module")
def mesh():
    return make("cube", size=20_000, scramble=0.3)


def reports_of(work):
    """Reports while a function works."""
    reports = []
    with watch_files(reports.append):
        work()
    return reports


def check(reports, path, action):
    """Check that reports rise from 0 to 1, some of them between."""
    shares = [one.share for one in reports]
    assert {(one.path, one.action) for one in reports} == {(path, action)}
    assert shares[0] == 0
    assert shares == sorted(shares)
    assert any(0.05 < share < 0.95 for share in shares)
    assert shares[-1] == 1
    assert [one.ended for one in reports] == [False] * (len(reports) - 1) + [True]


@pytest.mark.parametrize(("suffix", "encoding"), LARGE)
def test_large_formats_report_what_is_read_and_written(tmp_path, mesh, suffix, encoding):
    path = tmp_path / f"mesh{suffix}"
    check(reports_of(lambda: write(path, mesh, encoding=encoding)), path, FileAction.WRITING)
    check(reports_of(lambda: read(path)), path, FileAction.READING)


@pytest.mark.parametrize(("suffix", "encoding"), LARGE)
def test_an_exception_of_the_watcher_ends_the_reading_and_is_not_taken_for_damage(tmp_path, mesh, suffix, encoding):
    path, seen = tmp_path / f"mesh{suffix}", []
    write(path, mesh, encoding=encoding)

    def cancel(progress):
        seen.append(progress)
        if progress.share >= 0.3 and not progress.ended:
            raise Cancelled

    with watch_files(cancel), pytest.raises(Cancelled):
        read(path)
    assert seen[-1].ended


@pytest.mark.parametrize("suffix", [".vtu", ".mesh"])
def test_a_writing_that_is_ended_leaves_the_earlier_file(tmp_path, mesh, suffix):
    path = tmp_path / f"mesh{suffix}"
    path.write_bytes(b"earlier")

    def cancel(progress):
        if progress.share > 0.3 and not progress.ended:
            raise Cancelled

    with watch_files(cancel), pytest.raises(Cancelled):
        write(path, mesh)
    assert path.read_bytes() == b"earlier"
    assert [entry.name for entry in tmp_path.iterdir()] == [path.name]


@pytest.mark.parametrize("suffix", [".vtu", ".meshb", ".exo"])
def test_a_damaged_file_ends_its_progress_with_the_error_of_one_that_nobody_watches(tmp_path, mesh, suffix):
    path = tmp_path / f"mesh{suffix}"
    write(path, mesh)
    path.write_bytes(path.read_bytes()[: path.stat().st_size * 2 // 3])
    with pytest.raises(FileError) as alone:
        read(path)
    reports = []
    with watch_files(reports.append), pytest.raises(FileError) as watched:
        read(path)
    assert str(watched.value) == str(alone.value)
    assert [one.ended for one in reports][-1:] == [True]
    assert reports[-1].share < 1


def test_stages_divide_the_work_and_what_is_done_never_falls():
    reports = []
    with watch_files(reports.append), file_operation(Path("a"), FileAction.READING):
        with stage(0.0, 0.5):
            report(1, 2)
            with stage(0.5, 1.0):
                advance(1, 4)
                advance(1, 4)
            report(1, 4)
        report(0.9)
        with file_operation(Path("b"), FileAction.WRITING):  # a part of the first
            report(0.95)
    shares = [one.share for one in reports]
    np.testing.assert_allclose(shares, sorted(shares))
    for share in (0.25, 0.3125, 0.375, 0.9, 0.95, 1.0):
        assert np.isclose(shares, share).any(), share
    assert {one.path for one in reports} == {Path("a")}


PHRASES = [
    (0.0, 3.0, "0%"),
    (0.01, 3.0, "1%"),
    (0.5, 2.0, "50%, 2 s left"),
    (0.4, 0.2, "40%, 1 s left"),
    (0.1, 60.0, "10%, 9 min left"),
    (1.0, 5.0, "100%, 0 s left"),
]


@pytest.mark.parametrize(("share", "seconds", "phrase"), PHRASES)
def test_the_phrase_gives_share_and_time_left(share, seconds, phrase):
    assert FileProgress(Path("a"), FileAction.READING, share, seconds).phrase == phrase


def test_progress_may_be_watched_in_every_format(tmp_path, mesh):
    small = make("cube", size=8)
    for format in FORMATS.values():
        if format.write is None or format.place:
            continue
        path = tmp_path / f"small{format.suffixes[0]}"
        with contextlib.suppress(FileError):
            assert reports_of(lambda path=path: write(path, small))[-1].ended
            assert reports_of(lambda path=path: read(path))[-1].share == 1
