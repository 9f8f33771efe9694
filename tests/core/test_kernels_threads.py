"""How threads of kernels wait for each other."""

import os
import subprocess
import sys

PROGRAM = "import os, hexmend.numba_kernels; print(os.environ['OMP_WAIT_POLICY'], os.environ['GOMP_SPINCOUNT'])"


def policy(**settings):
    names = "OMP_WAIT_POLICY", "GOMP_SPINCOUNT", "KMP_BLOCKTIME"
    environment = {key: value for key, value in os.environ.items() if key not in names} | settings
    done = subprocess.run([sys.executable, "-c", PROGRAM], env=environment, capture_output=True, text=True, check=True)
    return done.stdout.split()


def test_threads_that_wait_leave_their_core_to_others():
    assert policy() == ["PASSIVE", "1000"]


def test_what_the_user_has_set_stands():
    assert policy(OMP_WAIT_POLICY="ACTIVE") == ["ACTIVE", "1000"]
