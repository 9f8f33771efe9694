"""ExodusII files for tests, written by SciPy, and a mesh with all kinds of data."""

import numpy as np

from hexmend import Cells, Mesh
from tests.core.grids import grid

#: Twice the coordinates of a HEX27's nodes in the unit cube, from the manual's figure, from node 1.
HEX27 = np.array(
    [
        [0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [0, 0, 2], [2, 0, 2], [2, 2, 2], [0, 2, 2],
        [1, 0, 0], [2, 1, 0], [1, 2, 0], [0, 1, 0], [0, 0, 1], [2, 0, 1], [2, 2, 1], [0, 2, 1],
        [1, 0, 2], [2, 1, 2], [1, 2, 2], [0, 1, 2], [1, 1, 1], [1, 1, 0], [1, 1, 2], [0, 1, 1],
        [2, 1, 1], [1, 0, 1], [1, 2, 1],
    ]
)  # fmt: skip
#: Nodes of a hex's sides 1 to 6, from the manual.
SIDES = [[1, 2, 6, 5], [2, 3, 7, 6], [3, 4, 8, 7], [1, 5, 8, 4], [1, 4, 3, 2], [5, 6, 7, 8]]


def letters(words):
    return np.array([list(word.ljust(33, "\0").encode()) for word in words], np.uint8).view("S1").reshape(-1, 33)


def written(path, points, blocks, more=(), title="by another library"):
    """Write a file by SciPy's NetCDF: blocks are (type, name, nodes from 1), more (name, dimensions, values)."""
    from scipy.io import netcdf_file

    with netcdf_file(path, "w", version=2) as file:
        file.title = title
        file.createDimension("time_step", None)
        lengths = {"len_name": 33, "num_dim": 3, "num_nodes": len(points), "num_el_blk": len(blocks)}
        lengths["num_elem"] = sum(len(nodes) for _, _, nodes in blocks)
        for name, length in lengths.items():
            file.createDimension(name, length)
        variables = [(f"coord{c}", ("num_nodes",), points[:, k].astype(float)) for k, c in enumerate("xyz")]
        variables.append(("eb_names", ("num_el_blk", "len_name"), letters([name for _, name, _ in blocks])))
        for k, (_, _, nodes) in enumerate(blocks, 1):
            nodes = np.asarray(nodes, np.int32)
            for name, length in zip((f"num_el_in_blk{k}", f"num_nod_per_el{k}"), nodes.shape, strict=True):
                file.createDimension(name, length)
            variables.append((f"connect{k}", (f"num_el_in_blk{k}", f"num_nod_per_el{k}"), nodes))
        for name, dimensions, values in [*variables, *more]:
            values = np.asarray(values)
            for one, length in zip(dimensions, values.shape, strict=True):
                if one not in file.dimensions:
                    file.createDimension(one, length)
            kind = {"S": "c", "i": "i", "f": "d"}[values.dtype.kind]
            file.createVariable(name, kind, dimensions)[:] = values
        for k, (kind, _, _) in enumerate(blocks, 1):
            file.variables[f"connect{k}"].elem_type = kind
    return path


def rich() -> Mesh:
    bare = grid(2)
    return bare.replace(
        node_data={"id": np.arange(27) + 2**30, "v": np.random.default_rng(1).normal(size=(27, 3))},
        hex_data={"id": np.arange(8)[::-1] + 3, "tensor": np.arange(48.0).reshape(8, 6)},
        node_sets={"wall": np.array([0, 26])},
        hex_sets={"a": np.array([0, 1, 2]), "b": np.array([3, 4]), "scattered": np.array([0, 4, 7])},
        side_sets={"in": np.array([[0, 0], [2, 0]]), "out": np.array([[7, 5], [1, 2]])},
        cells=(Cells("quad", bare.hexes[:2, :4], {"t": np.array([1.5, 2])}, {"lid": np.array([1])}),),
        pinned=np.arange(27) == 13,
    )


def on_hdf5(source, path, **options):
    """The file on HDF5, as netCDF4 writes it; `options` are of the coordinates' datasets."""
    import netCDF4

    with netCDF4.Dataset(source) as one, netCDF4.Dataset(path, "w") as other:
        one.set_auto_mask(False)
        other.setncatts({name: one.getncattr(name) for name in one.ncattrs()})
        for name, dimension in one.dimensions.items():
            other.createDimension(name, None if dimension.isunlimited() else len(dimension))
        for name, variable in one.variables.items():
            kind = options.get("kind", variable.dtype) if name.startswith("coord") else variable.dtype
            zlib = bool(options.get("zlib")) and name.startswith("coord")
            copy = other.createVariable(name, kind, variable.dimensions, zlib=zlib)
            copy.setncatts({key: variable.getncattr(key) for key in variable.ncattrs()})
            copy[:] = variable[:]
