"""Coordinates of an ExodusII file: its variables coordx, coordy and coordz, or coord."""

from __future__ import annotations

from pathlib import Path

from hexmend.io.coordinates.binary_coordinates import BinaryCoordinates, BinaryPiece
from hexmend.io.coordinates.hdf5_coordinates import describe_dataset, locate_datasets
from hexmend.io.coordinates.located import LocatedCoordinates
from hexmend.io.formats.exodus.netcdf3 import ClassicReader, is_classic
from hexmend.io.formats.exodus.reader import points
from hexmend.io.formats.exodus.store import ExodusStore, open_store
from hexmend.io.storage import subprocess_reader


def locate(path: Path) -> LocatedCoordinates:
    """Find the coordinates of a file that the reader has accepted."""
    if is_classic(path):
        return _classic(path)
    found = subprocess_reader.run_reader(f"{__name__}:datasets", path)
    return locate_datasets(path, found["points"], found["datasets"])


def datasets(path: Path) -> dict[str, object]:
    """Read the coordinates of a file on HDF5 and describe their datasets; run in a subprocess."""
    with open_store(path) as store:
        columns = _columns(store)
        described = [describe_dataset(store.dataset(name), first, width) for name, (first, width) in columns.items()]
        return {"points": points(path, store), "datasets": described}


def _classic(path: Path) -> BinaryCoordinates:
    store, pieces = ClassicReader(path), []
    found = points(path, store)
    for name, (first, width) in _columns(store).items():
        variable = store.variable(name)
        strides = (variable.dtype.itemsize, variable.dtype.itemsize * len(found))
        columns = slice(first, first + width)
        pieces.append(BinaryPiece(variable.begin, variable.dtype, strides, slice(0, len(found)), columns))
    return BinaryCoordinates(path, found, tuple(pieces))


def _columns(store: ExodusStore) -> dict[str, tuple[int, int]]:
    """First column and number of columns of each variable with coordinates."""
    width = store.dimensions.get("num_dim", 3)
    return {"coord": (0, width)} if "coord" in store else {f"coord{'xyz'[k]}": (k, 1) for k in range(width)}
