"""Coordinates of a MED file: the dataset COO of its first mesh."""

from __future__ import annotations

from pathlib import Path

from hexmend.io.coordinates.hdf5_coordinates import describe_dataset, locate_datasets
from hexmend.io.coordinates.located import LocatedCoordinates
from hexmend.io.formats.med.reader import first_step, open_med, read_points
from hexmend.io.storage import subprocess_reader


def locate(path: Path) -> LocatedCoordinates:
    """Find the coordinates of a file that the reader has accepted."""
    found = subprocess_reader.run_reader(f"{__name__}:datasets", path)
    return locate_datasets(path, found["points"], found["datasets"], tuple(found["notes"]))


def datasets(path: Path) -> dict[str, object]:
    """Read the coordinates of the first step of the first mesh and describe their dataset; run in a subprocess."""
    with open_med(path) as file:
        notes, name = [], next(iter(file["ENS_MAA"]))
        mesh = first_step(path, name, file["ENS_MAA"][name], notes)
        notes = ["Only the first step of the mesh gets new coordinates."] if notes else []
        return {
            "points": read_points(path, mesh),
            "datasets": [describe_dataset(mesh["NOE"]["COO"], 0, 3)],
            "notes": notes,
        }
