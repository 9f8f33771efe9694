"""`python -m hexmend_app [MESH]` is `hexmend [MESH]`."""

import sys

from hexmend.cli.main import main

sys.exit(main(["view", *sys.argv[1:]]))
