"""What a program said on standard error."""


def complaints(stderr: str) -> str:
    """All of it but the notice that kernels are compiled, which only a first run gives."""
    return "".join(line for line in stderr.splitlines(keepends=True) if not line.startswith("hexmend: compiling"))


#: Milliseconds to wait for a method that may have to be compiled first.
FIRST_RUN = 200_000
