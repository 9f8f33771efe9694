"""Tasks on a cluster, through Dask's scheduler: what a worker that dies had begun, another one does again."""

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
from hexmend.study.batch.table_columns import Status, answer
from hexmend.study.batch.task import Task

if TYPE_CHECKING:
    from distributed import Client, Future, Worker

#: Seconds to wait for the scheduler.
PATIENCE = 30

#: How often a task is done again that a worker could not do; Dask itself does again what dead workers had begun.
RETRIES = 2


class Cluster:
    """Does tasks on the workers of a scheduler, which see the meshes under the same paths.

    Parameters
    ----------
    address : str
        The scheduler's, such as tcp://host:8786.

    Raises
    ------
    ParameterError
        Where Dask's `distributed` is not installed.
    """

    def __init__(self, address: str):
        try:
            import distributed  # noqa: F401
        except ImportError:
            raise ParameterError("--scheduler needs Dask: run  pip install 'hexmend[study]'") from None
        self._address = address

    def answers(self, tasks: Sequence[Task]) -> Generator[tuple[Task, dict[str, Any]]]:
        """Each task with its answer, as it is done. Leaving it ends what is at work.

        Raises
        ------
        HexmendError
            Where there is no such scheduler, or it goes.
        """
        from distributed import as_completed

        with _quiet(), self._client() as client:
            run = uuid4().hex  # else what another study has had done would be taken for it, or be done twice
            done = {
                client.submit(work, asdict(task), key=f"hexmend-{task.key}-{run}", retries=RETRIES, pure=False): task
                for task in tasks
            }
            try:
                for future in as_completed(list(done), loop=client.loop):
                    row = _answer(self._address, future)
                    future.release()  # what is here is not done again where the worker dies that has it too
                    yield done.pop(future), row
            finally:
                client.cancel(list(done), force=True)

    def _client(self) -> Client:
        from distributed import Client

        try:
            return Client(self._address, timeout=PATIENCE, set_as_default=False)
        except (OSError, ValueError) as error:
            raise HexmendError(
                f"no scheduler answers at {self._address!r} ({_first_line(error)}): start one, by  dask scheduler  "
                "and name the address that it prints"
            ) from None


@contextmanager
def _quiet() -> Iterator[None]:
    """Inside the block Dask logs nothing: what is wrong is said here, in one sentence."""
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


def work(task: dict[str, Any]) -> dict[str, Any]:
    """What a worker does: the task, in a process of its own, with the worker's share of memory."""
    from distributed import get_worker

    worker = get_worker()
    key = worker.get_current_task()
    row = run_task(Task(**task), memory_mb=_share_mb(worker), unwanted=lambda: _cancelled(worker, key))
    return row if row is not None else answer(Status.LOST, "It was cancelled.")


def _cancelled(worker: Worker, key: str) -> bool:
    state = worker.state.tasks.get(key)
    return state is None or state.state == "cancelled"


def _share_mb(worker: Worker) -> int:
    """MiB for each of the tasks that a worker does at a time."""
    whole = worker.memory_manager.memory_limit or available() or 0
    return (whole >> 20) // worker.state.nthreads


def _answer(address: str, future: Future) -> dict[str, Any]:
    if future.status == "finished":
        return future.result()
    if future.status == "error":
        error = future.exception()
        return answer(Status.LOST, f"The cluster could not do it: {type(error).__name__}: {_first_line(error)}")
    raise HexmendError(
        f"the scheduler at {address} has gone: what was done is kept, and the same command goes on with it"
    )


def _first_line(error: BaseException) -> str:
    return next(iter(str(error).splitlines()), type(error).__name__)
