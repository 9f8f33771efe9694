"""`python -m hexmend` is the program `hexmend`."""

import sys

from hexmend.cli.main import main

sys.exit(main())
