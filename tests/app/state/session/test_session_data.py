"""Sessions of earlier versions are read completely."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from hexmend.errors import FileError
from hexmend.iteration import StoppingCriteria
from hexmend.run.recipe import Stage
from hexmend.smoothers import METHODS
from hexmend_app.codec import codec
from hexmend_app.formats.session import session_file
from hexmend_app.formats.session.archive import read_archive, write_archive
from hexmend_app.state.run.run_setup import RunSetupData
from hexmend_app.state.session import session_data
from tests.app.state.session.former_look import former_look, without_later_fields

_FILES = Path(__file__).parent / "files"


@pytest.mark.parametrize("version", [1, 2])
def test_a_session_of_an_earlier_version_is_read_with_its_run(version):
    data = session_data.read(_FILES / f"version_{version}.hexmend")
    (record,) = data.history.records
    assert record.rows[-1]["iteration"] == 3
    assert record.advice.limiting.dtype == np.int64
    assert record.advice.reason.startswith("Stopped at the limit of 3 iterations")


@pytest.mark.parametrize("version", [6, 7])
def test_a_session_of_version_6_and_7_is_read_with_its_run(version):
    data = session_data.read(_FILES / f"version_{version}.hexmend")
    (record,) = data.history.records
    assert len(record.rows) == 3
    assert record.settings == {6: "", 7: "max_iterations=2, keep_last=True"}[version]
    assert [change.title for change in data.document.changes] == ["open", "tag", "Laplacian"]


def test_a_session_of_version_6_without_files_is_read(tmp_path):
    version, content = read_archive(_FILES / "version_6.hexmend", "Hexmend session", session_file.VERSION)
    del content["window"]["document"]["files"]
    write_archive(tmp_path / "first.hexmend", "Hexmend session", version, content)
    assert session_data.read(tmp_path / "first.hexmend").document.files is None


@pytest.mark.parametrize("place", [
    ("history",),
    ("history", "records", 0, "advice"),
    ("history", "records", 0, "offsets", 0),
    ("history", "records", 0, "pauses"),
    ("view", "look", "scale"),
    ("choices", "cut"),
])  # fmt: skip
@pytest.mark.parametrize("damage", [np.zeros(3), [[1, 2]], [1, 2]])
def test_data_of_another_type_are_reported(tmp_path, place, damage):
    version, content = read_archive(_FILES / "version_3.hexmend", "Hexmend session", session_file.VERSION)
    part = content["window"]
    for key in place[:-1]:
        part = part[key]
    part[place[-1]] = damage
    write_archive(tmp_path / "damaged.hexmend", "Hexmend session", version, content)
    with pytest.raises(FileError, match="inconsistent: the window"):
        session_data.read(tmp_path / "damaged.hexmend")


def test_a_proposed_box_that_is_no_box_is_reported(tmp_path):
    version, content = read_archive(_FILES / "version_3.hexmend", "Hexmend session", session_file.VERSION)
    content["window"]["choices"]["cut"]["box"]["low"] = [float("nan"), 0.0, 0.0]
    write_archive(tmp_path / "damaged.hexmend", "Hexmend session", version, content)
    with pytest.raises(FileError, match="inconsistent: the window"):
        session_data.read(tmp_path / "damaged.hexmend")


def test_a_session_is_unchanged_by_reading_and_writing_it(tmp_path):
    data = session_data.read(_FILES / "version_2.hexmend")
    session_data.write(tmp_path / "again.hexmend", data)
    again = session_data.read(tmp_path / "again.hexmend")
    assert again.history.records[0].advice.reason == data.history.records[0].advice.reason
    np.testing.assert_array_equal(again.document.now.mesh.points, data.document.now.mesh.points)


@pytest.mark.parametrize(("version", "read"), [(3, "unlimited"), (4, 0.0)])
def test_a_surface_tolerance_of_0_means_no_limit_up_to_version_3(tmp_path, monkeypatch, version, read):
    data = session_data.read(_FILES / "version_2.hexmend")
    stage = Stage(METHODS["mend"](boundary="slide", surface_tolerance=0))
    data = dataclasses.replace(data, run_setup=dataclasses.replace(data.run_setup, stage=stage))
    fields = codec._fields
    monkeypatch.setattr(codec, "_fields", lambda kind, of=version: fields(kind, of))  # as that version wrote them
    monkeypatch.setattr(session_file, "VERSION", version)
    session_data.write(tmp_path / "old.hexmend", data)
    monkeypatch.undo()
    _, content = read_archive(tmp_path / "old.hexmend", "Hexmend session", version)
    content["window"]["view"]["look"] = former_look()
    write_archive(tmp_path / "old.hexmend", "Hexmend session", version, without_later_fields(content))
    assert session_data.read(tmp_path / "old.hexmend").run_setup.stage.smoother.surface_tolerance == read


def test_values_of_version_0_1_are_stored_by_current_parameter_names():
    stage = Stage(METHODS["mend"](), StoppingCriteria())
    setup = RunSetupData(stage, "", {"mend": {"softness": 0.05, "highest_p": 4.0}, "general": {"sufficient": 0.5}})
    assert setup.values == {"mend": {"initial_epsilon": 0.05, "max_p": 4.0}, "general": {"q_target": 0.5}}
