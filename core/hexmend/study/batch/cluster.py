"""Tasks on a cluster, through the scheduler of Dask, which repeats tasks of workers that died on others."""

from __future__ import annotations

import logging
from collections.abc import Generator, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict
from typing import TYPE_CHECKING, Any
from uuid import uuid4

from hexmend.errors import HexmendError, ParameterError
from hexmend.run.memory import available
from hexmend.study.batch.process import run_task
from hexmend.study.batch.task import Status, Task, answer
from hexmend.terminal_text import install_hint

if TYPE_CHECKING:
    from distributed import Client, Future, Worker

#: Seconds to wait for the scheduler.
CONNECT_SECONDS = 30

#: Repetitions of a task that failed on a worker; Dask itself repeats tasks of workers that died.
RETRIES = 2


def check_installed() -> None:
    """Raise `ParameterError` if `distributed` of Dask is not installed."""
    try:
        import distributed  # noqa: F401
    except ImportError:
        raise ParameterError(f"--scheduler needs Dask: {install_hint('study')}") from None


def cluster_answers(tasks: Sequence[Task], address: str) -> Generator[tuple[Task, dict[str, Any]]]:
    """Run tasks on the workers of a scheduler, and yield each with its answer when it is done.

    All workers see the meshes under the same paths. Closing the generator ends running tasks.

    Parameters
    ----------
    tasks : sequence of Task
    address : str
        Address of the scheduler, such as tcp://host:8786.

    Raises
    ------
    HexmendError
        If there is no such scheduler, or it ends.
    """
    from distributed import as_completed

    with _quiet(), _client(address) as client:
        run = uuid4().hex  # tasks of another study must not share keys with these
        running = {
            client.submit(
                run_on_worker, asdict(task), key=f"hexmend-{task.key}-{run}", retries=RETRIES, pure=False
            ): task
            for task in tasks
        }
        try:
            for future in as_completed(list(running), loop=client.loop):
                row = _answer(address, future)
                future.release()  # else Dask repeats the task if the worker that has the answer dies
                yield running.pop(future), row
        finally:
            client.cancel(list(running), force=True)


def _client(address: str) -> Client:
    from distributed import Client

    try:
        return Client(address, timeout=CONNECT_SECONDS, set_as_default=False)
    except (OSError, ValueError) as error:
        raise HexmendError(
            f"no scheduler answers at {address!r} ({_first_line(error)}): start one, by  dask scheduler  "
            "and name the address that it prints"
        ) from None


@contextmanager
def _quiet() -> Iterator[None]:
    """Context in which Dask logs nothing: errors are raised here, in one sentence."""
    loggers = [
        logging.getLogger(name) for name in list(logging.root.manager.loggerDict) if name.startswith("distributed")
    ]
    levels = [logger.level for logger in loggers]
    for logger in loggers:
        logger.setLevel(logging.CRITICAL + 1)
    try:
        yield
    finally:
        for logger, level in zip(loggers, levels, strict=True):
            logger.setLevel(level)


def run_on_worker(task: dict[str, Any]) -> dict[str, Any]:
    """Run a task on a worker, in its own process, with its share of the memory of the worker."""
    from distributed import get_worker

    worker = get_worker()
    key = worker.get_current_task()
    row = run_task(Task(**task), memory_mb=_share_mb(worker), cancelled=lambda: _cancelled(worker, key))
    return row if row is not None else answer(Status.LOST, "It was cancelled.")


def _cancelled(worker: Worker, key: str) -> bool:
    state = worker.state.tasks.get(key)
    return state is None or state.state == "cancelled"


def _share_mb(worker: Worker) -> int:
    """Return the memory of each task that a worker runs at a time, MiB."""
    total = worker.memory_manager.memory_limit or available() or 0
    return (total >> 20) // worker.state.nthreads


def _answer(address: str, future: Future) -> dict[str, Any]:
    if future.status == "finished":
        return future.result()
    if future.status == "error":
        error = future.exception()
        return answer(Status.LOST, f"The cluster could not run it: {type(error).__name__}: {_first_line(error)}")
    raise HexmendError(
        f"the scheduler at {address} has gone: finished tasks are kept, and the same command continues with the others"
    )


def _first_line(error: BaseException) -> str:
    return next(iter(str(error).splitlines()), type(error).__name__)
