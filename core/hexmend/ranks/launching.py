"""Variables of the launchers of MPI."""

from __future__ import annotations

import os

#: Variables in which launchers tell each process the number of processes on its machine.
_LOCAL_SIZES = "OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS"


def local_ranks() -> int:
    """Return the number of ranks on this machine, as the launcher of this process says; 1 without one."""
    return next((int(os.environ[name]) for name in _LOCAL_SIZES if os.environ.get(name, "").isdecimal()), 1)
