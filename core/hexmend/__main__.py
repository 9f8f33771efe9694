"""`python -m hexmend` is the program `hexmend`."""

import sys

from hexmend.cli.process.interrupts import exit_on_signals

exit_on_signals()

from hexmend.cli.main import main  # noqa: E402

sys.exit(main())
