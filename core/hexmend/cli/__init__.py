"""The command line: a package in `commands` for each command.

The script `hexmend` imports this package first: from here on Ctrl-C prints one line and no traceback.
"""

import os as _os
import sys as _sys

if _os.path.basename("".join(_sys.argv[:1])).lower() in ("hexmend", "hexmend.exe"):
    try:
        from hexmend.cli.process.interrupts import exit_on_signals as _exit_on_signals

        _exit_on_signals()
    except KeyboardInterrupt:  # during the import above
        _os.write(2, b"hexmend: interrupted\n")
        _os._exit(130)
