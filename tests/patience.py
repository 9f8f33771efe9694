"""How long a test waits for what happens in another thread."""

#: Milliseconds: far longer than anything takes, for machines that do other work besides, and less than the timeout in
#: pyproject.toml, so that a test that waits in vain says for what.
PATIENCE = 50_000
