"""How long a test waits for what happens in another thread."""

#: Milliseconds: far longer than anything takes, for machines that do other work besides.
PATIENCE = 200_000
