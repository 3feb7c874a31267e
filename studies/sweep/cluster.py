"""Runs chunks on an existing cluster of ``distributed``: a chunk is a task, its result the content of its files.

In a task the engine is in a process of furiko's own, as it is here: one that crashes takes no Dask worker along. A task
depends on nothing but the sweep and its number: the scheduler may run it again elsewhere, and it gives the same.
"""

from __future__ import annotations

import logging
import os
import threading
import time
from collections.abc import Generator, Iterable, Iterator
from contextlib import contextmanager, suppress
from functools import cache
from queue import Empty, SimpleQueue
from typing import Any

from ...checks.foundations import own_code
from ...engines import why_missing
from ...models import EngineMissing, InvalidInput
from ...models.errors import library
from .chunk import Lane, Part, Work, do
from .plan import Sweep

CONNECTS_WITHIN = 20.0  # [s]: to the scheduler, and until it has a worker
CLOSES_WITHIN = 5.0  # [s]
LOOK_UP = 1.0  # [s] between two looks at whether the scheduler is there
COUNT_EVERY = 10.0  # [s] between two looks at how many workers there are
TRIES = 3  # of a chunk whose worker was lost
_here = threading.local()


class ClusterLost(RuntimeError):
    """The scheduler, or a chunk's workers again and again, are gone; what was done until then is kept."""


@contextmanager
def cluster(address: str) -> Iterator[Any]:
    """A client of the scheduler at an address, or in the scheduler file of this name.

    Raises :class:`furiko.LibraryMissing`, and :class:`InvalidInput` where nobody answers or there is no worker.
    """
    distributed = library("distributed")
    where = {"scheduler_file": address} if address.endswith(".json") else {"address": address}
    with _quiet():
        try:
            client = distributed.Client(**where, timeout=CONNECTS_WITHIN, set_as_default=False)
        except (OSError, TimeoutError, ValueError) as error:
            said = " ".join(str(error).split())[:300]
            raise InvalidInput(f"--dask {address}: no scheduler answers: {said}") from None
        try:
            try:
                client.wait_for_workers(1, timeout=CONNECTS_WITHIN)
            except TimeoutError:
                raise InvalidInput(f"--dask {address}: the scheduler has no worker: dask worker {address}") from None
            yield client
        finally:
            client.close(timeout=CLOSES_WITHIN)


@contextmanager
def _quiet() -> Iterator[None]:
    """Without what the client logs, traceback and all, where a connection is lost: whoever runs this says it once."""
    names = [name for name in logging.root.manager.loggerDict if name.partition(".")[0] == "distributed"]
    levels = {name: logging.getLogger(name).level for name in names}
    try:
        for name in names:
            logging.getLogger(name).setLevel(logging.CRITICAL)
        yield
    finally:
        for name, level in levels.items():
            logging.getLogger(name).setLevel(level)


def run_on_cluster(
    sweep: Sweep, digest: str, works: Iterable[Work], client: Any
) -> Generator[tuple[Part, ...], None, None]:
    """The parts of each chunk, in the order in which they are done.

    As many are under way as keep each worker busy. Raises :class:`ClusterLost`, and what a task raises: an engine that
    is not there (:class:`EngineMissing`), another furiko (:class:`InvalidInput`).
    """
    distributed = library("distributed")
    gone = (library("distributed.comm").CommClosedError, distributed.CancelledError)
    running = _Running(sweep, digest, client, iter(works))
    try:
        while running.fill():
            yield from running.done()
    except gone:
        raise ClusterLost("the scheduler is gone") from None
    finally:
        with suppress(*gone):
            running.cancel()


class _Running:
    """The chunks under way."""

    def __init__(self, sweep: Sweep, digest: str, client: Any, waiting: Iterator[Work]) -> None:
        self._sweep, self._digest, self._client, self._waiting = sweep, digest, client, waiting
        self._tries: dict[Any, tuple[Work, int]] = {}  # by future
        self._over: SimpleQueue[Any] = SimpleQueue()  # futures that are done
        self._most, self._counted = 0, -COUNT_EVERY

    def fill(self) -> bool:
        """Submit chunks while workers would have nothing to do; whether any is under way."""
        now = time.monotonic()
        if now - self._counted > COUNT_EVERY and self._client.status == "running":
            # One that runs and one that is next for each; some, while all workers are lost and others may come.
            self._most, self._counted = 2 * sum(self._client.nthreads().values()) + 2, now
        while len(self._tries) < self._most and (work := next(self._waiting, None)) is not None:
            self._submit(work, 1)
        return bool(self._tries)

    def _submit(self, work: Work, tries: int) -> None:
        # No two tasks have one key: that a chunk was done once says nothing of what another client wants of it.
        key = f"furiko-{self._digest[:12]}-{work.chunk}-{tries}-{os.urandom(4).hex()}"
        code = own_code().hex()
        future = self._client.submit(remote_chunk, self._sweep, self._digest, code, work, key=key, pure=False)
        self._tries[future] = work, tries
        future.add_done_callback(self._over.put)

    def done(self) -> Iterator[tuple[Part, ...]]:
        """Those that are done, after a short wait."""
        distributed = library("distributed")
        with suppress(Empty):
            future = self._over.get(timeout=LOOK_UP)
            work, tries = self._tries.pop(future)
            if future.status == "finished":
                yield future.result()
            elif future.status != "error":
                raise ClusterLost("the scheduler is gone")
            elif not isinstance(error := future.exception(), distributed.KilledWorker):
                raise error
            elif tries < TRIES:
                self._submit(work, tries + 1)
            else:
                raise ClusterLost(f"chunk {work.chunk} was given up: its workers were lost {tries} times over")
        if self._client.status != "running":
            raise ClusterLost("the scheduler is gone")

    def cancel(self) -> None:
        """Nobody waits for those under way any more."""
        if self._tries and self._client.status == "running":
            self._client.cancel(list(self._tries), force=True)
        self._tries.clear()


def remote_chunk(sweep: Sweep, digest: str, code: str, work: Work) -> tuple[Part, ...]:
    """A task: do a chunk in this thread's lane. Raises :class:`InvalidInput` where this furiko is another than ``code``
    is the digest of, :class:`EngineMissing` where an engine is not installed here."""
    if own_code().hex() != code:
        raise InvalidInput("--dask: a worker has another furiko than this one: install the same on all")
    for name in work.engines:
        why = _why_missing(name)
        if why:
            raise EngineMissing(f"--dask: a worker has no {name}: {why}")
    kept = getattr(_here, "lane", None)
    if kept is None or kept.source.memory != sweep.memory:
        if kept is not None:
            kept.end()
        _here.lane = Lane(sweep.memory)  # its processes end with this thread, at the latest
    return do(sweep, digest, work, _here.lane)


_why_missing = cache(why_missing)
