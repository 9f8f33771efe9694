"""Data of a session, and reading and writing of session files."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from hexmend.errors import FileError, HexmendError, MeshError
from hexmend.io.storage.atomic import atomic_write
from hexmend.mesh.mesh import Mesh
from hexmend.parameters import from_values
from hexmend.quality import measure
from hexmend.smoothers import METHODS, Smoother
from hexmend_app.codec.conversion import Hooks, decode, encode
from hexmend_app.formats.session import SUFFIX, is_session
from hexmend_app.formats.session.session_file import read_session, write_session
from hexmend_app.picture.camera import NamedCameras
from hexmend_app.state.mesh.document import DocumentData, MeasuredMesh
from hexmend_app.state.mesh.history import HistoryData
from hexmend_app.state.mesh.selection import SelectionData
from hexmend_app.state.run.breakpoints import NONE, Breakpoints
from hexmend_app.state.run.comparison import ComparisonData
from hexmend_app.state.run.run_setup import RecipeDraftData, RunSetupData
from hexmend_app.state.view.side_views import SideViewsData, Snapshot
from hexmend_app.state.view.view_model import ViewData

#: First bytes of a session file.
_HEAD = 64


@dataclass(frozen=True, eq=False)
class SessionData:
    """Data of the parts of a session, by their names there; each part makes its data and restores itself from them."""

    document: DocumentData
    history: HistoryData
    timeline: int | None  # number of the selected run
    view: ViewData
    selection: SelectionData
    snapshots: tuple[Snapshot, ...]
    side_views: SideViewsData
    comparison: ComparisonData
    run_setup: RunSetupData
    recipe_draft: RecipeDraftData
    run: Breakpoints
    saved_cameras: NamedCameras
    feature_states: dict[str, Any]  # encoded, by the names that `StatePart` gives them

    def __post_init__(self) -> None:
        mesh = self.document.now.mesh
        hexes, nodes = mesh.n_elements, mesh.n_nodes
        for state in self._compared():
            if state.mesh.elements is not mesh.elements:
                raise ValueError("it compares the mesh with states of another mesh")
        self.view.check(hexes)
        self.selection.check(hexes, nodes)
        for snapshot in self.snapshots:
            snapshot.check(hexes, nodes)
        for number, count in ((self.run.hex, hexes), (self.run.node, nodes)):
            if number != NONE and number >= count:
                raise ValueError(f"a breakpoint is at hex or node {number}, of which there are {count}")
        if not 0 <= (self.timeline or 0) < max(len(self.history.records), self.timeline is None):
            raise ValueError(f"there is no run {self.timeline}")

    def states(self) -> Iterator[MeasuredMesh]:
        """Yield every complete state of the mesh: the shown state first, then the states of changes and comparisons."""
        yield self.document.now
        yield from (change.state for change in self.document.changes)
        yield from self._compared()

    def _compared(self) -> Iterator[MeasuredMesh]:
        """Yield the states that must have the hexes of the open mesh."""
        yield from (side_view.state for side_view in self.side_views.shown)
        yield from (record.start for record in self.history.records)
        yield from (record.end for record in self.history.records if record.end is not None)
        yield from (result.state for result in self.comparison.results if result.state is not None)
        if self.comparison.initial is not None:
            yield self.comparison.initial


def is_session_file(path: Path) -> bool:
    """Return True if a file is a session by its suffix, or else by its first bytes."""
    if path.suffix.lower() == SUFFIX:
        return True
    try:
        with open(path, "rb") as file:
            return is_session(file.read(_HEAD))
    except (OSError, ValueError):  # the reader reports why the file cannot be read
        return False


def write(path: Path, data: SessionData) -> None:
    """Write a session file; if that fails, an existing file is left unchanged.

    Raises
    ------
    FileError
        If the file cannot be written.
    """
    with atomic_write(path) as temporary:
        write_session(temporary, *_encoded(data))


def _encoded(data: SessionData) -> tuple[tuple[Mesh, ...], int, Any]:
    """Return the meshes of a session, the number of the shown one, and the encoded data."""
    numbers: dict[Mesh, int] = {}

    def number(mesh: Mesh) -> int:
        return numbers.setdefault(mesh, len(numbers))

    window = encode(data, {
        Mesh: number,
        MeasuredMesh: lambda state: number(state.mesh),
        Smoother: lambda smoother: {"method": smoother.name, "parameters": smoother.values()},
    })  # fmt: skip
    return tuple(numbers), number(data.document.now.mesh), window


def read(path: Path) -> SessionData:
    """Read a session file and measure its meshes.

    Raises
    ------
    FileError
        If the file is no session, damaged, inconsistent, or of another version.
    """
    stored = read_session(path)
    states = _States(stored.meshes)
    hooks: Hooks = {MeasuredMesh: states, Mesh: lambda number: states(number).mesh, Smoother: _smoother}
    try:
        data = decode(SessionData, stored.window, hooks=hooks)
        data.history.check()
        return data
    except (HexmendError, ValueError) as error:
        raise FileError(path, f"is inconsistent: {error}", "Use an earlier copy, or open its mesh.") from None


class _States:
    """States of meshes by number, made on demand; equal points and hexes are measured once."""

    def __init__(self, meshes: tuple[Mesh, ...]):
        self._meshes = meshes
        self._states: dict[int, MeasuredMesh] = {}
        self._quality: dict[tuple[int, int], Any] = {}

    def __call__(self, number: Any) -> MeasuredMesh:
        if type(number) is not int or not 0 <= number < len(self._meshes):
            raise MeshError(f"there is no mesh {str(number)[:20]}")
        if number not in self._states:
            mesh = self._meshes[number]
            key = id(mesh.points), id(mesh.elements)
            if key not in self._quality:
                self._quality[key] = measure(mesh.points, mesh.elements, mesh.mid_nodes)
            self._states[number] = MeasuredMesh.of(mesh, self._quality[key])
        return self._states[number]


def _smoother(data: Any) -> Smoother:
    name = data["method"]
    return from_values(METHODS[name], data["parameters"], owner=name)
