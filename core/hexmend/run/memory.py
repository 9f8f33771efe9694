"""Whether memory will suffice for a run: what it will need, and what there is."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from hexmend.mesh.mesh import Mesh
from hexmend.run.recipe import Recipe
from hexmend.smoothers import METHODS, Smoother

#: Bytes of every run, however small the mesh: SciPy with its libraries, and what the allocator keeps.
FIXED = 64 << 20

#: Bytes of a hex that does not move, and of a node that there is beyond one a hex: topology, positions, figures.
AT_REST = 400

#: Bytes of a face of the boundary that nodes slide on: its patch, and how closest points of it are found.
A_FACE = 4500

#: Address space that libraries and threads reserve beside what they use: a limit of it counts that too.
_RESERVED = 256 << 20

#: From here on, a number stands for "without a limit": so control groups of version 1 say it.
_UNLIMITED = 1 << 60

#: How many methods that need less are named.
_NAMED = 3


@dataclass(frozen=True)
class Shortage:
    """A run for which memory will not suffice.

    Parameters
    ----------
    title : str
        Of the method or the recipe.
    hexes : int
        Of the mesh.
    needed, available : int
        Bytes.
    lighter : tuple of (type, int)
        Methods for which it would suffice, and the bytes they need: those of the same kind first, then by need.
    """

    title: str
    hexes: int
    needed: int
    available: int
    lighter: tuple[tuple[type[Smoother], int], ...]

    @property
    def problem(self) -> str:
        """What is the matter, as a sentence."""
        return (
            f"{self.title} on {self.hexes:,} hexes needs about {format_bytes(self.needed)} of memory, and "
            f"{format_bytes(self.available)} are free."
        )

    def remedy(self, *more: str, titled: bool = False) -> str:
        """What to do, as a sentence that calls methods by name or title; `more` are further ways."""
        names = _listed([f"{cls.title if titled else cls.name} ({format_bytes(size)})" for cls, size in self.lighter])
        ways = [f"take {names}, which need less"] if names else []
        said = _listed([*ways, "close other programs", "smooth a smaller mesh", *more])
        return f"{said[:1].upper()}{said[1:]}."


def shortage(work: Smoother | Recipe, mesh: Mesh | int, free: int | None) -> Shortage | None:
    """What is to be said before a run; None where memory will suffice, or nobody knows.

    Parameters
    ----------
    work : Smoother or Recipe
    mesh : Mesh or int
        Or how many hexes it will have.
    free : int or None
        Bytes, as `available` says.
    """
    if free is None:
        return None
    need = needed(work, mesh)
    if need <= free:
        return None
    optimises = not isinstance(work, Recipe) and work.optimises
    others = [(cls, needed(cls(), mesh)) for cls in METHODS.values()]
    fitting = [(cls, size) for cls, size in others if size <= free]
    lighter = sorted(fitting, key=lambda one: (one[0].optimises != optimises, one[1]))[:_NAMED]
    return Shortage(work.title, mesh if isinstance(mesh, int) else mesh.n_hexes, need, free, tuple(lighter))


def needed(work: Smoother | Recipe, mesh: Mesh | int) -> int:
    """Bytes that a run takes at most beside the open mesh, estimated from what its methods declare.

    Examples
    --------
    >>> needed(METHODS["mend"](), 1_000_000) // 10**6, needed(METHODS["local-sd"](), 1_000_000) // 10**6
    (2267, 467)
    """
    if isinstance(work, Recipe):
        return max(needed(stage.smoother, mesh) for stage in work.stages)
    if isinstance(mesh, int):
        hexes, still, more, faces = mesh, 0, 0, 6 * mesh ** (2 / 3)
    else:
        hexes, more = mesh.n_hexes, max(0, mesh.n_nodes - mesh.n_hexes)
        still = 0 if mesh.pinned is None else int(mesh.pinned[mesh.hexes].all(axis=1).sum())
        faces = len(mesh.topology.boundary_faces) if work.slides else 0
    moved = work.bytes_per_hex * (hexes - still) + AT_REST * (still + more)
    return FIXED + moved + (round(A_FACE * faces) if work.slides else 0)


def available(root: Path = Path("/")) -> int | None:
    """Bytes that this process can still take without swapping: the least of what the system, its control groups and its
    limit of address space leave; None where none of them says, as on systems other than Linux.

    Parameters
    ----------
    root : Path
        Where `proc` and `sys` are.

    Notes
    -----
    https://docs.kernel.org/admin-guide/cgroup-v2.html, memory; proc_meminfo(5), MemAvailable; getrlimit(2), RLIMIT_AS.
    """
    found = [*_of_the_system(root), *_of_control_groups(root), *_of_address_space(root)]
    return max(0, min(found)) if found else None


def format_bytes(size: int) -> str:
    """
    >>> format_bytes(2_267_000_000), format_bytes(48_300_000)
    ('2.3 GB', '48 MB')
    """
    return f"{size / 1e9:.1f} GB" if size >= 1e9 else f"{size / 1e6:.0f} MB"


def _of_the_system(root: Path) -> Iterator[int]:
    kilobytes = _figure(root / "proc/meminfo", "MemAvailable:")
    if kilobytes is not None:
        yield kilobytes << 10


def _of_control_groups(root: Path) -> Iterator[int]:
    """What each group that the process is in leaves, up to the outermost: of all of them the tightest binds."""
    for line in _text(root / "proc/self/cgroup").splitlines():
        _, controllers, path = line.split(":", 2)
        if not controllers:
            mounts, names = (
                ("sys/fs/cgroup", "sys/fs/cgroup/unified"),
                ("memory.max", "memory.current", "inactive_file"),
            )
        elif "memory" in controllers.split(","):
            mounts = ("sys/fs/cgroup/memory",)
            names = ("memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file")
        else:
            continue
        inside = PurePosixPath(path.lstrip("/"))
        inside = PurePosixPath() if ".." in inside.parts else inside  # beyond what this process can see
        for folder in (root / mount / group for mount in mounts for group in (inside, *inside.parents)):
            yield from _of_a_group(folder, *names)


def _of_a_group(folder: Path, limit: str, usage: str, reclaimable: str) -> Iterator[int]:
    most, used = _number(_text(folder / limit)), _number(_text(folder / usage))
    if most is not None and used is not None and most < _UNLIMITED:
        yield most - used + (_figure(folder / "memory.stat", reclaimable) or 0)


def _of_address_space(root: Path) -> Iterator[int]:
    try:
        import resource
    except ImportError:  # Windows has none
        return
    limit, taken = resource.getrlimit(resource.RLIMIT_AS)[0], _figure(root / "proc/self/status", "VmSize:")
    if limit != resource.RLIM_INFINITY and taken is not None:
        yield limit - (taken << 10) - _RESERVED


def _figure(path: Path, name: str) -> int | None:
    """The number after a name at the beginning of a line."""
    for line in _text(path).splitlines():
        words = line.split()
        if len(words) > 1 and words[0] == name:
            return _number(words[1])
    return None


def _number(text: str) -> int | None:
    text = text.strip()
    return int(text) if text.isascii() and text.isdigit() else None


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="ascii", errors="replace")
    except OSError:
        return ""


def _listed(names: Sequence[str]) -> str:
    """
    >>> _listed([]), _listed(["a"]), _listed(["a", "b", "c"])
    ('', 'a', 'a, b or c')
    """
    return " or ".join(filter(None, [", ".join(names[:-1]), *names[-1:]]))
