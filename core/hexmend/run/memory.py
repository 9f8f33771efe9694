"""Memory that a run needs, and memory that is available."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from hexmend.mesh.mesh import Mesh
from hexmend.run.recipe import Recipe
from hexmend.smoothers import Smoother
from hexmend.terminal_text import count_phrase, listed

#: Bytes of every run, however small the mesh: SciPy with its libraries, and memory that the allocator retains.
FIXED = 64 << 20

#: Bytes per hex that does not move, and per node in excess of one per hex: topology, positions, quality.
AT_REST = 400

#: Bytes per boundary face on which nodes slide: its patch and its part of the search tree for closest points.
A_FACE = 4500

#: Bytes of address space that libraries and threads reserve without using them; a limit of RLIMIT_AS includes them.
_RESERVED = 256 << 20


@dataclass(frozen=True)
class Shortage:
    """A run for which memory will not suffice.

    Parameters
    ----------
    title : str
        Title of the method or recipe.
    hexes : int
        Number of hexes of the mesh.
    needed, available : int
        Bytes.
    """

    title: str
    hexes: int
    needed: int
    available: int

    @property
    def problem(self) -> str:
        """The shortage, as a sentence."""
        return (
            f"{self.title} on {count_phrase(self.hexes, 'hex', 'hexes')} needs about {format_bytes(self.needed)} of "
            f"memory, and {format_bytes(self.available)} are free."
        )

    def remedy(self, *more: str) -> str:
        """Return what the user can do, and further remedies, as a sentence."""
        return f"Close other programs, {listed(['smooth a smaller mesh', *more], 'or')}."


def shortage(method: Smoother | Recipe, mesh: Mesh | int, free: int | None) -> Shortage | None:
    """Return the shortage of memory for a run, or None if memory suffices or the free memory is not known.

    Parameters
    ----------
    method : Smoother or Recipe
    mesh : Mesh or int
        The mesh, or the number of its hexes.
    free : int or None
        Bytes, from `available`.
    """
    if free is None:
        return None
    need = needed(method, mesh)
    if need <= free:
        return None
    return Shortage(method.title, mesh if isinstance(mesh, int) else mesh.n_elements, need, free)


def needed(method: Smoother | Recipe, mesh: Mesh | int) -> int:
    """Estimate the bytes that a run takes at most in addition to the open mesh, from what its methods declare.

    Parameters
    ----------
    method : Smoother or Recipe
    mesh : Mesh or int
        The mesh, or the number of its hexes.

    Examples
    --------
    >>> from hexmend.smoothers import METHODS
    >>> needed(METHODS["mend"](), 1_000_000) // 10**6, needed(METHODS["local-sd"](), 1_000_000) // 10**6
    (1267, 467)
    """
    if isinstance(method, Recipe):
        return max(needed(stage.smoother, mesh) for stage in method.stages)
    if isinstance(mesh, int):
        hexes, fixed, extra_nodes, faces = mesh, 0, 0, 6 * mesh ** (2 / 3)
    else:
        hexes, extra_nodes = mesh.n_elements, max(0, mesh.n_nodes - mesh.n_elements)
        fixed = 0 if mesh.pinned is None else int(mesh.pinned[mesh.elements].all(axis=1).sum())
        faces = len(mesh.topology.boundary_faces) if method.slides else 0
    moved = method.bytes_per_hex * (hexes - fixed) + AT_REST * (fixed + extra_nodes)
    return FIXED + moved + (round(A_FACE * faces) if method.slides else 0)


def available(root: Path = Path("/")) -> int | None:
    """Return the bytes that this process can still take without swapping; None on systems other than Linux.

    It is the least of what the system, the control groups and the limit of address space leave.

    Parameters
    ----------
    root : Path
        Folder of `proc` and `sys`.

    Notes
    -----
    https://docs.kernel.org/admin-guide/cgroup-v2.html, memory; proc_meminfo(5), MemAvailable; getrlimit(2), RLIMIT_AS.
    """
    found = []
    if (kilobytes := _figure(root / "proc/meminfo", "MemAvailable:")) is not None:
        found.append(kilobytes << 10)
    group = re.search(r"^0::/(.*)$", _text(root / "proc/self/cgroup"), re.MULTILINE)
    inside = PurePosixPath(group[1]) if group and ".." not in group[1] else PurePosixPath()
    for folder in (root / "sys/fs/cgroup" / part for part in (inside, *inside.parents)):
        most, used = _figure(folder / "memory.max"), _figure(folder / "memory.current")
        if most is not None and used is not None:
            found.append(most - used + (_figure(folder / "memory.stat", "inactive_file") or 0))
    taken = _figure(root / "proc/self/status", "VmSize:")
    if taken is not None:
        import resource  # not on Windows

        limit = resource.getrlimit(resource.RLIMIT_AS)[0]
        if limit != resource.RLIM_INFINITY:
            found.append(limit - (taken << 10) - _RESERVED)
    return max(0, min(found)) if found else None


def format_bytes(size: int) -> str:
    """
    >>> format_bytes(2_267_000_000), format_bytes(48_300_000)
    ('2.3 GB', '48 MB')
    """
    return f"{size / 1e9:.1f} GB" if size >= 1e9 else f"{size / 1e6:.0f} MB"


def _figure(path: Path, name: str = "") -> int | None:
    """Return the number after a name at the beginning of a line; None where there is no such number."""
    found = re.search(rf"^{re.escape(name)}\s*(\d+)\b", _text(path), re.MULTILINE)
    return int(found[1]) if found else None


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="ascii", errors="replace")
    except OSError:
        return ""


def peak_mb() -> float:
    """Return the peak of the resident memory of this process, MiB.

    `ru_maxrss` is the fallback only: a process inherits it from its parent.
    """
    kilobytes = _figure(Path("/proc/self/status"), "VmHWM:")
    if kilobytes is None:
        import resource

        kilobytes = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return kilobytes / 1024


def resident_mb() -> float:
    """Return the resident memory of this process, MiB.

    Raises
    ------
    OSError
        If the system has no /proc.
    """
    kilobytes = _figure(Path("/proc/self/status"), "VmRSS:")
    if kilobytes is None:
        raise OSError("the system has no /proc/self/status")
    return kilobytes / 1024
