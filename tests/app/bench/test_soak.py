"""Soak test: rounds in a window, and the detection of growing memory."""

from __future__ import annotations

import json
import os
import signal

import numpy as np
import pytest

from hexmend.cli.main import main
from hexmend.errors import FileError
from hexmend.gallery import make
from hexmend.io import write
from hexmend_app.bench.soak import Memory, Sample, soak


def memory(mb):
    found = Memory()
    for k, one in enumerate(mb):
        found.add(Sample(k + 1, 0.5 * k, "a.vtu", "mend", float(one)))
    return found


def test_level_memory_after_warm_up_passes():
    mb = np.concatenate([np.linspace(300, 700, 20), 700 + 30 * np.random.default_rng(0).normal(size=100)])
    assert memory(mb).level
    assert "level" in memory(mb).verdict
    assert "median 7" in memory(mb).verdict


def test_growing_memory_fails():
    leaking = memory(600 + np.arange(120) + 30 * np.random.default_rng(0).normal(size=120))
    assert not leaking.level
    assert "GROWS" in leaking.verdict
    assert leaking.growth == pytest.approx(90, abs=25)


@pytest.mark.slow
def test_an_unreadable_mesh_ends_the_test(qapp, tmp_path):
    with pytest.raises(FileError, match=r"none\.vtu"):
        list(soak([tmp_path / "none.vtu"], 0))


def test_memory_that_cannot_be_measured_is_reported_at_once(qapp, monkeypatch, capsys):
    def unknown():
        raise OSError

    monkeypatch.setattr("hexmend_app.cli.soak.memory_check.resident_mb", unknown)
    assert main(["soak", "--minutes", "0"]) != 0
    assert "soak needs a system with /proc" in capsys.readouterr().err


@pytest.mark.slow
def test_the_command_works_in_a_window_and_writes_every_round(qapp, tmp_path, capsys):
    write(tmp_path / "small.vtu", make("five-side", size=300, scramble=0.3))
    code = main(["soak", str(tmp_path / "small.vtu"), "--minutes", "0", "--json", str(tmp_path / "soak.json")])
    report = json.loads((tmp_path / "soak.json").read_text())
    assert code == (0 if report["level"] else 1)
    assert len({one["method"] for one in report["rounds"]}) == 4
    assert all(one["mb"] > 10 for one in report["rounds"])
    assert f"{report['growth_mb']:+.0f} MB" in capsys.readouterr().out


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_it_after_the_round_with_what_was_measured(qapp, tmp_path, monkeypatch, capsys, number):
    def rounds(meshes, seconds):
        for sample in (Sample(1, 0.5, "a.vtu", "mend", 300.0), Sample(2, 1.0, "a.vtu", "mend", 300.0)):
            os.kill(os.getpid(), number)
            yield sample

    monkeypatch.setattr("hexmend_app.bench.soak.soak", rounds)
    assert main(["soak", "--json", str(tmp_path / "soak.json")]) == 128 + number
    assert len(json.loads((tmp_path / "soak.json").read_text())["rounds"]) == 1
    assert "1 rounds in" in capsys.readouterr().out
