"""Run `hexmend view [MESH]` for `python -m hexmend_app [MESH]`."""

import sys

from hexmend.cli.main import main

sys.exit(main(["view", *sys.argv[1:]]))
