"""The program `hexmend`: finds the command, runs it, and prints errors in one line.

Exit status: 0 done; 2 wrong usage; 3 a file cannot be read, written or used, or memory does not suffice; 4 done, and
hexes are still invalid; 128 plus the signal's number (130 for Ctrl-C) after an
interruption.

Imports inside functions keep `hexmend --version` and `--help` quick. lazy_loader is not used: it gives modules but no
names, warns of each submodule, and commands are no faster with it.
"""

from __future__ import annotations

import atexit
import gc
import importlib
import io
import os
import sys
from contextlib import suppress

from hexmend import __version__
from hexmend.cli.process.interrupts import CleanExit, exit_interrupted, exit_on_signals
from hexmend.terminal_text import install_hint, printable

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from hexmend.cli.command import Command

#: The commands in the order of the help: those of each day first. Others follow.
_ORDER = ["info", "smooth", "compare", "repair", "pad", "view", "render", "film", "report", "figures", "study"]

#: The command that is run for a mesh file without a command, or without any arguments.
_DEFAULT = "view"


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit status.

    Parameters
    ----------
    argv : sequence of str, optional
        The arguments. Without them this is the program itself, which takes `sys.argv` and handles signals.
    """
    if argv is None:
        exit_on_signals()
    _prepare_streams()
    try:
        status = _main(list(sys.argv[1:] if argv is None else argv))
        sys.stdout.flush()
        return status
    except KeyboardInterrupt as interrupt:
        number = getattr(interrupt, "number", 2)
        with suppress(OSError):  # the terminal may have gone
            if argv is None:
                sys.stdout.flush()
                exit_interrupted(number)
            print("hexmend: interrupted", file=sys.stderr)
        return 128 + number
    except BrokenPipeError:  # the reader, such as head, has ended
        _discard_output()
        return 0
    except OSError as error:
        _discard_output()
        print(f"hexmend: the output cannot be written: {error.strerror or error}", file=sys.stderr)
        return 3


def _prepare_streams() -> None:
    """Let streams that the caller has closed lead nowhere, and replace characters that the encoding does not have.

    Otherwise files would get the numbers of closed streams, and such a character would end the program.
    """
    for name, mode in (("stdin", "r"), ("stdout", "w"), ("stderr", "w")):  # in the order of their numbers
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, mode))  # noqa: SIM115  (open to the end)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")


def _discard_output() -> None:
    """Redirect standard output, so that Python can flush its buffer at the end."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _main(words: list[str]) -> int:
    if words and words[0] == "--version":
        print(f"hexmend {__version__}")
        return 0
    loaders = _core_commands()
    if words and words[0] in loaders:
        atexit.register(gc.freeze)  # the garbage collection at exit would take 0.1 s
    else:
        loaders = commands()
    if words and words[0] in ("-h", "--help"):
        return _help(loaders)
    if not words or words[0] not in loaders:
        if words and _looks_like_a_command(words[0]):
            return _unknown(words[0], loaders)
        words.insert(0, _DEFAULT)
    if words[0] not in loaders:
        print(f"hexmend: the viewer is not installed: {install_hint('app')}", file=sys.stderr)
        return 2
    return _run(loaders[words[0]], words[1:])


def commands() -> dict[str, Callable[[], Command]]:
    """Return a function for each command that imports it, the core's own first."""
    from importlib.metadata import entry_points  # reads the metadata of every installed distribution

    loaders = _core_commands()
    for entry in entry_points(group="hexmend.commands"):
        loaders.setdefault(entry.name, entry.load)
    return loaders


def _core_commands() -> dict[str, Callable[[], Command]]:
    import pkgutil

    from hexmend.cli import commands as package

    def loader(name: str) -> Callable[[], Command]:
        return lambda: importlib.import_module(f"hexmend.cli.commands.{name}").command

    return {module.name: loader(module.name) for module in pkgutil.iter_modules(package.__path__)}


def _run(load: Callable[[], Command], words: list[str]) -> int:
    from hexmend.cli.arguments.options import Parser
    from hexmend.errors import FileError, HexmendError, InsufficientMemoryError, MeshError

    try:
        command = load()
        parser = Parser(command.name, command.help)
        command.arguments(parser)
        try:
            args = parser.parse(words)
        except SystemExit as leave:  # the parser has printed the help, or what is wrong
            return int(leave.code or 0)
        if command.name == _DEFAULT:  # the window has an event loop of its own
            return command.run(args)
        with CleanExit(completes=True):
            return command.run(args)
    except HexmendError as error:
        print(f"hexmend: {printable(str(error))}", file=sys.stderr)
        return 3 if isinstance(error, FileError | MeshError | InsufficientMemoryError) else 2
    except MemoryError:
        print("hexmend: not enough memory: close other programs, or use a smaller mesh", file=sys.stderr)
        return 3


def _looks_like_a_command(word: str) -> bool:
    return not word.startswith("-") and not any(c in word for c in "./\\") and not os.path.exists(word)


def _unknown(word: str, loaders: dict[str, Callable[[], Command]]) -> int:
    import difflib

    near = difflib.get_close_matches(word, loaders, n=1)
    hint = f": did you mean hexmend {near[0]}?" if near else "."
    known = f"Commands: {', '.join(loaders)}; a file opens in the viewer."
    print(f"hexmend: {word!r} is neither a command nor a file{hint} {known}", file=sys.stderr)
    return 2


def _help(loaders: dict[str, Callable[[], Command]]) -> int:
    print("hexmend: see a hexahedral mesh, and mend it while you watch.\n")
    print("usage: hexmend [MESH]              open the viewer")
    print("       hexmend COMMAND --help      options of a command\n")
    names = [name for name in _ORDER if name in loaders]
    for name in [*names, *(name for name in loaders if name not in names)]:
        try:
            print(f"  {name:<10} {loaders[name]().help}")
        except ImportError:
            print(f"  {name:<10} not installed: {install_hint('app')}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
