"""Sessions that earlier versions wrote are read whole."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from hexmend_app.state import session_data

_FILES = Path(__file__).parent / "files"


@pytest.mark.parametrize("version", [1, 2])
def test_a_session_of_an_earlier_version_is_read_with_its_run(version):
    data = session_data.read(_FILES / f"version_{version}.hexmend")
    (record,) = data.history.records
    assert record.rows[-1]["iteration"] == 3
    assert record.advice.limiting.dtype == np.int64
    assert record.advice.why.startswith("Stopped at the limit of 3 iterations")


def test_a_session_that_is_read_is_written_as_it_was(tmp_path):
    data = session_data.read(_FILES / "version_2.hexmend")
    session_data.write(tmp_path / "again.hexmend", data)
    again = session_data.read(tmp_path / "again.hexmend")
    assert again.history.records[0].advice.why == data.history.records[0].advice.why
    np.testing.assert_array_equal(again.document.now.mesh.points, data.document.now.mesh.points)
