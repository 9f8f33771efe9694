"""Commands of the core, a package each: `__init__` declares the command, another module runs it."""
