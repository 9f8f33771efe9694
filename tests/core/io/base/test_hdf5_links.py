"""Files on HDF5 that name other files: nothing outside of the file that is named is opened."""

import itertools

import numpy as np
import pytest

from hexmend import FileError, io
from tests.core.grids import grid
from tests.core.io.formats.cgns.cgns_files import cgns, structured
from tests.core.io.formats.vtk.test_vtkhdf import hand_made

h5py = pytest.importorskip("h5py")

SECRET = np.arange(1000.0)


def med(path, change):
    io.write(path, grid(2))
    with h5py.File(path, "r+") as file:
        step = next(iter(file["ENS_MAA"].values()))
        change(next(iter(step.values()))["NOE"], "COO", (81,))


def exodus(path, change):
    """What an Exodus file on HDF5 has at least, and coordinates that `change` makes."""
    mesh = grid(2)
    with h5py.File(path, "w") as file:
        counts = {"num_nodes": 27, "num_elem": 8, "num_el_blk": 1, "num_dim": 3, "num_el_in_blk1": 8}
        for name, count in {**counts, "num_nod_per_el1": 8}.items():
            file[name] = np.zeros(count)
            file[name].make_scale(name)
        file["eb_prop1"] = [1]
        file["connect1"] = mesh.hexes + 1
        file["connect1"].attrs["elem_type"] = "HEX8"
        for axis, name in enumerate(("coordx", "coordy", "coordz")):
            file[name] = mesh.points[:, axis]
        change(file, "coordz", (27,))


def on_cgns(path, change):
    points = np.stack(np.meshgrid(*[np.arange(3.0)] * 3, indexing="ij"), axis=-1)
    with cgns(path) as base:
        zone = structured(base, "Zone", points)
        change(zone.group["GridCoordinates/CoordinateX"], " data", (3, 3, 3))


def vtkhdf(path, change):
    hand_made(path, lambda root: change(root, "Points", (8, 3)), parts=1)


FORMATS = {".med": med, ".exo": exodus, ".cgns": on_cgns, ".vtkhdf": vtkhdf}
formats = pytest.mark.parametrize("suffix", FORMATS)


def without_change(group, name, shape):
    pass


def external_link(group, name, shape):
    del group[name]
    group[name] = h5py.ExternalLink("other.h5", "/secret")


def external_storage(group, name, shape):
    del group[name]
    group.create_dataset(name, shape, "f8", external=[("other.raw", 0, h5py.h5f.UNLIMITED)])


def virtual_dataset(group, name, shape):
    del group[name]
    layout = h5py.VirtualLayout(shape, "f8")
    layout[...] = h5py.VirtualSource("other.h5", "secret", shape)
    group.create_virtual_dataset(name, layout)


def virtual_dataset_of_this_file(group, name, shape):
    group.move(name, "source")
    layout = h5py.VirtualLayout(shape, "f8")
    layout[...] = h5py.VirtualSource(".", f"{group.name}/source", shape)
    group.create_virtual_dataset(name, layout)


def linked_group_that_is_not_read(group, name, shape):
    group.file["notes"] = h5py.ExternalLink("other.h5", "/")


def external_link_behind_a_soft_link(group, name, shape):
    del group[name]
    group.file["elsewhere"] = h5py.ExternalLink("other.h5", "/")
    group[name] = h5py.SoftLink("/elsewhere/secret")


WAYS_OUT = {
    external_link: r"'.+' is an external link to '/secret' in the file 'other\.h5'",
    external_storage: r"'.+' has its values in another file, 'other\.raw' \(external storage\)",
    virtual_dataset: r"'.+' is a virtual dataset with data in the file 'other\.h5'",
    virtual_dataset_of_this_file: r"'.+' is a virtual dataset with data in the file '\.'",
    linked_group_that_is_not_read: r"'notes' is an external link to '/' in the file 'other\.h5'",
    external_link_behind_a_soft_link: r"'elsewhere' is an external link to '/' in the file 'other\.h5'",
}


@formats
def test_a_file_that_names_no_other_is_read(suffix, tmp_path):
    FORMATS[suffix](tmp_path / f"a{suffix}", without_change)
    assert io.read(tmp_path / f"a{suffix}").n_hexes in (1, 8)


@pytest.mark.parametrize(
    ("suffix", "change"),
    [*zip(itertools.cycle(FORMATS), WAYS_OUT), *((suffix, external_link) for suffix in [*FORMATS][1:])],
)
def test_what_leads_out_of_the_file_is_refused_with_its_name(suffix, change, tmp_path):
    with h5py.File(tmp_path / "other.h5", "w") as other:
        other["secret"] = SECRET
    (tmp_path / "other.raw").write_bytes(SECRET.tobytes())
    FORMATS[suffix](tmp_path / f"a{suffix}", change)
    with pytest.raises(FileError, match=f"a{suffix}: its {WAYS_OUT[change]}: no other file is opened"):
        io.read(tmp_path / f"a{suffix}")


def test_a_link_that_a_program_has_defined_is_refused(tmp_path):
    path = tmp_path / "a.cgns"
    on_cgns(path, external_link)
    data = path.read_bytes()
    at = data.rindex(b"\x40", 0, data.index(b"other.h5\0/secret"))  # the type of the link, before its name
    path.write_bytes(data[:at] + b"\x41" + data[at + 1 :])
    with pytest.raises(FileError, match=r"its 'Base/.+' is a link of the type 65, which a program has defined"):
        io.read(path)


@formats
def test_a_soft_link_inside_the_file_is_followed(suffix, tmp_path):
    def soft(group, name, shape):
        group.move(name, "/moved")
        group[name] = h5py.SoftLink("/moved")

    FORMATS[suffix](tmp_path / f"a{suffix}", soft)
    FORMATS[suffix](tmp_path / f"b{suffix}", without_change)
    linked, plain = io.read(tmp_path / f"a{suffix}"), io.read(tmp_path / f"b{suffix}")
    np.testing.assert_array_equal(linked.points, plain.points)


OF_ANOTHER_FORMAT = [
    (".med", "holds no mesh"),
    (".vtkhdf", "no group VTKHDF"),
    (".cgns", "no CGNSBase_t"),
    (".exo", "no dimension num_nodes"),
]


@pytest.mark.parametrize(("suffix", "words"), OF_ANOTHER_FORMAT)
def test_hdf5_of_another_format_is_not_called_damaged(suffix, words, tmp_path):
    with h5py.File(tmp_path / f"a{suffix}", "w") as file:
        file["numbers"] = [1, 2, 3]
    with pytest.raises(FileError, match=words) as caught:
        io.read(tmp_path / f"a{suffix}")
    assert "damaged" not in str(caught.value)
