"""Mesh files in folders."""

import pytest

from hexmend import FileError, io
from hexmend.gallery import make
from hexmend.study.batch.mesh_files import find_meshes


def test_meshes_are_found_in_subfolders_and_cases_are_one_mesh(tmp_path):
    cube = make("cube", size=8)
    (tmp_path / "b").mkdir()
    io.write(tmp_path / "b/cube.vtu", cube)
    io.write(tmp_path / "a.msh", cube)
    (tmp_path / ".hidden").mkdir()
    io.write(tmp_path / ".hidden/cube.vtu", cube)
    case = tmp_path / "case"
    (case / "constant/polyMesh").mkdir(parents=True)
    for name in ("points", "faces", "owner", "neighbour", "boundary"):
        (case / "constant/polyMesh" / name).touch()
    named = tmp_path / "a.msh"
    assert find_meshes([tmp_path, named]) == [tmp_path / "a.msh", tmp_path / "b/cube.vtu", case]
    (tmp_path / "empty").mkdir()
    with pytest.raises(FileError, match="no mesh is in this folder"):
        find_meshes([tmp_path / "empty"])


def test_pieces_of_a_file_are_no_meshes_of_their_own(tmp_path):
    io.write(tmp_path / "whole.pvtu", make("cube", size=8))
    io.write(tmp_path / "whole" / "other.vtu", make("cube", size=8))
    (tmp_path / "torn.pvtu").write_text("<VTKFile")
    names = [str(path.relative_to(tmp_path)) for path in find_meshes([tmp_path])]
    assert names == ["torn.pvtu", "whole/other.vtu", "whole.pvtu"]
    assert find_meshes([tmp_path / "whole" / "whole_0.vtu"]) == [tmp_path / "whole" / "whole_0.vtu"]
